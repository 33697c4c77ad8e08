#include "geometry/elementSides.hpp"

#include <algorithm>

namespace mpm::geometry
{
void addFace(const std::vector<int>& n, std::vector<Simplex>& out)
{
    if (n.size() == 3)
    {
        out.push_back({n[0], n[1], n[2]});
        return;
    }
    const std::size_t s = std::size_t(std::min_element(n.begin(), n.end()) - n.begin());
    out.push_back({n[s], n[(s + 1) % 4], n[(s + 2) % 4]});
    out.push_back({n[s], n[(s + 2) % 4], n[(s + 3) % 4]});
}

void addSides(int type, const std::vector<int>& n, std::vector<Simplex>& out)
{
    static const std::map<int, std::vector<std::vector<std::size_t>>> faces = {
        {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
        {5, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
        {6, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
        {7, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}};
    if (type == 2 || type == 3)
    {
        for (std::size_t k = 0; k < n.size(); ++k)
            out.push_back({n[k], n[(k + 1) % n.size()], -1});
        return;
    }
    std::vector<int> corners;
    for (const auto& face : faces.at(type))
    {
        corners.clear();
        for (const std::size_t k : face)
            corners.push_back(n[k]);
        addFace(corners, out);
    }
}
} // namespace mpm::geometry

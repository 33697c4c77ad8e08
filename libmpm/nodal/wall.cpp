#include "nodal/wall.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::nodal
{
namespace
{
/// The change of u at one node; normal and tangential parts apart.
template <int dim>
bool wallChange(const Wall& wall, const Record& r, Vector3& normal, Vector3& tangential)
{
    constexpr int u0 = NodeRow<dim>::trial;
    const double un = wall.side * r[u0 + wall.axis];
    const bool pushes = un > 0;
    normal = tangential = {};
    if (!pushes && wall.separation)
        return false;
    normal[wall.axis] = -r[u0 + wall.axis];
    if (wall.type == WallType::roller || (wall.type == WallType::friction && !pushes))
        return true;
    double keep = 0;
    if (wall.type == WallType::friction)
    {
        double tt = 0;
        for (int a = 0; a < dim; ++a)
            if (a != wall.axis)
                tt += r[u0 + a] * r[u0 + a];
        keep = tt > 0 ? std::max(0.0, 1 - wall.mu * un / std::sqrt(tt)) : 0;
    }
    for (int a = 0; a < dim; ++a)
        if (a != wall.axis)
            tangential[a] = (keep - 1) * r[u0 + a];
    return true;
}
} // namespace

template <int dim>
std::pair<Index, Index> WallEffect<dim>::range(const NodeRow<dim>& row) const
{
    const auto behind = [&](Index index) { return wall_.side < 0 ? index <= wall_.plane : index >= wall_.plane; };
    if (wall_.axis == 1)
        return behind(row.j) ? std::pair(row.begin, row.end) : std::pair(row.end, row.end);
    if (wall_.axis == 2)
        return behind(row.k) ? std::pair(row.begin, row.end) : std::pair(row.end, row.end);
    if (wall_.side < 0)
        return {row.begin, std::clamp(wall_.plane + 1, row.begin, row.end)};
    return {std::clamp(wall_.plane, row.begin, row.end), row.end};
}

template <int dim>
void WallEffect<dim>::apply(NodeRow<dim>& row) const
{
    const auto [begin, end] = range(row);
    if (begin == end)
        return;
    if (row.normalImpulse->empty())
    {
        row.normalImpulse->assign(std::size_t(row.end - row.begin), {});
        row.frictionImpulse->assign(std::size_t(row.end - row.begin), {});
    }
    Vector3 normal, tangential;
    for (Index i = begin; i < end; ++i)
    {
        if (!row.carries(i) || !wallChange<dim>(wall_, row.node[i], normal, tangential))
            continue;
        const double m = row.node[i][0];
        auto& rest = (*row.normalImpulse)[std::size_t(i - row.begin)];
        auto& rub = wall_.type == WallType::friction ? (*row.frictionImpulse)[std::size_t(i - row.begin)] : rest;
        for (int a = 0; a < dim; ++a)
        {
            row.node[i][row.trial + a] += normal[a] + tangential[a];
            rest[a] += m * normal[a];
            rub[a] += m * tangential[a];
        }
        row.node[i][row.trial + wall_.axis] = 0;
        row.sums->contacts += wall_.type == WallType::friction;
    }
}

template <int dim>
void WallEffect<dim>::constrain(NodeRow<dim>& row) const
{
    const auto [begin, end] = range(row);
    Vector3 normal, tangential;
    for (Index i = begin; i < end; ++i)
        if (wallChange<dim>(wall_, row.node[i], normal, tangential))
        {
            for (int a = 0; a < dim; ++a)
                row.node[i][row.trial + a] += tangential[a];
            row.node[i][row.trial + wall_.axis] = 0;
        }
}

template class WallEffect<2>;
template class WallEffect<3>;
} // namespace mpm::nodal

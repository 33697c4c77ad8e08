#include "geometry/simplex.hpp"

#include "base/error.hpp"
#include "geometry/region.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::geometry
{
Simplex unoriented(const Simplex& s)
{
    Simplex sorted = s;
    std::sort(sorted.begin(), sorted.begin() + (s[2] < 0 ? 2 : 3));
    return sorted;
}

std::vector<Simplex> oddElements(const std::vector<std::vector<Simplex>>& pieces)
{
    struct Occurrence
    {
        Simplex key;
        std::size_t order;
        const Simplex* element;
    };
    std::vector<Occurrence> all;
    for (const auto& piece : pieces)
        for (const Simplex& s : piece)
            all.push_back({unoriented(s), all.size(), &s});
    std::sort(all.begin(), all.end(), [](const Occurrence& a, const Occurrence& b) {
        return a.key != b.key ? a.key < b.key : a.order < b.order;
    });
    std::vector<Occurrence> odd;
    for (std::size_t i = 0, j = 0; i < all.size(); i = j)
    {
        while (j < all.size() && all[j].key == all[i].key)
            ++j;
        if ((j - i) % 2 == 1)
            odd.push_back(all[i]);
    }
    std::sort(odd.begin(), odd.end(), [](const Occurrence& a, const Occurrence& b) { return a.order < b.order; });
    std::vector<Simplex> out;
    for (const Occurrence& o : odd)
        out.push_back(*o.element);
    return out;
}

namespace
{
/// Segments at each point that no loop has used yet.
class Chainer
{
  public:
    Chainer(const std::vector<Vector3>& points, const std::vector<Simplex>& segments, const std::string& name)
        : points_(points), segments_(segments), used_(segments.size(), false)
    {
        for (std::size_t s = 0; s < segments.size(); ++s)
            for (int end = 0; end < 2; ++end)
                at_[segments[s][std::size_t(end)]].push_back(s);
        for (const auto& [point, at] : at_)
            if (at.size() % 2 != 0)
                throw InputError(
                    fmt::format("{}: the boundary is open: a curve ends at {} without another to go on; close "
                                "the loop there",
                                name, placeText(points[std::size_t(point)], 2)));
    }

    std::vector<std::vector<int>> run()
    {
        std::vector<std::vector<int>> loops;
        for (std::size_t s = 0; s < segments_.size(); ++s)
            if (!used_[s])
                walk(s, loops);
        return loops;
    }

  private:
    void walk(std::size_t start, std::vector<std::vector<int>>& loops)
    {
        std::vector<int> path = {segments_[start][0]};
        std::map<int, std::size_t> placeInPath = {{path[0], 0}};
        std::size_t segment = start;
        while (true)
        {
            used_[segment] = true;
            const int here = segments_[segment][0] == path.back() ? segments_[segment][1] : segments_[segment][0];
            // Back at a point of the path: what lies between is a loop of its own.
            if (const auto seen = placeInPath.find(here); seen != placeInPath.end())
            {
                loops.emplace_back(path.begin() + std::ptrdiff_t(seen->second), path.end());
                for (std::size_t i = seen->second + 1; i < path.size(); ++i)
                    placeInPath.erase(path[i]);
                path.resize(seen->second + 1);
                if (path.size() == 1 && !anyLeft(here))
                    return;
            }
            else
            {
                placeInPath[here] = path.size();
                path.push_back(here);
            }
            segment = nextAt(here, segment);
        }
    }

    bool anyLeft(int point) const
    {
        const auto& at = at_.at(point);
        return std::any_of(at.begin(), at.end(), [&](std::size_t s) { return !used_[s]; });
    }

    /// The unused segment that comes first counter-clockwise from the one we came by, so that loops meet without
    /// crossing.
    std::size_t nextAt(int here, std::size_t from) const
    {
        const auto angle = [&](std::size_t s) {
            const int other = segments_[s][0] == here ? segments_[s][1] : segments_[s][0];
            return std::atan2(points_[std::size_t(other)][1] - points_[std::size_t(here)][1],
                              points_[std::size_t(other)][0] - points_[std::size_t(here)][0]);
        };
        const double arrival = angle(from);
        std::size_t best = from;
        double bestTurn = 10;
        for (const std::size_t s : at_.at(here))
        {
            if (used_[s])
                continue;
            double turn = angle(s) - arrival;
            if (turn <= 0)
                turn += 2 * M_PI;
            if (turn < bestTurn)
                bestTurn = turn, best = s;
        }
        return best;
    }

    const std::vector<Vector3>& points_;
    const std::vector<Simplex>& segments_;
    std::vector<bool> used_;
    std::map<int, std::vector<std::size_t>> at_;
};
} // namespace

std::vector<std::vector<int>> chainLoops(const std::vector<Vector3>& points, const std::vector<Simplex>& segments,
                                         const std::string& name)
{
    return Chainer(points, segments, name).run();
}
} // namespace mpm::geometry

#include "seeding/boxLattice.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::seeding
{
namespace
{
/// What counts as round-off, in box sides: for corners on a plane, and for corners outside the grid.
constexpr double onPlane = 1e-12;
constexpr double outside = 1e-9;

/// The mixing function of the generator splitmix64 (Steele, Lea and Flood, OOPSLA 2014).
std::uint64_t mix(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Uniform in [-1, 1), a function of its arguments alone.
double uniform(Index seed, int axis, Index plane, Index row, Index layer)
{
    std::uint64_t x = mix(std::uint64_t(seed));
    for (const Index key : {Index(axis), plane, row, layer})
        x = mix(x ^ std::uint64_t(key));
    return double(x >> 11) * 0x1p-52 - 1;
}
} // namespace

BoxLattice::BoxLattice(const state::GridBox& grid, const LatticeOptions& options) : grid_(grid), options_(options)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const auto a = std::size_t(axis);
        boxes_[a] = axis < grid.dim ? grid.cells[a] * options.perCell : 1;
        for (Index i = 0; i <= boxes_[a]; ++i)
            regular_[a].push_back(axis < grid.dim ? grid.origin[a] + grid.h * (double(i) / double(options.perCell))
                                                  : double(i));
    }
}

void BoxLattice::fit(const geometry::Region& region)
{
    requireInside(region);
    for (std::size_t a = 0; a < std::size_t(grid_.dim); ++a)
    {
        auto& planes = regular_[a];
        for (const Vector3& v : region.vertices())
        {
            const double near = (v[a] - grid_.origin[a]) / spacing();
            const Index i = std::clamp<Index>(Index(std::llround(near)), 0, boxes_[a]);
            double& plane = planes[std::size_t(i)];
            if (std::abs(v[a] - plane) <= onPlane * spacing())
                plane = v[a];
        }
        planes.front() = std::min(planes.front(), region.lower()[a]);
        planes.back() = std::max(planes.back(), region.upper()[a]);
    }
}

void BoxLattice::requireInside(const geometry::Region& region) const
{
    const double tolerance = outside * spacing();
    const auto leaves = [&](const Vector3& v) {
        for (int axis = 0; axis < grid_.dim; ++axis)
            if (v[std::size_t(axis)] < grid_.origin[std::size_t(axis)] - tolerance ||
                v[std::size_t(axis)] > grid_.upper(axis) + tolerance)
                return true;
        return false;
    };
    const auto& vertices = region.vertices();
    const auto first = std::find_if(vertices.begin(), vertices.end(), leaves);
    if (first == vertices.end())
        return;
    Vector3 low{}, high{};
    for (std::size_t a = 0; a < std::size_t(grid_.dim); ++a)
    {
        const double o = grid_.origin[a], h = grid_.h;
        low[a] = std::min(o, o + h * std::floor((region.lower()[a] - o) / h + outside));
        high[a] = std::max(grid_.upper(int(a)), o + h * std::ceil((region.upper()[a] - o) / h - outside));
    }
    throw InputError(fmt::format("region '{}' leaves the grid at {}; gridDict needs at least min {} max {}",
                                 region.name(), geometry::placeText(*first, grid_.dim), geometry::placeText(low, 3),
                                 geometry::placeText(high, 3)));
}

double BoxLattice::plane(int axis, Index index, Index row, Index layer) const
{
    const double regular = regular_[std::size_t(axis)][std::size_t(index)];
    if (!options_.jittered || axis >= grid_.dim || index == 0 || index == boxes_[std::size_t(axis)])
        return regular;
    return regular + spacing() * options_.jitter * uniform(options_.randomSeed, axis, index, row, layer);
}

std::vector<double> BoxLattice::planes(int axis, Index row, Index layer) const
{
    std::vector<double> made(regular_[std::size_t(axis)].size());
    for (std::size_t i = 0; i < made.size(); ++i)
        made[i] = plane(axis, Index(i), row, layer);
    return made;
}

std::vector<double> BoxLattice::zPlanes() const
{
    return planes(2, 0, 0);
}

std::vector<double> BoxLattice::yPlanes(Index layer) const
{
    return planes(1, 0, layer);
}

void BoxLattice::xPlanes(Index row, Index layer, std::vector<double>& made) const
{
    if (!options_.jittered)
    {
        made = regular_[0];
        return;
    }
    made = planes(0, row, layer);
}
} // namespace mpm::seeding

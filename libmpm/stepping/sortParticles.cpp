#include "stepping/sortParticles.hpp"

#include "state/particleOrder.hpp"
#include "state/permutation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace mpm::stepping
{
namespace
{
/// The lattice node a support starts at, as TileLayout::key() bounds it.
struct Axis
{
    Axis(const state::GridBox& grid, const state::TileLayout& layout, int supportNodes, int a)
        : origin(grid.origin[a]), invH(1 / grid.h), cells(double(grid.cells[a] + 1)), shift(0.5 * (supportNodes - 2)),
          side(Index(1) << layout.bits()), last(double((layout.boxes(a) - 1) * side - 1))
    {}

    Index base(double x) const
    {
        const double s = (x - origin) * invH;
        double node = std::floor(s - shift);
        node = node < -double(side) ? -double(side) : node > last ? last : node;
        // a particle that has left the box, or is nowhere, is refused by the pass that follows
        node = s > -1 && s < cells ? node : 0.0;
        // a whole number in the last bits of a double: not all processors convert eight at a time
        constexpr double whole = 0x1.8p52;
        return std::bit_cast<std::int64_t>(node + whole) - std::bit_cast<std::int64_t>(whole);
    }

    double origin, invH, cells, shift;
    Index side;
    double last;
};

/// Keys of particles [first, first + count); TileLayout::key() for many. With the axes apart the loops are vectors.
template <int dim>
void keysOf(const state::State& state, const state::TileLayout& layout, int supportNodes, Index first, Index count,
            std::int64_t* key)
{
    const int bits = layout.bits();
    const Index inside = (Index(1) << bits) - 1;
    std::array<std::int64_t, lanes> box{}, cell{};
    if (layout.hasBodies())
        for (Index i = 0; i < count; ++i)
            box[std::size_t(i)] = layout.bodyOf(state.particles.material[std::size_t(first + i)]);
    for (int a = dim - 1; a >= 0; --a)
    {
        const Axis axis(state.grid, layout, supportNodes, a);
        const Index boxes = layout.boxes(a);
        const double* x = state.particles.x[std::size_t(a)].data() + first;
        for (std::size_t i = 0; i < std::size_t(lanes); ++i)
        {
            const Index base = axis.base(x[i]);
            box[i] = box[i] * boxes + (base >> bits) + 1;
            cell[i] = (cell[i] << bits) + (base & inside);
        }
    }
    for (Index i = 0; i < count; ++i)
        key[i] = (box[std::size_t(i)] << (dim * bits)) + cell[std::size_t(i)];
}

void keysOf(const state::State& state, const state::TileLayout& layout, int supportNodes, Index first, Index count,
            std::int64_t* key)
{
    if (state.grid.dim == 2)
        keysOf<2>(state, layout, supportNodes, first, count, key);
    else
        keysOf<3>(state, layout, supportNodes, first, count, key);
}
} // namespace

void sortByStoredKeys(state::State& state)
{
    if (!state::sortByKeyAndId(state.particles))
        state.particles.padLastChunk();
}

bool keysNameBodies(const state::State& state, const state::TileLayout& layout)
{
    const auto& p = state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        if (layout.body(p.sortKey[i]) != layout.bodyOf(p.material[i]))
            return false;
    return true;
}

void wrapPositions(state::State& state)
{
    const auto& grid = state.grid;
    for (int a = 0; a < grid.dim; ++a)
    {
        const double low = grid.origin[a], high = grid.upper(a), length = high - low;
        if (!grid.periodic[a])
            continue;
        for (Index i = 0; i < state.particles.size(); ++i)
        {
            double& x = state.particles.x[a][std::size_t(i)];
            if (x < low && x > low - length)
                x += length;
            else if (x >= high && x < high + length)
                x -= length;
        }
    }
}

double largestMass(const state::Particles& particles)
{
    std::array<double, 8> largest{}; // one after the other, every particle would wait for the one before
    for (std::size_t i = 0; i < particles.mass.size(); i += largest.size())
        for (std::size_t l = 0; l < largest.size(); ++l)
            largest[l] = std::max(largest[l], particles.mass[i + l]);
    return *std::max_element(largest.begin(), largest.end());
}

void sortByPosition(state::State& state, const state::TileLayout& layout, int supportNodes)
{
    auto& p = state.particles;
#pragma omp parallel for schedule(static) if (p.size() > state::manyParticles)
    for (Index first = 0; first < p.size(); first += lanes)
        keysOf(state, layout, supportNodes, first, std::min<Index>(lanes, p.size() - first), p.sortKey.data() + first);
    sortByStoredKeys(state);
}

void sortLoose(state::State& state, const state::TileLayout& layout, int supportNodes)
{
    auto& p = state.particles;
    constexpr auto isNew = std::numeric_limits<std::int64_t>::max();
    Index loose = 0;
    for (Index first = 0; first < p.size(); first += lanes)
    {
        const Index count = std::min<Index>(lanes, p.size() - first);
        std::int64_t* const key = p.sortKey.data() + first;
        if (std::none_of(key, key + count, [](auto k) { return k >= state::looseKey; }))
            continue;
        std::array<std::int64_t, lanes> anew;
        keysOf(state, layout, supportNodes, first, count, anew.data());
        for (Index i = 0; i < count; ++i)
        {
            if (key[i] == isNew)
                key[i] = state::looseKey + anew[std::size_t(i)];
            loose += key[i] >= state::looseKey;
        }
    }
    if (8 * loose > p.size())
        sortByPosition(state, layout, supportNodes);
    else
        sortByStoredKeys(state);
}
} // namespace mpm::stepping

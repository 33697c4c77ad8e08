#include "stepping/sortParticles.hpp"

#include "state/particleOrder.hpp"

#include <cmath>
#include <limits>

namespace mpm::stepping
{
namespace
{
Index keyOf(const state::State& state, const state::TileLayout& layout, int supportNodes, std::size_t i)
{
    const auto& grid = state.grid;
    std::array<Index, 3> base{};
    for (int a = 0; a < grid.dim; ++a)
    {
        const double s = (state.particles.x[a][i] - grid.origin[a]) / grid.h;
        // a particle that has left the box, or is nowhere, is refused by the pass that follows
        const bool inside = s > -1 && s < double(grid.cells[a] + 1);
        base[a] = inside ? Index(std::floor(s - 0.5 * (supportNodes - 2))) : 0;
    }
    return layout.key(base, layout.bodyOf(state.particles.material[i]));
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

void sortByPosition(state::State& state, const state::TileLayout& layout, int supportNodes)
{
    auto& p = state.particles;
    for (Index i = 0; i < p.size(); ++i)
        p.sortKey[std::size_t(i)] = keyOf(state, layout, supportNodes, std::size_t(i));
    sortByStoredKeys(state);
}

void sortLoose(state::State& state, const state::TileLayout& layout, int supportNodes)
{
    auto& p = state.particles;
    Index loose = 0;
    for (Index i = 0; i < p.size(); ++i)
    {
        auto& key = p.sortKey[std::size_t(i)];
        if (key == std::numeric_limits<std::int64_t>::max())
            key = state::looseKey + keyOf(state, layout, supportNodes, std::size_t(i));
        loose += key >= state::looseKey;
    }
    if (8 * loose > p.size())
        sortByPosition(state, layout, supportNodes);
    else
        sortByStoredKeys(state);
}
} // namespace mpm::stepping

#include "stepping/sortParticles.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mpm::stepping
{
void sortByStoredKeys(state::State& state)
{
    auto& p = state.particles;
    const auto before = [&](Index i, Index j) {
        const auto a = std::size_t(i), b = std::size_t(j);
        return p.sortKey[a] != p.sortKey[b] ? p.sortKey[a] < p.sortKey[b] : p.id[a] < p.id[b];
    };
    std::vector<Index> order(static_cast<std::size_t>(p.size()));
    std::iota(order.begin(), order.end(), Index(0));
    if (std::is_sorted(order.begin(), order.end(), before))
    {
        p.padLastChunk();
        return;
    }
    std::sort(order.begin(), order.end(), before);
    p.permute(order);
}

void sortByPosition(state::State& state, int supportNodes)
{
    auto& p = state.particles;
    const auto& grid = state.grid;
    const double invH = 1 / grid.h, shift = 0.5 * (supportNodes - 2);
    constexpr Index margin = 4; // supports reach beyond the box
    for (Index i = 0; i < p.size(); ++i)
    {
        Index key = 0;
        for (int a = p.dim - 1; a >= 0; --a)
        {
            const double s = (p.x[a][std::size_t(i)] - grid.origin[a]) * invH;
            // a particle that has left the box, or is nowhere, is refused by the pass that follows
            const bool inside = s > -1 && s < double(grid.cells[a] + 1);
            key = key * (grid.cells[a] + 2 * margin) + (inside ? Index(std::floor(s - shift)) : 0) + margin;
        }
        p.sortKey[std::size_t(i)] = key;
    }
    sortByStoredKeys(state);
}
} // namespace mpm::stepping

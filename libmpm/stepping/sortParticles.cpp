#include "stepping/sortParticles.hpp"

#include "state/particleOrder.hpp"

#include <cmath>

namespace mpm::stepping
{
void sortByStoredKeys(state::State& state)
{
    if (!state::sortByKeyAndId(state.particles))
        state.particles.padLastChunk();
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

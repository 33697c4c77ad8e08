#pragma once
/// Weights of one chunk in all axes, and the offset of each lane's first node in a node window.
#include "shape/axisWeights.hpp"
#include "state/gridBox.hpp"
#include "state/nodeGrid.hpp"
#include "state/particles.hpp"

namespace mpm::transfer
{
/// What kernels need to know of particles besides their columns: domain half lengths over h, one column an axis
/// (recomputed from length0 and F, never stored in a state).
using DomainColumns = std::array<state::Column<double>, 3>;

template <int dim, class Shape>
struct ChunkWeights
{
    static constexpr int n = Shape::nodes;
    shape::AxisWeights<n> axis[dim];

    void evaluate(const state::Particles& p, const DomainColumns& lambda, const state::GridBox& grid, Index first)
    {
        const double invH = 1 / grid.h;
        for (int a = 0; a < dim; ++a)
            Shape::evaluate(p.x[a].data() + first, Shape::hasDomain ? lambda[a].data() + first : nullptr,
                            grid.origin[a], invH, axis[a]);
    }

    /// offset[l] = index in `window` of node (0, 0, 0) of lane l's support.
    void offsets(const state::NodeWindow& window, std::int64_t (&offset)[lanes]) const
    {
        for (int l = 0; l < lanes; ++l)
        {
            Index o = axis[dim - 1].base[l] - window.lo[dim - 1];
            for (int a = dim - 2; a >= 0; --a)
                o = o * window.n[a] + (axis[a].base[l] - window.lo[a]);
            offset[l] = o;
        }
    }
};
} // namespace mpm::transfer

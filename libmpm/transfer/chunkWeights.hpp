#pragma once
/// Weights of one chunk in all axes, and the offset of each lane's first node in a box of nodes. Verified in
/// tests/unit/chunk.cpp.
#include "shape/axisWeights.hpp"
#include "state/gridBox.hpp"
#include "state/tileGrid.hpp"

namespace mpm::transfer
{
/// Lattice indices of the walls normal to each axis.
using WallPlanes = std::array<std::vector<std::int32_t>, 3>;

template <int dim, class Shape>
struct ChunkWeights
{
    static constexpr int n = Shape::nodes;
    using Domain = double[dim][lanes]; ///< half lengths over h (shapes without domains ignore them)
    shape::AxisWeights<n> axis[dim];
    alignas(64) std::int32_t offset[lanes]; ///< of node (0, 0, 0) of each lane's support in the window

    /// x: positions [m]; walls: planes of nodes that carry a wall (shapes that know no walls ignore them).
    void evaluate(const double (&x)[dim][lanes], const Domain& half, const state::GridBox& grid,
                  const WallPlanes& walls = {})
    {
        const double invH = 1 / grid.h;
        for (int a = 0; a < dim; ++a)
        {
            Shape::evaluate(x[a], half[a], grid.origin[a], invH, axis[a]);
            if constexpr (requires { &Shape::foldAtWall; })
                for (const std::int32_t plane : walls[std::size_t(a)])
                    Shape::foldAtWall(x[a], grid.origin[a], invH, plane, axis[a]);
        }
    }

    /// Offsets in the window; false if a support reaches beyond it, however far: the differences wrap around, and one
    /// of them then has its sign bit.
    bool locate(const state::NodeBox& window)
    {
        std::uint32_t below = 0, above = 0;
        std::uint32_t stride = 1;
        for (int l = 0; l < lanes; ++l)
            offset[l] = 0;
        for (int a = 0; a < dim; ++a)
        {
            const auto lo = std::uint32_t(window.lo[a]), room = std::uint32_t(window.n[a]) - std::uint32_t(n);
            for (int l = 0; l < lanes; ++l)
            {
                const std::uint32_t i = std::uint32_t(axis[a].base[l]) - lo;
                below |= i;
                above |= room - i;
                offset[l] = std::int32_t(std::uint32_t(offset[l]) + stride * i);
            }
            stride *= std::uint32_t(window.n[a]);
        }
        return std::int32_t(below | above) >= 0;
    }
};
} // namespace mpm::transfer

#pragma once
/// Weights of one chunk of particles along one axis. Shape functions are products over axes:
/// N_ip = prod_a N_a, dN_ip/dx_b = G_b prod_{a != b} N_a.
///
/// Lengths are measured in cells: s = (x - origin)/h, lambda = l/h with l the half length of the particle's domain.
/// A shape is a struct with
///     nodes                 support, nodes per axis
///     evaluate(x, lambda, origin, invH, w)   fills N, G [1/m] and the first node of each lane; x, lambda on 64 bytes
///     Narrow                the shape to evaluate where no domain of a chunk is wider than a cell; the shape itself
///                           unless it knows a cheaper form
///     foldAtWall(...)       where the shape has functions of its own beside a wall
/// Every shape keeps sum N = 1 and sum G = 0.
#include "base/record.hpp"
#include "base/types.hpp"

#include <cmath>

namespace mpm::shape
{
template <int n>
struct AxisWeights
{
    alignas(64) double N[n][lanes];
    alignas(64) double G[n][lanes];
    alignas(64) std::int32_t base[lanes]; ///< lattice index of node 0
};

/// Lattice index of the first node of the support, for a support of n nodes: floor(s - (n - 2)/2).
template <int n>
inline std::int32_t firstNode(double x, double origin, double invH)
{
    return std::int32_t(std::floor((x - origin) * invH - 0.5 * (n - 2)));
}
} // namespace mpm::shape

#pragma once
/// Transfers of a shape that interpolates between the corners of a domain (CPDI). Sums over nodes are products of hats
/// at each corner: what a particle gives to, or takes from, corner c is one record, spread over the 2^d nodes around
/// it.
///
/// The functions have the names and arguments of those for weights that are products over axes (particleToGrid.hpp,
/// gridToParticle.hpp). Verified in tests/unit/cornerWeights.cpp against sums over pairs of particles and nodes.
#include "shape/CPDI.hpp"
#include "transfer/gridToParticle.hpp"
#include "transfer/particleToGrid.hpp"

namespace mpm::transfer
{
template <int dim>
struct ChunkWeights<dim, shape::CPDI>
{
    static constexpr int corners = 1 << dim;
    using Domain = double[dim * dim][lanes]; ///< half edges in cells, component a of edge k at a dim + k
    shape::CornerWeights<dim> at;
    alignas(64) std::int32_t offset[corners][lanes]; ///< of the node before each corner in the window

    void evaluate(const double (&x)[dim][lanes], const Domain& edges, const state::GridBox& grid,
                  const WallPlanes& = {})
    {
        shape::CPDI::evaluate<dim>(x, edges, grid.origin.data(), 1 / grid.h, at);
    }

    bool locate(const state::NodeBox& window)
    {
        std::uint32_t below = 0, above = 0;
        for (int a = 0; a < dim; ++a)
        {
            const auto lo = std::uint32_t(window.lo[a]);
            const auto room = std::uint32_t(window.n[a]) - std::uint32_t(shape::CPDI::nodes);
            for (int l = 0; l < lanes; ++l)
            {
                const std::uint32_t i = std::uint32_t(at.base[a][l]) - lo;
                below |= i;
                above |= room - i;
            }
        }
        if (std::int32_t(below | above) < 0)
            return false;
        for (int c = 0; c < corners; ++c)
            for (int l = 0; l < lanes; ++l)
            {
                Index place = 0;
                for (int a = dim - 1; a >= 0; --a)
                    place = place * window.n[a] + (at.cell[a][c][l] - window.lo[a]);
                offset[c][l] = std::int32_t(place);
            }
        return true;
    }

    double hat(int axis, int corner, int lane, int node) const
    {
        const double t = at.place[axis][corner][lane];
        return node ? t : 1 - t;
    }
};

/// Calls visit(place in the window, weight of the corner's hat) for the 2^d nodes around a corner.
template <int dim, class Visit>
MPM_INLINE void aroundCorner(const ChunkWeights<dim, shape::CPDI>& w, int c, int l, const state::NodeBox& box,
                             Visit&& visit)
{
    const Index nx = box.n[0], nxy = nx * box.n[1];
    MPM_UNROLL
    for (int k = 0; k < (dim == 3 ? 2 : 1); ++k)
        MPM_UNROLL
    for (int j = 0; j < 2; ++j)
        MPM_UNROLL
    for (int i = 0; i < 2; ++i)
    {
        double N = w.hat(0, c, l, i) * w.hat(1, c, l, j);
        if constexpr (dim == 3)
            N *= w.hat(2, c, l, k);
        visit(w.offset[c][l] + i + j * nx + k * nxy, N);
    }
}

/// What a particle gives to one of its corners.
MPM_INLINE HalfRecord shareOfCorner(const ParticleRecords<2, Momentum>& p, const ChunkWeights<2, shape::CPDI>&, int,
                                    int l)
{
    return splat<HalfRecord>(0.25) * p.r[l];
}
MPM_INLINE Record shareOfCorner(const ParticleRecords<2, Forces>& p, const ChunkWeights<2, shape::CPDI>& w, int c,
                                int l)
{
    const double gx = w.at.g[0][c][l], gy = w.at.g[1][c][l];
    return Record{0.25, 0.25, 0.25, gx, gx, gy, gy, 0} * p.r[l];
}
MPM_INLINE HalfRecord shareOfCorner(const ParticleRecords<3, Momentum>& p, const ChunkWeights<3, shape::CPDI>&, int,
                                    int l)
{
    return splat<HalfRecord>(0.125) * p.r[l];
}
MPM_INLINE Record shareOfCorner(const ParticleRecords<3, Forces>& p, const ChunkWeights<3, shape::CPDI>& w, int c,
                                int l)
{
    const auto g = [&](int a) { return splat<HalfRecord>(w.at.g[a][c][l]); };
    return join(splat<HalfRecord>(0.125) * p.mp[l], g(0) * p.sx[l] + g(1) * p.sy[l] + g(2) * p.sz[l]);
}

template <int dim, class What, class Meanwhile>
void projectChunk(const ChunkWeights<dim, shape::CPDI>& w, const ParticleRecords<dim, What>& particles, int count,
                  typename What::Node* window, const state::NodeBox& box, Meanwhile&& meanwhile)
{
    using Node = typename What::Node;
    for (int l = 0; l < count; ++l)
    {
        if (l % 8 == 0)
            meanwhile();
        for (int c = 0; c < 1 << dim; ++c)
        {
            const Node share = shareOfCorner(particles, w, c, l);
            aroundCorner<dim>(w, c, l, box, [&](Index at, double N) { window[at] += splat<Node>(N) * share; });
        }
    }
}

template <int dim, class Meanwhile>
void gatherCornerValues(const ChunkWeights<dim, shape::CPDI>& w, const typename ValueNode<dim>::Type* window,
                        const state::NodeBox& box, Values<dim>& out, Meanwhile&& meanwhile)
{
    using Node = typename ValueNode<dim>::Type;
    constexpr double share = dim == 2 ? 0.25 : 0.125;
    for (int l = 0; l < lanes; ++l)
    {
        if (l % 8 == 0)
            meanwhile();
        Node sum{};
        for (int c = 0; c < 1 << dim; ++c)
            aroundCorner<dim>(w, c, l, box, [&](Index at, double N) { sum += splat<Node>(N) * window[at]; });
        for (int a = 0; a < dim; ++a)
        {
            out.v[a][l] = share * sum[a];
            out.a[a][l] = share * sum[dim + a];
        }
    }
}

template <int dim, class Meanwhile>
void gatherCornerGradient(const ChunkWeights<dim, shape::CPDI>& w, const HalfRecord* window, const state::NodeBox& box,
                          double (&L)[dim * dim][lanes], Meanwhile&& meanwhile)
{
    for (int l = 0; l < lanes; ++l)
    {
        if (l % 8 == 0)
            meanwhile();
        HalfRecord slope[dim] = {};
        for (int c = 0; c < 1 << dim; ++c)
        {
            HalfRecord value{};
            aroundCorner<dim>(w, c, l, box, [&](Index at, double N) { value += splat<HalfRecord>(N) * window[at]; });
            for (int b = 0; b < dim; ++b)
                slope[b] += splat<HalfRecord>(w.at.g[b][c][l]) * value;
        }
        for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
                L[a * dim + b][l] = slope[b][a];
    }
}

template <class Meanwhile>
void gatherValues(const ChunkWeights<2, shape::CPDI>& w, const ValueNode<2>::Type* window, const state::NodeBox& box,
                  Values<2>& out, Meanwhile&& meanwhile)
{
    gatherCornerValues<2>(w, window, box, out, meanwhile);
}
template <class Meanwhile>
void gatherGradient(const ChunkWeights<2, shape::CPDI>& w, const HalfRecord* window, const state::NodeBox& box,
                    double (&L)[4][lanes], Meanwhile&& meanwhile)
{
    gatherCornerGradient<2>(w, window, box, L, meanwhile);
}
template <class Meanwhile>
void gatherValues(const ChunkWeights<3, shape::CPDI>& w, const ValueNode<3>::Type* window, const state::NodeBox& box,
                  Values<3>& out, Meanwhile&& meanwhile)
{
    gatherCornerValues<3>(w, window, box, out, meanwhile);
}
template <class Meanwhile>
void gatherGradient(const ChunkWeights<3, shape::CPDI>& w, const HalfRecord* window, const state::NodeBox& box,
                    double (&L)[9][lanes], Meanwhile&& meanwhile)
{
    gatherCornerGradient<3>(w, window, box, L, meanwhile);
}

/// See affine.hpp.
template <int dim, class Visit>
MPM_INLINE void eachNode(const ChunkWeights<dim, shape::CPDI>& w, int l, const state::NodeBox& box, Visit&& visit)
{
    constexpr double share = dim == 2 ? 0.25 : 0.125;
    for (int c = 0; c < 1 << dim; ++c)
        for (int k = 0; k < (dim == 3 ? 2 : 1); ++k)
            for (int j = 0; j < 2; ++j)
                for (int i = 0; i < 2; ++i)
                {
                    double N = share * w.hat(0, c, l, i) * w.hat(1, c, l, j);
                    std::array<Index, dim> node{w.at.cell[0][c][l] + i, w.at.cell[1][c][l] + j};
                    if constexpr (dim == 3)
                    {
                        N *= w.hat(2, c, l, k);
                        node[2] = w.at.cell[2][c][l] + k;
                    }
                    visit(w.offset[c][l] + i + (j + k * box.n[1]) * box.n[0], N, node);
                }
}
} // namespace mpm::transfer

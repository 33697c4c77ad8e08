#pragma once
/// Interpolation from nodes to particles, METHOD Eqs. 5, 6 and 8: for one chunk,
///     values    sum N_ip r_i                    (r_i: the node's record, all eight lanes)
///     gradients sum r_i gradN_ip
/// delivered as columns (lane of the record, lane of the chunk).
#include "transfer/chunkWeights.hpp"

namespace mpm::transfer
{
/// Columns gathered for one chunk: value[k] and gradient[axis][k] of record lane k.
template <int dim>
struct Gathered
{
    alignas(64) double value[8][lanes];
    alignas(64) double gradient[dim][8][lanes];
};

template <int n, bool gradients>
inline void gatherSupport(const shape::AxisWeights<n> (&w)[2], int l, const Record* first, Index nx, Index,
                          Record& value, Record (&gradient)[2])
{
    Record v{}, gx{}, gy{};
    for (int j = 0; j < n; ++j)
    {
        const Record* row = first + j * nx;
        Record s{}, t{};
        for (int i = 0; i < n; ++i)
        {
            s += w[0].N[i][l] * row[i];
            if constexpr (gradients)
                t += w[0].G[i][l] * row[i];
        }
        v += w[1].N[j][l] * s;
        if constexpr (gradients)
        {
            gx += w[1].N[j][l] * t;
            gy += w[1].G[j][l] * s;
        }
    }
    value = v;
    gradient[0] = gx;
    gradient[1] = gy;
}

template <int n, bool gradients>
inline void gatherSupport(const shape::AxisWeights<n> (&w)[3], int l, const Record* first, Index nx, Index nxy,
                          Record& value, Record (&gradient)[3])
{
    Record v{}, gx{}, gy{}, gz{};
    for (int k = 0; k < n; ++k)
    {
        Record layer{}, layerX{}, layerY{};
        for (int j = 0; j < n; ++j)
        {
            const Record* row = first + k * nxy + j * nx;
            Record s{}, t{};
            for (int i = 0; i < n; ++i)
            {
                s += w[0].N[i][l] * row[i];
                if constexpr (gradients)
                    t += w[0].G[i][l] * row[i];
            }
            layer += w[1].N[j][l] * s;
            if constexpr (gradients)
            {
                layerX += w[1].N[j][l] * t;
                layerY += w[1].G[j][l] * s;
            }
        }
        v += w[2].N[k][l] * layer;
        if constexpr (gradients)
        {
            gx += w[2].N[k][l] * layerX;
            gy += w[2].N[k][l] * layerY;
            gz += w[2].G[k][l] * layer;
        }
    }
    value = v;
    gradient[0] = gx;
    gradient[1] = gy;
    gradient[2] = gz;
}

/// Gathers the whole chunk; lanes from `count` on repeat the last particle.
template <int dim, class Shape, bool gradients>
void gatherChunk(const ChunkWeights<dim, Shape>& w, int count, const state::NodeWindow& window, Gathered<dim>& out)
{
    alignas(64) std::int64_t offset[lanes];
    w.offsets(window, offset);
    const Index nx = window.n[0], nxy = window.n[0] * window.n[1];
    for (int g = 0; g < lanes; g += 8)
    {
        Record value[8], gradient[8][dim];
        for (int l = 0; l < 8; ++l)
        {
            const int lane = g + l < count ? g + l : count - 1;
            gatherSupport<Shape::nodes, gradients>(w.axis, lane, window.nodes.data() + offset[lane], nx, nxy, value[l],
                                                   gradient[l]);
        }
        transpose(value);
        for (int k = 0; k < 8; ++k)
            store(&out.value[k][g], value[k]);
        if constexpr (gradients)
            for (int a = 0; a < dim; ++a)
            {
                Record column[8];
                for (int l = 0; l < 8; ++l)
                    column[l] = gradient[l][a];
                transpose(column);
                for (int k = 0; k < 8; ++k)
                    store(&out.gradient[a][k][g], column[k]);
            }
    }
}
} // namespace mpm::transfer

#pragma once
/// Interpolation from nodes to particles, METHOD Eqs. 5, 6 and 8, for one chunk:
///     values    v*(x_p) = sum N_ip v*_i and a(x_p) = sum N_ip a_i
///     gradient  L_p = sum w_i gradN_ip, L[a][b] = dw_a/dx_b
/// Nodes are read from windows repacked for the purpose: (v*, a) for values; the velocity w as often as a lane-wise
/// choice between N and its gradient G needs it, (w_x w_y w_x w_y) in 2D and (w - w -) in 3D, whose lanes take
/// (G G N N) of the x axis and (N N G G) of the y axis.
///
/// Verified in tests/unit/transfer.cpp against sums over pairs of particles and nodes.
#include "transfer/chunkWeights.hpp"

namespace mpm::transfer
{
template <int dim>
struct ValueNode;
template <>
struct ValueNode<2>
{
    using Type = HalfRecord;
    static Type pack(const Record& r) { return shuffle<1, 2, 3, 4>(r, r); }
};
template <>
struct ValueNode<3>
{
    using Type = Record;
    static Type pack(const Record& r) { return shuffle<1, 2, 3, 4, 5, 6, 7, 7>(r, r); }
};

/// Packs the velocity in lanes `lane`.. of a node record.
template <int dim, int lane>
struct GradientNode
{
    using Type = std::conditional_t<dim == 2, HalfRecord, Record>;
    static Type pack(const Record& r)
    {
        if constexpr (dim == 2)
            return shuffle<lane, lane + 1, lane, lane + 1>(r, r);
        else
            return shuffle<lane, lane + 1, lane + 2, 7, lane, lane + 1, lane + 2, 7>(r, r);
    }
};

/// Gathers work in groups of eight lanes; meanwhile() is called once a group (prefetching).
template <int dim>
struct Values
{
    alignas(64) double v[dim][lanes]; ///< v*(x_p)
    alignas(64) double a[dim][lanes];
};

/// Columns of eight half records: out[k][g .. g + 8).
inline void storeColumns(HalfRecord (&r)[8], double* const (&out)[4], int g)
{
    HalfRecord low[4], high[4];
    for (int k = 0; k < 4; ++k)
    {
        low[k] = r[k];
        high[k] = r[4 + k];
    }
    transpose(low);
    transpose(high);
    for (int k = 0; k < 4; ++k)
    {
        store(out[k] + g, low[k]);
        store(out[k] + g + 4, high[k]);
    }
}

template <class Shape, class Meanwhile>
void gatherValues(const ChunkWeights<2, Shape>& w, const HalfRecord* window, const state::NodeBox& box, Values<2>& out,
                  Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0];
    for (int g = 0; g < lanes; g += 8)
    {
        meanwhile();
        HalfRecord value[8];
        for (int l = 0; l < 8; ++l)
        {
            const HalfRecord* first = window + w.offset[g + l];
            HalfRecord sum{};
            MPM_UNROLL
            for (int j = 0; j < n; ++j)
            {
                HalfRecord row{};
                MPM_UNROLL
                for (int i = 0; i < n; ++i)
                    row += splat<HalfRecord>(w.axis[0].N[i][g + l]) * first[j * nx + i];
                sum += splat<HalfRecord>(w.axis[1].N[j][g + l]) * row;
            }
            value[l] = sum;
        }
        storeColumns(value, {out.v[0], out.v[1], out.a[0], out.a[1]}, g);
    }
}

template <class Shape, class Meanwhile>
void gatherValues(const ChunkWeights<3, Shape>& w, const Record* window, const state::NodeBox& box, Values<3>& out,
                  Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0], nxy = nx * box.n[1];
    for (int g = 0; g < lanes; g += 8)
    {
        meanwhile();
        Record value[8];
        for (int l = 0; l < 8; ++l)
        {
            const Record* first = window + w.offset[g + l];
            Record sum{};
            for (int k = 0; k < n; ++k)
            {
                Record layer{};
                MPM_UNROLL
                for (int j = 0; j < n; ++j)
                {
                    Record row{};
                    MPM_UNROLL
                    for (int i = 0; i < n; ++i)
                        row += splat<Record>(w.axis[0].N[i][g + l]) * first[k * nxy + j * nx + i];
                    layer += splat<Record>(w.axis[1].N[j][g + l]) * row;
                }
                sum += splat<Record>(w.axis[2].N[k][g + l]) * layer;
            }
            value[l] = sum;
        }
        transpose(value);
        for (int a = 0; a < 3; ++a)
        {
            store(out.v[a] + g, value[a]);
            store(out.a[a] + g, value[3 + a]);
        }
    }
}

/// L[a * dim + b] = dw_a/dx_b [1/s].
template <class Shape, class Meanwhile>
void gatherGradient(const ChunkWeights<2, Shape>& w, const HalfRecord* window, const state::NodeBox& box,
                    double (&L)[4][lanes], Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0];
    for (int g = 0; g < lanes; g += 8)
    {
        meanwhile();
        HalfRecord gradient[8];
        for (int l = 0; l < 8; ++l)
        {
            const HalfRecord* first = window + w.offset[g + l];
            HalfRecord x[n], sum{};
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
                x[i] = choose(HalfMask{-1, -1, 0, 0}, w.axis[0].G[i][g + l], w.axis[0].N[i][g + l]);
            MPM_UNROLL
            for (int j = 0; j < n; ++j)
            {
                HalfRecord row{};
                MPM_UNROLL
                for (int i = 0; i < n; ++i)
                    row += x[i] * first[j * nx + i];
                sum += choose(HalfMask{-1, -1, 0, 0}, w.axis[1].N[j][g + l], w.axis[1].G[j][g + l]) * row;
            }
            gradient[l] = sum;
        }
        storeColumns(gradient, {L[0], L[2], L[1], L[3]}, g);
    }
}

/// 3D: the lower half of a record takes dx, the upper half dy; dz comes from the upper half with G of the z axis.
template <class Shape, class Meanwhile>
void gatherGradient(const ChunkWeights<3, Shape>& w, const Record* window, const state::NodeBox& box,
                    double (&L)[9][lanes], Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0], nxy = nx * box.n[1];
    for (int g = 0; g < lanes; g += 8)
    {
        meanwhile();
        Record xy[8];
        HalfRecord z[8];
        for (int l = 0; l < 8; ++l)
        {
            const Record* first = window + w.offset[g + l];
            Record x[n], sumXY{};
            HalfRecord sumZ{};
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
                x[i] = choose(Mask{-1, -1, -1, -1, 0, 0, 0, 0}, w.axis[0].G[i][g + l], w.axis[0].N[i][g + l]);
            for (int k = 0; k < n; ++k)
            {
                Record layerXY{};
                HalfRecord layerZ{};
                MPM_UNROLL
                for (int j = 0; j < n; ++j)
                {
                    Record row{};
                    MPM_UNROLL
                    for (int i = 0; i < n; ++i)
                        row += x[i] * first[k * nxy + j * nx + i];
                    layerXY +=
                        choose(Mask{-1, -1, -1, -1, 0, 0, 0, 0}, w.axis[1].N[j][g + l], w.axis[1].G[j][g + l]) * row;
                    layerZ += splat<HalfRecord>(w.axis[1].N[j][g + l]) *
                              shuffle<4, 5, 6, 7>(row, row);
                }
                sumXY += splat<Record>(w.axis[2].N[k][g + l]) * layerXY;
                sumZ += splat<HalfRecord>(w.axis[2].G[k][g + l]) * layerZ;
            }
            xy[l] = sumXY;
            z[l] = sumZ;
        }
        transpose(xy);
        for (int a = 0; a < 3; ++a)
        {
            store(L[3 * a] + g, xy[a]);
            store(L[3 * a + 1] + g, xy[4 + a]);
        }
        alignas(64) double unused[lanes];
        storeColumns(z, {L[2], L[5], L[8], unused}, g);
    }
}
} // namespace mpm::transfer

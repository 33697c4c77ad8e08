#pragma once
/// Interpolation from nodes to particles, METHOD Eqs. 5, 6 and 8, for one chunk:
///     values    v*(x_p) = sum N_ip v*_i and a(x_p) = sum N_ip a_i
///     gradient  L_p = sum w_i gradN_ip, L[a][b] = dw_a/dx_b
/// Nodes are read from windows repacked for the purpose: (v*, a) for values; for gradients w, in 2D twice, (w_x w_y w_x
/// w_y), whose lanes take (G G N N) of the x axis and (N N G G) of the y axis.
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
    using Type = HalfRecord;
    static Type pack(const Record& r)
    {
        if constexpr (dim == 2)
            return shuffle<lane, lane + 1, lane, lane + 1>(r, r);
        else
            return shuffle<lane, lane + 1, lane + 2, 7>(r, r);
    }
};

/// Gathers call meanwhile() once every eight lanes (prefetching).
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

/// Calls body.operator()<lane>() for four lanes one after another. Weights of four particles are loaded together and
/// spread from lane to lane by shuffles: loaded one by one, those of a particle lie at the same place of as many cache
/// lines, of which a core reads one a cycle.
template <class Body>
MPM_INLINE void forFourLanes(Body&& body)
{
    body.template operator()<0>();
    body.template operator()<1>();
    body.template operator()<2>();
    body.template operator()<3>();
}

/// Columns of four half records: out[k][g .. g + 4).
MPM_INLINE void storeFour(HalfRecord (&r)[4], double* const (&out)[4], int g)
{
    transpose(r);
    MPM_UNROLL
    for (int k = 0; k < 4; ++k)
        store(out[k] + g, r[k]);
}

template <class Shape, class Meanwhile>
[[gnu::noinline]] void gatherValues(const ChunkWeights<2, Shape>& w, const HalfRecord* window,
                                    const state::NodeBox& box, Values<2>& out, Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0];
    for (int g = 0; g < lanes; g += 4)
    {
        if (g % 8 == 0)
            meanwhile();
        HalfRecord x[n], y[n], value[4];
        loadRow(w.axis[0].N, g, x);
        loadRow(w.axis[1].N, g, y);
        forFourLanes([&]<int l>() __attribute__((always_inline)) {
            const HalfRecord* row = opaque(window + w.offset[g + l]);
            HalfRecord sum{};
            MPM_UNROLL
            for (int j = 0; j < n; ++j)
            {
                HalfRecord along{};
                MPM_UNROLL
                for (int i = 0; i < n; ++i)
                    along += shuffle<l, l, l, l>(x[i], x[i]) * row[i];
                sum += shuffle<l, l, l, l>(y[j], y[j]) * along;
                row += nx;
            }
            value[l] = sum;
        });
        storeFour(value, {out.v[0], out.v[1], out.a[0], out.a[1]}, g);
    }
}

/// sum N_i r_i along an axis. As sum N = 1, of three nodes the middle one needs no product; the differences are taken
/// where a core adds while it multiplies.
template <int n, class R>
MPM_INLINE R weighted(const R (&N)[n], const R (&r)[n])
{
    if constexpr (n == 3)
        return r[1] - N[0] * (r[1] - r[0]) - N[2] * (r[1] - r[2]);
    R sum{};
    MPM_UNROLL
    for (int i = 0; i < n; ++i)
        sum += N[i] * r[i];
    return sum;
}

/// sum G_i r_i along an axis, the same way: sum G = 0.
template <int n, class R>
MPM_INLINE R sloped(const R (&G)[n], const R (&r)[n])
{
    if constexpr (n == 3)
        return -(G[0] * (r[1] - r[0])) - G[2] * (r[1] - r[2]);
    return weighted<n, R>(G, r);
}

/// A row of nodes, the middle one of three for several uses.
template <int n, class R>
MPM_INLINE void loadNodes(const R* row, R (&r)[n])
{
    MPM_UNROLL
    for (int i = 0; i < n; ++i)
        r[i] = n == 3 && i == 1 ? inRegister(row[i]) : row[i];
}

/// The weights of one lane along an axis, each in all lanes of a register.
template <int n, class R>
MPM_INLINE void spread(const double (&from)[n][lanes], int lane, R (&to)[n])
{
    MPM_UNROLL
    for (int i = 0; i < n; ++i)
        to[i] = splat<R>(from[i][lane]);
}

template <class Shape, class Meanwhile>
[[gnu::noinline]] void gatherValues(const ChunkWeights<3, Shape>& w, const Record* window, const state::NodeBox& box,
                                    Values<3>& out, Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0], nxy = nx * box.n[1];
    for (int g = 0; g < lanes; g += 8)
    {
        meanwhile();
        Record value[8];
        for (int l = 0; l < 8; ++l)
        {
            const Record* layer = opaque(window + w.offset[g + l]);
            Record x[n], y[n], z[n], inLayer[n];
            spread(w.axis[0].N, g + l, x);
            spread(w.axis[1].N, g + l, y);
            spread(w.axis[2].N, g + l, z);
            MPM_UNROLL
            for (int k = 0; k < n; ++k)
            {
                const Record* row = layer;
                Record along[n];
                MPM_UNROLL
                for (int j = 0; j < n; ++j)
                {
                    Record r[n];
                    loadNodes(row, r);
                    along[j] = weighted(x, r);
                    row += nx;
                }
                inLayer[k] = weighted(y, along);
                layer = opaque(layer + nxy);
            }
            value[l] = weighted(z, inLayer);
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
[[gnu::noinline]] void gatherGradient(const ChunkWeights<2, Shape>& w, const HalfRecord* window,
                                      const state::NodeBox& box, double (&L)[4][lanes], Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0];
    for (int g = 0; g < lanes; g += 4)
    {
        if (g % 8 == 0)
            meanwhile();
        HalfRecord Nx[n], Gx[n], Ny[n], Gy[n], gradient[4];
        loadRow(w.axis[0].N, g, Nx);
        loadRow(w.axis[0].G, g, Gx);
        loadRow(w.axis[1].N, g, Ny);
        loadRow(w.axis[1].G, g, Gy);
        forFourLanes([&]<int l>() __attribute__((always_inline)) {
            const HalfRecord* row = opaque(window + w.offset[g + l]);
            HalfRecord x[n], sum{};
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
                x[i] = shuffle<l, l, 4 + l, 4 + l>(Gx[i], Nx[i]);
            MPM_UNROLL
            for (int j = 0; j < n; ++j)
            {
                HalfRecord along{};
                MPM_UNROLL
                for (int i = 0; i < n; ++i)
                    along += x[i] * row[i];
                sum += shuffle<l, l, 4 + l, 4 + l>(Ny[j], Gy[j]) * along;
                row += nx;
            }
            gradient[l] = sum;
        });
        storeFour(gradient, {L[0], L[2], L[1], L[3]}, g);
    }
}

template <class Shape, class Meanwhile>
[[gnu::noinline]] void gatherGradient(const ChunkWeights<3, Shape>& w, const HalfRecord* window,
                                      const state::NodeBox& box, double (&L)[9][lanes], Meanwhile&& meanwhile)
{
    constexpr int n = Shape::nodes;
    const Index nx = box.n[0], nxy = nx * box.n[1];
    alignas(64) double unused[lanes];
    for (int g = 0; g < lanes; g += 8)
    {
        meanwhile();
        HalfRecord dx[8], dy[8], dz[8];
        for (int l = 0; l < 8; ++l)
        {
            const HalfRecord* layer = opaque(window + w.offset[g + l]);
            HalfRecord N[3][n], G[3][n], layerX[n], layerY[n], layerZ[n];
            MPM_UNROLL
            for (int a = 0; a < 3; ++a)
            {
                spread(w.axis[a].N, g + l, N[a]);
                spread(w.axis[a].G, g + l, G[a]);
            }
            MPM_UNROLL
            for (int k = 0; k < n; ++k)
            {
                const HalfRecord* row = layer;
                HalfRecord along[n], slope[n];
                MPM_UNROLL
                for (int j = 0; j < n; ++j)
                {
                    HalfRecord r[n];
                    loadNodes(row, r);
                    along[j] = weighted(N[0], r);
                    slope[j] = sloped(G[0], r);
                    row += nx;
                }
                layerX[k] = weighted(N[1], slope);
                layerY[k] = sloped(G[1], along);
                layerZ[k] = weighted(N[1], along);
                layer = opaque(layer + nxy);
            }
            dx[l] = weighted(N[2], layerX);
            dy[l] = weighted(N[2], layerY);
            dz[l] = sloped(G[2], layerZ);
        }
        storeColumns(dx, {L[0], L[3], L[6], unused}, g);
        storeColumns(dy, {L[1], L[4], L[7], unused}, g);
        storeColumns(dz, {L[2], L[5], L[8], unused}, g);
    }
}
} // namespace mpm::transfer

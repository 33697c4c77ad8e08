#pragma once
/// Projection of particles to nodes, METHOD Eqs. 2, 3 and 7:
///     m_i = sum m_p N_ip,   p_i = sum m_p v_p N_ip,   f_i = - sum V_p sigma_p . gradN_ip
/// Shape functions are products over axes, and so are the terms of these sums. Which factor an axis contributes, N or
/// its gradient G, can then depend on the lane of a record: in 2D the record (m, p_x, p_y, s_xx, s_xy, s_xy, s_yy),
/// s = -V sigma, is multiplied by (N N N G G N N) of the x axis and (N N N N N G G) of the y axis; the two halves of
/// the force are added when windows are summed (finishNode). Lanes of a run share the first node (particles are
/// sorted), so the run is summed in registers and added to memory once.
///
/// Verified in tests/unit/transfer.cpp against sums over pairs of particles and nodes.
#include "transfer/chunkWeights.hpp"

namespace mpm::transfer
{
/// What a pass projects.
struct Momentum ///< mass and momentum: (m, p), half a record
{
    using Node = HalfRecord;
};
struct Forces ///< mass, momentum and internal force
{
    using Node = Record;
};

/// Four columns of eight numbers -> the half records of eight particles.
MPM_INLINE void deal(const Record (&columns)[4], HalfRecord* out)
{
    HalfRecord low[4], high[4];
    for (int k = 0; k < 4; ++k)
    {
        low[k] = shuffle<0, 1, 2, 3>(columns[k], columns[k]);
        high[k] = shuffle<4, 5, 6, 7>(columns[k], columns[k]);
    }
    transpose(low);
    transpose(high);
    for (int l = 0; l < 4; ++l)
    {
        out[l] = low[l];
        out[4 + l] = high[l];
    }
}

/// The records of a chunk's particles.
template <int dim, class What>
struct ParticleRecords;

template <int dim>
struct ParticleRecords<dim, Momentum>
{
    HalfRecord r[lanes];

    [[gnu::always_inline]] void build(const double (&mass)[lanes], const double (&v)[dim][lanes])
    {
        for (int g = 0; g < lanes; g += 8)
        {
            const Record m = load(mass + g);
            Record t[4] = {m};
            for (int a = 0; a < dim; ++a)
                t[1 + a] = m * load(v[a] + g);
            deal(t, r + g);
        }
    }
};

template <>
struct ParticleRecords<2, Forces>
{
    Record r[lanes];

    void build(const double (&mass)[lanes], const double (&v)[2][lanes], const double (&volume)[lanes],
               const double (&stress)[4][lanes])
    {
        for (int g = 0; g < lanes; g += 8)
        {
            const Record m = load(mass + g), minusV = -load(volume + g), shear = minusV * load(stress[3] + g);
            Record t[8] = {m,     m * load(v[0] + g),          m * load(v[1] + g), minusV * load(stress[0] + g), shear,
                           shear, minusV * load(stress[1] + g)};
            transpose(t);
            for (int l = 0; l < 8; ++l)
                r[g + l] = t[l];
        }
    }
};

/// 3D: mass and momentum (m, p), and the columns of s = -V sigma, (s_x -), (s_y -), (s_z -).
template <>
struct ParticleRecords<3, Forces>
{
    HalfRecord mp[lanes], sx[lanes], sy[lanes], sz[lanes];

    void build(const double (&mass)[lanes], const double (&v)[3][lanes], const double (&volume)[lanes],
               const double (&stress)[6][lanes])
    {
        for (int g = 0; g < lanes; g += 8)
        {
            const Record m = load(mass + g), minusV = -load(volume + g);
            Record s[6];
            for (int k = 0; k < 6; ++k)
                s[k] = minusV * load(stress[k] + g);
            deal({m, m * load(v[0] + g), m * load(v[1] + g), m * load(v[2] + g)}, mp + g);
            deal({s[0], s[3], s[5], Record{}}, sx + g);
            deal({s[3], s[1], s[4], Record{}}, sy + g);
            deal({s[5], s[4], s[2], Record{}}, sz + g);
        }
    }
};

template <class R, int count>
inline void zero(R (&sum)[count])
{
    MPM_UNROLL
    for (int k = 0; k < count; ++k)
        sum[k] = R{};
}

template <int n, class R>
inline void addLayer(const R (&sum)[n * n], R* first, Index nx)
{
    R* row = opaque(first);
    MPM_UNROLL
    for (int j = 0; j < n; ++j)
    {
        MPM_UNROLL
        for (int i = 0; i < n; ++i)
            row[i] += sum[j * n + i];
        row = opaque(row + nx);
    }
}

/// Sums lanes [l0, l1), which share their first node, and adds them to the nodes. 2D, records weighted by N as a whole
/// (mass and momentum; stressTransfer.hpp).
template <int n, class What>
inline void projectRun(const shape::AxisWeights<n> (&w)[2], const ParticleRecords<2, What>& p, int l0, int l1,
                       typename What::Node* first, Index nx, Index)
{
    using Node = typename What::Node;
    Node sum[n * n];
    zero(sum);
    for (int l = l0; l < l1; ++l)
    {
        Node x[n];
        MPM_UNROLL
        for (int i = 0; i < n; ++i)
            x[i] = splat<Node>(w[0].N[i][l]);
        MPM_UNROLL
        for (int j = 0; j < n; ++j)
        {
            const Node row = splat<Node>(w[1].N[j][l]) * p.r[l];
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
                sum[j * n + i] += x[i] * row;
        }
    }
    addLayer<n>(sum, first, nx);
}

/// 2D with internal force.
template <int n>
inline void projectRun(const shape::AxisWeights<n> (&w)[2], const ParticleRecords<2, Forces>& p, int l0, int l1,
                       Record* first, Index nx, Index)
{
    Record sum[n * n];
    zero(sum);
    for (int l = l0; l < l1; ++l)
    {
        Record x[n];
        MPM_UNROLL
        for (int i = 0; i < n; ++i)
            x[i] = choose(Mask{-1, -1, -1, 0, 0, -1, -1, -1}, w[0].N[i][l], w[0].G[i][l]);
        MPM_UNROLL
        for (int j = 0; j < n; ++j)
        {
            const Record y = choose(Mask{-1, -1, -1, -1, -1, 0, 0, -1}, w[1].N[j][l], w[1].G[j][l]);
            const Record row = y * p.r[l];
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
                sum[j * n + i] += x[i] * row;
        }
    }
    addLayer<n>(sum, first, nx);
}

/// Sums over a layer of three nodes an axis are taken with the weights (N_0, 1, N_2) and (G_0, 0, G_2): sum N = 1 and
/// sum G = 0 make the middle node's share of what is left over, once a run instead of once a particle. Not for other
/// supports, whose inner nodes can weigh so little that nothing of them would be left.
template <int n>
inline constexpr int leftOver = n == 3 ? 1 : -1;

template <int n, class R>
MPM_INLINE void dealLeftOver(R (&sum)[n * n])
{
    if constexpr (n == 3)
    {
        MPM_UNROLL
        for (int j = 0; j < 3; ++j)
            sum[3 * j + 1] -= sum[3 * j] + sum[3 * j + 2];
        MPM_UNROLL
        for (int i = 0; i < 3; ++i)
            sum[3 + i] -= sum[i] + sum[6 + i];
    }
}

/// 3D, layer by layer so that the sums of a layer stay in registers.
template <int n, class What>
inline void projectRun(const shape::AxisWeights<n> (&w)[3], const ParticleRecords<3, What>& p, int l0, int l1,
                       typename What::Node* first, Index nx, Index nxy)
{
    using Node = typename What::Node;
    for (int k = 0; k < n; ++k)
    {
        Node sum[n * n];
        zero(sum);
        for (int l = l0; l < l1; ++l)
        {
            const Node layer = splat<Node>(w[2].N[k][l]) * p.r[l];
            MPM_UNROLL
            for (int j = 0; j < n; ++j)
            {
                const Node row = j == leftOver<n> ? layer : splat<Node>(w[1].N[j][l]) * layer;
                MPM_UNROLL
                for (int i = 0; i < n; ++i)
                    sum[j * n + i] += i == leftOver<n> ? row : splat<Node>(w[0].N[i][l]) * row;
            }
        }
        dealLeftOver<n>(sum);
        addLayer<n>(sum, first + k * nxy, nx);
    }
}

/// 3D with internal force: f takes (G N N) s_x + (N G N) s_y + (N N G) s_z.
template <int n>
inline void projectRun(const shape::AxisWeights<n> (&w)[3], const ParticleRecords<3, Forces>& p, int l0, int l1,
                       Record* first, Index nx, Index nxy)
{
    for (int k = 0; k < n; ++k)
    {
        HalfRecord mp[n * n], f[n * n];
        zero(mp);
        zero(f);
        for (int l = l0; l < l1; ++l)
        {
            const HalfRecord nz = splat<HalfRecord>(w[2].N[k][l]);
            const HalfRecord momentum = nz * p.mp[l], alongX = nz * p.sx[l], alongY = nz * p.sy[l];
            const HalfRecord alongZ = splat<HalfRecord>(w[2].G[k][l]) * p.sz[l];
            HalfRecord nxOf[n], gxOf[n];
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
            {
                nxOf[i] = splat<HalfRecord>(w[0].N[i][l]);
                gxOf[i] = splat<HalfRecord>(w[0].G[i][l]);
            }
            MPM_UNROLL
            for (int j = 0; j < n; ++j)
            {
                const bool rest = j == leftOver<n>;
                const HalfRecord ny = splat<HalfRecord>(w[1].N[j][l]);
                const HalfRecord row = rest ? momentum : ny * momentum, slope = rest ? alongX : ny * alongX;
                const HalfRecord plain = rest ? alongZ : ny * alongZ + splat<HalfRecord>(w[1].G[j][l]) * alongY;
                MPM_UNROLL
                for (int i = 0; i < n; ++i)
                {
                    mp[j * n + i] += i == leftOver<n> ? row : nxOf[i] * row;
                    f[j * n + i] += i == leftOver<n> ? plain : nxOf[i] * plain + gxOf[i] * slope;
                }
            }
        }
        dealLeftOver<n>(mp);
        dealLeftOver<n>(f);
        Record* row = opaque(first + k * nxy);
        MPM_UNROLL
        for (int j = 0; j < n; ++j)
        {
            MPM_UNROLL
            for (int i = 0; i < n; ++i)
                row[i] += join(mp[j * n + i], f[j * n + i]);
            row = opaque(row + nx);
        }
    }
}

/// Adds `count` lanes of a chunk to a window of nodes; meanwhile() is called once a run (prefetching).
template <int dim, class Shape, class What, class Meanwhile>
void projectChunk(const ChunkWeights<dim, Shape>& w, const ParticleRecords<dim, What>& particles, int count,
                  typename What::Node* window, const state::NodeBox& box, Meanwhile&& meanwhile)
{
    for (int l = 0; l < count;)
    {
        int end = l + 1;
        while (end < count && w.offset[end] == w.offset[l])
            ++end;
        meanwhile();
        projectRun<Shape::nodes>(w.axis, particles, l, end, window + w.offset[l], box.n[0], box.n[0] * box.n[1]);
        l = end;
    }
}

/// A summed record of projected forces -> (m, p, f).
template <int dim>
inline Record finishNode(const Record& r)
{
    if constexpr (dim == 3)
        return r;
    else
        return shuffle<0, 1, 2, 3, 4, 8, 8, 8>(r, Record{}) + shuffle<8, 8, 8, 5, 6, 8, 8, 8>(r, Record{});
}
/// A summed half record -> (m, p, 0).
template <int dim>
inline Record finishNode(const HalfRecord& r)
{
    return dim == 3 ? Record{r[0], r[1], r[2], r[3]} : Record{r[0], r[1], r[2]};
}
} // namespace mpm::transfer

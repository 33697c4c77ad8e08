#pragma once
/// Projection of particles to nodes, METHOD Eqs. 2, 3 and 7:
///     m_i = sum m_p N_ip,   p_i = sum m_p v_p N_ip,   f_i = - sum V_p sigma_p . gradN_ip + sum m_p b_p N_ip
/// A particle's contribution to node (a, b, c) is N A + dN/dx B_x + dN/dy B_y + dN/dz B_z with records
/// A = (m, m v, m b), B_k = (0, 0, -V sigma_k). Lanes of a run share the first node (particles are sorted), so the run
/// is summed in registers and added to memory once.
#include "transfer/chunkWeights.hpp"

namespace mpm::transfer
{
enum class Project
{
    momentum,         ///< mass and momentum (the strains of USF, the second projection of MUSL)
    momentumAndForces ///< mass, momentum, internal and body force
};

template <int dim, int n>
inline constexpr int supportNodes = dim == 2 ? n* n : n* n* n;
/// Records of all nodes of a support.
template <int dim, int n>
using Support = Record[supportNodes<dim, n>];

/// Adds one particle's records to the accumulated support.
template <int n, bool forces>
inline void addToSupport(const shape::AxisWeights<n> (&w)[2], int l, const Record& a, const Record (&b)[3],
                         Support<2, n>& sum)
{
    for (int j = 0; j < n; ++j)
    {
        Record plain = w[1].N[j][l] * a;
        if constexpr (forces)
        {
            plain += w[1].G[j][l] * b[1];
            const Record alongX = w[1].N[j][l] * b[0];
            for (int i = 0; i < n; ++i)
                sum[j * n + i] += w[0].N[i][l] * plain + w[0].G[i][l] * alongX;
        }
        else
            for (int i = 0; i < n; ++i)
                sum[j * n + i] += w[0].N[i][l] * plain;
    }
}

template <int n, bool forces>
inline void addToSupport(const shape::AxisWeights<n> (&w)[3], int l, const Record& a, const Record (&b)[3],
                         Support<3, n>& sum)
{
    for (int k = 0; k < n; ++k)
    {
        const double nz = w[2].N[k][l];
        Record layer = nz * a, alongY{}, alongX{};
        if constexpr (forces)
        {
            layer += w[2].G[k][l] * b[2];
            alongY = nz * b[1];
            alongX = nz * b[0];
        }
        for (int j = 0; j < n; ++j)
        {
            Record plain = w[1].N[j][l] * layer;
            Record* row = sum + (k * n + j) * n;
            if constexpr (forces)
            {
                plain += w[1].G[j][l] * alongY;
                const Record x = w[1].N[j][l] * alongX;
                for (int i = 0; i < n; ++i)
                    row[i] += w[0].N[i][l] * plain + w[0].G[i][l] * x;
            }
            else
                for (int i = 0; i < n; ++i)
                    row[i] += w[0].N[i][l] * plain;
        }
    }
}

/// Adds a summed support to the window and clears it.
template <int dim, int n>
inline void flushSupport(Support<dim, n>& sum, Record* first, const state::NodeWindow& window)
{
    const Index nx = window.n[0], nxy = window.n[0] * window.n[1];
    for (int k = 0; k < (dim == 3 ? n : 1); ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                Record& s = sum[(k * n + j) * n + i];
                first[k * nxy + j * nx + i] += s;
                s = Record{};
            }
}

/// The records A and B of all lanes of a chunk, built from columns by 8 x 8 transposes.
template <int dim>
struct ChunkRecords
{
    Record a[lanes];
    Record b[lanes][3];

    /// `velocity` may be the columns of the particles or of an updated chunk; `bodyForce` (acceleration) may be null.
    template <bool forces>
    void build(const state::Particles& p, Index first, const double* const (&velocity)[dim],
               const double (*bodyForce)[lanes])
    {
        static constexpr int component[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}; // stress columns of sigma_k
        for (int g = 0; g < lanes / 8; ++g)
        {
            const Record m = load(p.mass.data() + first + 8 * g);
            Record r[8] = {m};
            for (int k = 0; k < dim; ++k)
            {
                r[1 + k] = m * load(velocity[k] + 8 * g);
                if (forces && bodyForce)
                    r[1 + dim + k] = m * load(&bodyForce[k][8 * g]);
            }
            transpose(r);
            for (int l = 0; l < 8; ++l)
                a[8 * g + l] = r[l];
            if constexpr (forces)
            {
                const Record volume = load(p.volume.data() + first + 8 * g);
                for (int row = 0; row < dim; ++row)
                {
                    Record s[8] = {};
                    for (int k = 0; k < dim; ++k)
                        s[1 + dim + k] = -volume * load(p.stress[component[row][k]].data() + first + 8 * g);
                    transpose(s);
                    for (int l = 0; l < 8; ++l)
                        b[8 * g + l][row] = s[l];
                }
            }
        }
    }
};

/// Adds `count` lanes of a chunk to the window.
template <int dim, class Shape, bool forces>
void scatterChunk(const ChunkWeights<dim, Shape>& w, const ChunkRecords<dim>& records, int count,
                  state::NodeWindow& window)
{
    constexpr int n = Shape::nodes;
    alignas(64) std::int64_t offset[lanes];
    w.offsets(window, offset);
    Support<dim, n> sum = {};
    std::int64_t current = offset[0];
    for (int l = 0; l < count; ++l)
    {
        if (offset[l] != current)
        {
            flushSupport<dim, n>(sum, window.nodes.data() + current, window);
            current = offset[l];
        }
        addToSupport<n, forces>(w.axis, l, records.a[l], records.b[l], sum);
    }
    flushSupport<dim, n>(sum, window.nodes.data() + current, window);
}
} // namespace mpm::transfer

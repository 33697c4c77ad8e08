#pragma once
/// Transfers that carry an affine velocity field with each particle, v(x) = v_p + C_p (x - x_p):
///     p_i = sum m_p N_ip (v_p + C_p (x_i - x_p)),   v_p = sum N_ip v*_i
///     APIC   C_p = B_p D_p^-1,  B_p = sum N_ip v*_i (x) (x_i - x_p),  D_p = sum N_ip (x_i - x_p) (x) (x_i - x_p)
///            (Jiang, Schroeder, Selle, Teran & Stomakhin 2015, doi 10.1145/2766996): angular momentum is kept where D
///            does not change with the position, that is by splines away from walls
///     TPIC   C_p = sum v*_i (x) gradN_ip, the velocity gradient (Nakamura, Matsumura & Mizutani 2023,
///            doi 10.1016/j.cma.2022.115720)
/// Nothing of a particle's own velocity is kept, as in PIC; rotation and shear are not damped, because C carries them.
/// For hat functions both are the same. For shapes that are products over axes D is diagonal, because they keep linear
/// fields.
///
///     transfer   APIC;      // mpmSchemes; or TPIC
///
/// Verified in tests/unit/cornerWeights.cpp and transferSchemes.cpp.
#include "transfer/chunkWeights.hpp"

namespace mpm::transfer
{
/// Calls visit(place in the window, N, lattice indices of the node) for all nodes of a lane.
template <int dim, class Shape, class Visit>
MPM_INLINE void eachNode(const ChunkWeights<dim, Shape>& w, int l, const state::NodeBox& box, Visit&& visit)
{
    constexpr int n = Shape::nodes;
    for (int k = 0; k < (dim == 3 ? n : 1); ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                double N = w.axis[0].N[i][l] * w.axis[1].N[j][l];
                std::array<Index, dim> node{w.axis[0].base[l] + i, w.axis[1].base[l] + j};
                if constexpr (dim == 3)
                {
                    N *= w.axis[2].N[k][l];
                    node[2] = w.axis[2].base[l] + k;
                }
                visit(w.offset[l] + i + (j + k * box.n[1]) * box.n[0], N, node);
            }
}

/// Adds m_p b_p N_ip of a prescribed acceleration b to the first force lanes of a window.
template <int dim, class Weights>
void projectBodyForce(const Weights& w, const double (&mass)[lanes], const double (&b)[3][lanes], int count,
                      Record* window, const state::NodeBox& box)
{
    for (int l = 0; l < count; ++l)
        eachNode(w, l, box, [&](Index at, double N, const std::array<Index, dim>&) {
            for (int a = 0; a < dim; ++a)
                window[at][1 + dim + a] += mass[l] * b[a][l] * N;
        });
}

/// Adds m_p N_ip C_p (x_i - x_p) to the momentum lanes of a window.
template <int dim, class Weights, class Node>
void projectAffine(const Weights& w, const double (&mass)[lanes], const double (&C)[dim * dim][lanes],
                   const double (&x)[dim][lanes], const state::GridBox& grid, int count, Node* window,
                   const state::NodeBox& box)
{
    for (int l = 0; l < count; ++l)
        eachNode(w, l, box, [&](Index at, double N, const std::array<Index, dim>& node) {
            double d[dim];
            for (int b = 0; b < dim; ++b)
                d[b] = grid.origin[b] + grid.h * double(node[b]) - x[b][l];
            for (int a = 0; a < dim; ++a)
            {
                double velocity = 0;
                for (int b = 0; b < dim; ++b)
                    velocity += C[a * dim + b][l] * d[b];
                window[at][1 + a] += mass[l] * N * velocity;
            }
        });
}

/// Inverse of a small symmetric matrix, by cofactors.
template <int dim>
void invertMoments(const double (&D)[dim][dim], double (&inverse)[dim][dim])
{
    if constexpr (dim == 2)
    {
        const double over = 1 / (D[0][0] * D[1][1] - D[0][1] * D[1][0]);
        inverse[0][0] = D[1][1] * over;
        inverse[1][1] = D[0][0] * over;
        inverse[0][1] = inverse[1][0] = -D[0][1] * over;
    }
    else
    {
        const auto cofactor = [&](int i, int j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            return D[a][c] * D[b][d] - D[a][d] * D[b][c];
        };
        const double over = 1 / (D[0][0] * cofactor(0, 0) + D[0][1] * cofactor(0, 1) + D[0][2] * cofactor(0, 2));
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                inverse[j][i] = cofactor(i, j) * over;
    }
}

/// APIC's C_p from nodal velocities (lanes 0 .. dim of a window packed for gradients).
template <int dim, class Weights>
void gatherAffine(const Weights& w, const HalfRecord* window, const double (&x)[dim][lanes], const state::GridBox& grid,
                  int count, const state::NodeBox& box, double (&C)[dim * dim][lanes])
{
    constexpr bool productOverAxes = requires
    {
        w.axis;
    };
    for (int l = 0; l < count; ++l)
    {
        double B[dim][dim] = {}, D[dim][dim] = {}, inverse[dim][dim] = {};
        eachNode(w, l, box, [&](Index at, double N, const std::array<Index, dim>& node) {
            double d[dim];
            for (int b = 0; b < dim; ++b)
                d[b] = grid.origin[b] + grid.h * double(node[b]) - x[b][l];
            for (int a = 0; a < dim; ++a)
                for (int b = 0; b < dim; ++b)
                {
                    B[a][b] += N * window[at][a] * d[b];
                    D[a][b] += N * d[a] * d[b];
                }
        });
        if constexpr (productOverAxes)
            for (int b = 0; b < dim; ++b)
                inverse[b][b] = 1 / D[b][b];
        else
            invertMoments<dim>(D, inverse);
        for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
            {
                double value = 0;
                for (int k = 0; k < dim; ++k)
                    value += B[a][k] * inverse[k][b];
                C[a * dim + b][l] = value;
            }
    }
}
} // namespace mpm::transfer

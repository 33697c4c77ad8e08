#pragma once
/// Convected particle domain interpolation (Sadeghirad, Brannon & Burghardt 2011, doi 10.1002/nme.3110): the domain is
/// the parallelogram or parallelepiped that F makes of the initial box, edges e_k = F l0_k, and hats are interpolated
/// between its 2^d corners x_c = x_p + sum_k s_k e_k/2, s_k = -1 or 1:
///     N_ip = 2^-d sum_c N_i(x_c),   gradN_ip = sum_c N_i(x_c) g_c,   g_c = 2^(1-d) sum_k s_k E^-T_k
/// with E = (e_1 .. e_d) by columns and E^-T_k column k of its inverse transposed: the mean over the domain of the
/// gradient of what interpolates the corner values. Domains follow shear and rotation, not only stretch, and leave no
/// gaps in a homogeneous deformation; neighbours with different F overlap a little.
///
/// A corner may lie up to one cell from its particle along an axis; longer domains are scaled about their centre
/// (Homel, Brannon & Guilkey 2016, doi 10.1002/nme.5151) and counted, as those of cpGIMP are: splitting is the cure.
///
///     shape   CPDI;      // mpmSchemes
///
/// Verified in tests/unit/cornerWeights.cpp.
#include "shape/axisWeights.hpp"

namespace mpm::shape
{
/// Places and gradients of the corners of one chunk of domains.
template <int dim>
struct CornerWeights
{
    static constexpr int corners = 1 << dim;
    alignas(64) double place[dim][corners][lanes]; ///< of the corner in its cell, in [0, 1)
    alignas(64) double g[dim][corners][lanes];     ///< g_c [1/m]
    std::int32_t cell[dim][corners][lanes];        ///< lattice index of the node left of the corner
    alignas(64) std::int32_t base[dim][lanes];     ///< least lattice index a corner may reach
};

struct CPDI
{
    static constexpr const char* word = "CPDI";
    static constexpr int nodes = 4; ///< an axis, that any corner may reach
    static constexpr bool hasDomain = true;
    static constexpr bool followsStretch = false;
    static constexpr bool hasCorners = true;
    using Narrow = CPDI;
    static constexpr double widest = 1 - 1e-12; ///< of a corner from its particle, in cells

    /// edges[a * dim + k]: component a of e_k/2 in cells. x: positions [m].
    template <int dim>
    static void evaluate(const double (&x)[dim][lanes], const double (&edges)[dim * dim][lanes], const double* origin,
                         double invH, CornerWeights<dim>& w)
    {
        constexpr double share = dim == 2 ? 0.25 : 0.125;
        alignas(64) double inverse[dim * dim][lanes]; // row k, column a: component a of E^-T_k/2 over cells
        invert<dim>(edges, inverse);
        for (int a = 0; a < dim; ++a)
            for (int l = 0; l < lanes; ++l)
                w.base[a][l] = std::int32_t(std::floor((x[a][l] - origin[a]) * invH - 1));
        for (int c = 0; c < 1 << dim; ++c)
            for (int a = 0; a < dim; ++a)
                for (int l = 0; l < lanes; ++l)
                {
                    double s = (x[a][l] - origin[a]) * invH, slope = 0;
                    MPM_UNROLL
                    for (int k = 0; k < dim; ++k)
                    {
                        const double sign = (c >> k & 1) ? 1.0 : -1.0;
                        s += sign * edges[a * dim + k][l];
                        slope += sign * inverse[k * dim + a][l];
                    }
                    const double left = std::floor(s);
                    w.cell[a][c][l] = std::int32_t(left);
                    w.place[a][c][l] = s - left;
                    w.g[a][c][l] = share * invH * slope;
                }
    }

    /// Scales domains whose corners would reach further than `widest`; returns how many of `count` lanes.
    template <int dim>
    static int holdWithin(double (&edges)[dim * dim][lanes], int count)
    {
        constexpr double rounding = 1 + 1e-12;
        int held = 0;
        for (int l = 0; l < lanes; ++l)
        {
            double reach = 0;
            for (int a = 0; a < dim; ++a)
            {
                double along = 0;
                for (int k = 0; k < dim; ++k)
                    along += std::abs(edges[a * dim + k][l]);
                reach = along > reach ? along : reach;
            }
            const double scale = reach > widest ? widest / reach : 1;
            held += reach > rounding && l < count;
            for (int k = 0; k < dim * dim; ++k)
                edges[k][l] *= scale;
        }
        return held;
    }

  private:
    /// inverse[k * dim + a] = (E^-1)_ka, so that sum_a E_ak inverse_ka = 1.
    template <int dim>
    static void invert(const double (&E)[dim * dim][lanes], double (&inverse)[dim * dim][lanes])
    {
        for (int l = 0; l < lanes; ++l)
        {
            const auto e = [&](int a, int k) { return E[a * dim + k][l]; };
            if constexpr (dim == 2)
            {
                const double over = 1 / (e(0, 0) * e(1, 1) - e(0, 1) * e(1, 0));
                inverse[0][l] = e(1, 1) * over;
                inverse[1][l] = -e(0, 1) * over;
                inverse[2][l] = -e(1, 0) * over;
                inverse[3][l] = e(0, 0) * over;
            }
            else
            {
                const auto minor = [&](int a, int b, int k, int m) { return e(a, k) * e(b, m) - e(a, m) * e(b, k); };
                const double det =
                    e(0, 0) * minor(1, 2, 1, 2) - e(0, 1) * minor(1, 2, 0, 2) + e(0, 2) * minor(1, 2, 0, 1);
                const double over = 1 / det;
                MPM_UNROLL
                for (int k = 0; k < 3; ++k)
                    MPM_UNROLL
                for (int a = 0; a < 3; ++a)
                    inverse[k * 3 + a][l] = over * minor((a + 1) % 3, (a + 2) % 3, (k + 1) % 3, (k + 2) % 3);
            }
        }
    }
};
} // namespace mpm::shape

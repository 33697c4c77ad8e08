#pragma once
/// Cubic B-splines centred on nodes (Steffen, Kirby & Berzins 2008, doi 10.1002/nme.2360): with t = (x_p - x_i)/h from
/// the node on the left, 0 <= t < 1,
///     N = (1 - t)^3/6, (4 - 6 t^2 + 3 t^3)/6, (1 + 3 t + 3 t^2 - 3 t^3)/6, t^3/6     at the nodes i - 1 ... i + 2
/// Curvatures are continuous: the smoothest of the shapes, and the one whose errors in time are not hidden by kinks.
/// Particles are points.
///
/// At a wall the spline is folded: in the two cells beside the wall's plane the value at the node behind is taken as
/// u_{-1} = 2 u_0 - u_1, so that
///     N = 1 - t + t^3/6, t - t^3/3, t^3/6     at the nodes 0, 1, 2
/// The field at the wall is that of the wall's own node, linear fields are kept, and the curvature vanishes at the wall
/// (a natural end), which is what odd fields do there.
///
///     shape   cubicBSpline;      // mpmSchemes
///
/// Verified in tests/unit/shapes.cpp; order 2 at large strain in tests/verification/bar1D.
#include "shape/axisWeights.hpp"

namespace mpm::shape
{
struct CubicBSpline
{
    static constexpr const char* word = "cubicBSpline";
    static constexpr int nodes = 4;
    static constexpr bool hasDomain = false;
    static constexpr bool followsStretch = false;
    using Narrow = CubicBSpline;

    static void evaluate(const double* x, const double*, double origin, double invH, AxisWeights<4>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double s = (x[l] - origin) * invH;
            const double left = std::floor(s), t = s - left, r = 1 - t;
            w.base[l] = std::int32_t(left) - 1;
            w.N[0][l] = r * r * r * (1.0 / 6);
            w.N[3][l] = t * t * t * (1.0 / 6);
            w.N[1][l] = 2.0 / 3 - t * t * (1 - 0.5 * t);
            w.N[2][l] = 2.0 / 3 - r * r * (1 - 0.5 * r);
            w.G[0][l] = -0.5 * invH * r * r;
            w.G[3][l] = 0.5 * invH * t * t;
            w.G[1][l] = -invH * t * (2 - 1.5 * t);
            w.G[2][l] = invH * r * (2 - 1.5 * r);
        }
    }

    /// Boundary functions at a wall on the plane of nodes `plane`, after evaluate.
    static void foldAtWall(const double* x, double origin, double invH, std::int32_t plane, AxisWeights<4>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const bool above = w.base[l] + 1 == plane, below = w.base[l] + 2 == plane;
            const double s = (x[l] - origin) * invH - plane, t = s >= 0 ? s : -s, sign = s >= 0 ? invH : -invH;
            const double N[3] = {1 - t + t * t * t * (1.0 / 6), t - t * t * t * (1.0 / 3), t * t * t * (1.0 / 6)};
            const double G[3] = {sign * (0.5 * t * t - 1), sign * (1 - t * t), sign * 0.5 * t * t};
            MPM_UNROLL
            for (int n = 0; n < 4; ++n)
            {
                const int up = n - 1, down = 2 - n; // nodes from the wall
                w.N[n][l] = above ? (up >= 0 ? N[up & 3] : 0.0) : below ? (down >= 0 ? N[down & 3] : 0.0) : w.N[n][l];
                w.G[n][l] = above ? (up >= 0 ? G[up & 3] : 0.0) : below ? (down >= 0 ? G[down & 3] : 0.0) : w.G[n][l];
            }
        }
    }
};
} // namespace mpm::shape

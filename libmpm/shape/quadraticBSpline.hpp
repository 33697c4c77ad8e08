#pragma once
/// Quadratic B-splines centred on nodes (Steffen, Kirby & Berzins 2008, doi 10.1002/nme.2360): with t = (x_p - x_i)/h
/// from the nearest node, |t| <= 1/2,
///     N = (1/2 - t)^2/2, 3/4 - t^2, (1/2 + t)^2/2     at the nodes i - 1, i, i + 1
/// Slopes are continuous, so particles cross cells without a jump of force. Particles are points.
///
/// At a wall the spline is folded: where the nearest node lies on the wall's plane, the value at the node behind is
/// taken as u_{-1} = 2 u_0 - u_1, which leaves hats, N = 1 - |t|, |t| on that half cell. Values there are interpolated
/// by the wall's own nodes, linear fields are kept, and the slope stays continuous at half a cell.
///
///     shape   quadraticBSpline;      // mpmSchemes
///
/// Verified in tests/unit/shapes.cpp; stability in tests/verification/stabilityLimit.cpp.
#include "shape/axisWeights.hpp"

namespace mpm::shape
{
struct QuadraticBSpline
{
    static constexpr const char* word = "quadraticBSpline";
    static constexpr int nodes = 3;
    static constexpr bool hasDomain = false;
    static constexpr bool followsStretch = false;
    using Narrow = QuadraticBSpline;

    static void evaluate(const double* x, const double*, double origin, double invH, AxisWeights<3>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double s = (x[l] - origin) * invH;
            const double first = std::floor(s - 0.5);
            w.base[l] = std::int32_t(first);
            const double t = s - (first + 1), left = 0.5 - t, right = 0.5 + t;
            w.N[0][l] = 0.5 * left * left;
            w.N[2][l] = 0.5 * right * right;
            w.N[1][l] = 0.75 - t * t;
            w.G[0][l] = -invH * left;
            w.G[2][l] = invH * right;
            w.G[1][l] = -2 * invH * t;
        }
    }

    /// Boundary functions at a wall on the plane of nodes `plane`, after evaluate.
    static void foldAtWall(const double* x, double origin, double invH, std::int32_t plane, AxisWeights<3>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double t = (x[l] - origin) * invH - plane;
            const bool here = w.base[l] + 1 == plane, up = t >= 0;
            const double size = up ? t : -t;
            w.N[0][l] = here ? (up ? 0.0 : size) : w.N[0][l];
            w.N[1][l] = here ? 1 - size : w.N[1][l];
            w.N[2][l] = here ? (up ? size : 0.0) : w.N[2][l];
            w.G[0][l] = here ? (up ? 0.0 : -invH) : w.G[0][l];
            w.G[1][l] = here ? (up ? -invH : invH) : w.G[1][l];
            w.G[2][l] = here ? (up ? invH : 0.0) : w.G[2][l];
        }
    }
};
} // namespace mpm::shape

#pragma once
/// Uniform GIMP: chi = 1 on a box of half length l that keeps its size (Bardenhagen & Kober 2004; Andersen & Andersen
/// 2009, Eq. 4 with chi = 1 on Omega_p). With d = |x_p - x_i|/h, lambda = l/h <= 1/2:
///     d < lambda               1 - (d^2 + lambda^2)/(2 lambda)
///     lambda <= d < 1 - lambda 1 - d
///     d < 1 + lambda           (1 + lambda - d)^2/(4 lambda)
/// so three nodes per axis. l is half the initial edge, halved by splitting. With d measured from the middle node and
/// c = d held within [-lambda, lambda], the outer weights are (lambda -+ c)^2/(4 lambda) plus what |d| exceeds |c| by.
///
///     shape   uGIMP;       // mpmSchemes, the default
///
/// Verified in tests/unit/shapes.cpp against direct integration, and by the manufactured bar in tests/verification.
#include "shape/axisWeights.hpp"

namespace mpm::shape
{
struct UGIMP
{
    static constexpr const char* word = "uGIMP";
    static constexpr int nodes = 3;
    static constexpr bool hasDomain = true;
    static constexpr bool followsStretch = false;
    using Narrow = UGIMP;

    static void evaluate(const double* x, const double* lambda, double origin, double invH, AxisWeights<3>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double s = (x[l] - origin) * invH;
            const double first = std::floor(s - 0.5);
            w.base[l] = std::int32_t(first);
            const double la = lambda[l], over = 0.5 / la;
            const double d = s - (first + 1);                                // from the middle node, |d| <= 1/2
            const double low = d > -la ? d : -la, top = low < la ? low : la; // what of it lies under the rounded top
            const double right = (la + top) * over, left = (la - top) * over;
            const double beyond = d - top, rightOf = beyond > 0 ? beyond : 0.0, leftOf = rightOf - beyond;
            w.N[0][l] = 0.5 * (la - top) * left + leftOf;
            w.N[2][l] = 0.5 * (la + top) * right + rightOf;
            w.N[1][l] = 1 - (w.N[0][l] + w.N[2][l]);
            w.G[0][l] = -invH * left;
            w.G[2][l] = invH * right;
            w.G[1][l] = invH * (left - right);
        }
    }
};
} // namespace mpm::shape

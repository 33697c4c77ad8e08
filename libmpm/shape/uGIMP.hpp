#pragma once
/// Uniform GIMP: chi = 1 on a box of half length l that keeps its size (Bardenhagen & Kober 2004; Andersen & Andersen
/// 2009, Eq. 4 with chi = 1 on Omega_p). With d = |x_p - x_i|/h, lambda = l/h <= 1/2:
///     d < lambda               1 - (d^2 + lambda^2)/(2 lambda)
///     lambda <= d < 1 - lambda 1 - d
///     d < 1 + lambda           (1 + lambda - d)^2/(4 lambda)
/// so three nodes per axis. l is half the initial edge, halved by splitting.
///
///     shape   uGIMP;       // mpmSchemes, the default
///
/// Verified in tests/unit/shapes.cpp against direct integration, and by the manufactured bar in tests/verification.
#include "shape/axisWeights.hpp"

namespace mpm::shape
{
struct UGIMP
{
    static constexpr int nodes = 3;
    static constexpr bool hasDomain = true;
    static constexpr bool followsStretch = false;

    static void evaluate(const double* x, const double* lambda, double origin, double invH, AxisWeights<3>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double s = (x[l] - origin) * invH;
            const double first = std::floor(s - 0.5);
            const double la = lambda[l];
            const double over = 1 / la;
            w.base[l] = std::int32_t(first);

            // nearest node, |d| <= 1/2: flat top or straight flank
            const double d1 = s - (first + 1);
            const double a1 = std::abs(d1);
            const bool top = a1 < la;
            w.N[1][l] = top ? 1 - 0.5 * (d1 * d1 * over + la) : 1 - a1;
            w.G[1][l] = invH * (top ? -d1 * over : (d1 > 0 ? -1.0 : 1.0));

            // outer nodes, 1/2 <= d < 3/2: straight flank or parabolic foot
            const double d0 = d1 + 1;
            const double foot0 = std::fmax(0.0, 1 + la - d0);
            const bool flank0 = d0 < 1 - la;
            w.N[0][l] = flank0 ? 1 - d0 : 0.25 * foot0 * foot0 * over;
            w.G[0][l] = -invH * (flank0 ? 1.0 : 0.5 * foot0 * over);

            const double d2 = 1 - d1;
            const double foot2 = std::fmax(0.0, 1 + la - d2);
            const bool flank2 = d2 < 1 - la;
            w.N[2][l] = flank2 ? 1 - d2 : 0.25 * foot2 * foot2 * over;
            w.G[2][l] = invH * (flank2 ? 1.0 : 0.5 * foot2 * over);
        }
    }
};
} // namespace mpm::shape

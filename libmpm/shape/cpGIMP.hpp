#pragma once
/// Contiguous-particle GIMP: the box follows the right stretch U of F = R U, half lengths l_k = l0_k U_kk, so that
/// neighbours stay contiguous under stretch and a rigid turn leaves sizes unchanged (F_xx would vanish at a quarter
/// turn). (Wallstedt & Guilkey 2008; Coombs et al. 2020, doi 10.1016/j.cma.2019.112622, for the choice of U.)
///
/// The mean of the hat over [d - lambda, d + lambda], d = |x_p - x_i|/h, holds for any 0 < lambda <= 1: with
/// b = min(d + lambda, 1), a = d - lambda, width w = min(2 lambda, 1 + lambda - d)+,
///     N = (w - q/2)/(2 lambda),  q = a >= 0 ? (a + b) w : a^2 + b^2
///     G = -sign (b - |a|)/(2 lambda h)
/// A domain wider than a cell touches four nodes per axis. Domains are not let grow beyond two cells (lambda = 1):
/// the solver counts those and advises splitting.
///
///     shape   cpGIMP;      // mpmSchemes
///
/// Verified in tests/unit/shapes.cpp and by the manufactured bar (order 2 at large strain) in tests/verification.
#include "shape/axisWeights.hpp"

namespace mpm::shape
{
struct CpGIMP
{
    static constexpr int nodes = 4;
    static constexpr bool hasDomain = true;
    static constexpr bool followsStretch = true;

    static void evaluate(const double* x, const double* lambda, double origin, double invH, AxisWeights<4>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double s = (x[l] - origin) * invH;
            const double first = std::floor(s - 1);
            const double la = lambda[l];
            const double half = 0.5 / la;
            w.base[l] = std::int32_t(first);
            const double t = s - (first + 1); // in [0, 1)
            for (int n = 0; n < 4; ++n)
            {
                const double sign = n < 2 ? 1.0 : -1.0;
                const double d = n < 2 ? t + (1 - n) : (n - 1) - t;
                const double b = std::fmin(d + la, 1.0);
                const double a = d - la;
                const double width = std::fmax(0.0, std::fmin(2 * la, 1 + la - d));
                const bool right = a >= 0;
                const double q = right ? (a + b) * width : a * a + b * b;
                w.N[n][l] = (width - 0.5 * q) * half;
                w.G[n][l] = -sign * invH * half * (right ? width : b + a);
            }
        }
    }
};
} // namespace mpm::shape

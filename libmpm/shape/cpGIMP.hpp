#pragma once
/// Contiguous-particle GIMP: the box follows the right stretch U of F = R U, half lengths l_k = l0_k U_kk, so that
/// neighbours stay contiguous under stretch and a rigid turn leaves sizes unchanged (F_xx would vanish at a quarter
/// turn). (Wallstedt & Guilkey 2008; Coombs et al. 2020, doi 10.1016/j.cma.2019.112622, for the choice of U.)
///
/// The mean of the hat over [d - lambda, d + lambda], d = |x_p - x_i|/h, holds for any 0 < lambda <= 1: with
/// b = min(d + lambda, 1), a = d - lambda, width w = min(2 lambda, 1 - a)+,
///     N = (w - q/2)/(2 lambda),  q = a >= 0 ? (a + b) w : a^2 + b^2
///     G = -sign (b - |a|)/(2 lambda h)
/// A domain wider than a cell touches four nodes per axis. Domains are not let grow beyond two cells (lambda = 1):
/// the solver counts those and advises splitting.
///
///     shape   cpGIMP;      // mpmSchemes
///
/// Verified in tests/unit/shapes.cpp and by the manufactured bar (order 2 at large strain) in tests/verification.
#include "shape/uGIMP.hpp"

namespace mpm::shape
{
struct CpGIMP
{
    static constexpr const char* word = "cpGIMP";
    static constexpr int nodes = 4;
    static constexpr bool hasDomain = true;
    static constexpr bool followsStretch = true;
    using Narrow = UGIMP; ///< the same function where lambda <= 1/2, on three nodes

    static void evaluate(const double* x, const double* lambda, double origin, double invH, AxisWeights<4>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double s = (x[l] - origin) * invH;
            const double first = std::floor(s - 1);
            const double la = lambda[l], half = 0.5 / la;
            w.base[l] = std::int32_t(first);
            const double t = s - first - 1; // in [0, 1), from the second node
            MPM_UNROLL
            for (int n = 0; n < 4; ++n)
            {
                const double sign = n < 2 ? 1.0 : -1.0;
                const double d = n < 2 ? t + (1 - n) : (n - 1) - t;
                const double a = d - la, end = d + la, b = end < 1 ? end : 1;
                const double room = 1 - a, narrower = room < 2 * la ? room : 2 * la,
                             width = narrower > 0 ? narrower : 0;
                const bool right = a >= 0;
                const double q = right ? (a + b) * width : a * a + b * b;
                w.N[n][l] = (width - 0.5 * q) * half;
                w.G[n][l] = -sign * invH * half * (right ? width : b + a);
            }
        }
    }
};
} // namespace mpm::shape

#pragma once
/// The original material point method: chi = V_p delta(x - x_p) in METHOD Eq. 4 gives the hat function
/// N = 1 - |d|, d = (x_p - x_i)/h. (Sulsky, Chen, Schreyer 1994; Andersen & Andersen 2009, Eq. 4.)
///
///     shape   linear;      // mpmSchemes
///
/// Gradients jump at cell faces, so stresses are noisy when particles cross; verified in tests/unit/shapes.cpp.
#include "shape/axisWeights.hpp"

namespace mpm::shape
{
struct Linear
{
    static constexpr const char* word = "linear";
    static constexpr int nodes = 2;
    static constexpr bool hasDomain = false;
    static constexpr bool followsStretch = false;
    using Narrow = Linear;
    /// Least weight of a node. A particle on a node plane in every bit would give the next node no mass, so no
    /// velocity, but have a gradient towards it: (0 - v)/h would be strain.
    static constexpr double least = 0x1p-52;

    static void evaluate(const double* x, const double*, double origin, double invH, AxisWeights<2>& w)
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double s = (x[l] - origin) * invH;
            const double first = std::floor(s);
            const double place = s - first, t = place > least ? place : least;
            w.base[l] = std::int32_t(first);
            w.N[0][l] = 1 - t;
            w.N[1][l] = t;
            w.G[0][l] = -invH;
            w.G[1][l] = invH;
        }
    }
};
} // namespace mpm::shape

#pragma once
/// Weights of the naive step, one particle and one node at a time along one axis. d = (x_p - x_i)/h, l the half length
/// of the particle's domain in cells:
///     linear           N = hat(d)                          G = -+1
///     uGIMP, cpGIMP    N = (T(|d| - l) - T(|d| + l))/(2 l)   G = (hat(d + l) - hat(d - l))/(2 l)
/// hat(d) = max(0, 1 - |d|), T(d) = int_d^1 hat. G in cells: divide by h.
#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm::benchmark
{
enum class Kind
{
    linear,
    uGIMP,
    cpGIMP
};

/// Nodes of the support an axis.
constexpr int naiveNodesOf(Kind kind)
{
    return kind == Kind::linear ? 2 : kind == Kind::uGIMP ? 3 : 4;
}

struct NaiveWeight
{
    double N, G;
};

inline double hat(double d)
{
    return std::max(0.0, 1 - std::abs(d));
}

/// The hat's area right of d >= -1; small areas at its foot keep all their digits.
inline double hatTail(double d)
{
    const double foot = std::max(0.0, 1 - d);
    return d < 0 ? 1 - 0.5 * (1 + d) * (1 + d) : 0.5 * foot * foot;
}

/// `left`: is the node the first of the support? (For the hat's slope at a node.)
template <Kind kind>
inline NaiveWeight naiveWeight(double d, double l, bool left)
{
    constexpr double least = std::numeric_limits<double>::epsilon(); // no slope towards a node without mass
    if constexpr (kind == Kind::linear)
        return {std::clamp(hat(d), least, 1 - least), left ? -1.0 : 1.0};
    const double e = std::abs(d);
    return {(hatTail(e - l) - hatTail(e + l)) / (2 * l), (hat(d + l) - hat(d - l)) / (2 * l)};
}
} // namespace mpm::benchmark

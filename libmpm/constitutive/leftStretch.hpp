#pragma once
/// The left stretch of a lane, V^2 = b = F F^T, and isotropic functions of it.
///
/// Everything starts from H = F - I, so that small strains keep all their digits: b - I = H + H^T + H H^T,
/// J - 1 = tr H + II(H) + det H. Principal values x_i = lambda_i^2 - 1 and the way back from values t_i to the tensor
/// with the axes of b come without eigenvectors: in plane strain from mean and radius, in 3D by lodeFrame.hpp. Repeated
/// values are clean in both: what multiplies an undefined axis is the gap between the t_i, which is zero.
#include "constitutive/kinematics.hpp"
#include "constitutive/lodeFrame.hpp"

#include <cmath>

namespace mpm::constitutive
{
/// b - I by components, and J - 1 = det F - 1.
template <int dim>
struct LeftStretch
{
    double x[stressSize<dim>];
    double volume;
};

[[gnu::always_inline]] inline LeftStretch<2> leftStretch(const TensorLanes<2>& F, int l)
{
    const double xx = F[0][l] - 1, xy = F[1][l], yx = F[2][l], yy = F[3][l] - 1;
    return {{2 * xx + (xx * xx + xy * xy), 2 * yy + (yx * yx + yy * yy), 0, xy + yx + (xx * yx + xy * yy)},
            xx + yy + (xx * yy - xy * yx)};
}

[[gnu::always_inline]] inline LeftStretch<3> leftStretch(const TensorLanes<3>& F, int l)
{
    double h[9];
    for (int k = 0; k < 9; ++k)
        h[k] = k % 4 == 0 ? F[k][l] - 1 : F[k][l];
    const auto rows = [&h](int i, int j) {
        return h[3 * i] * h[3 * j] + h[3 * i + 1] * h[3 * j + 1] + h[3 * i + 2] * h[3 * j + 2];
    };
    const double yz = h[4] * h[8] - h[5] * h[7], zx = h[3] * h[8] - h[5] * h[6], xy = h[3] * h[7] - h[4] * h[6];
    const double pairs = (h[0] * h[4] - h[1] * h[3]) + yz + (h[0] * h[8] - h[2] * h[6]);
    return {{2 * h[0] + rows(0, 0), 2 * h[4] + rows(1, 1), 2 * h[8] + rows(2, 2), h[1] + h[3] + rows(0, 1),
             h[5] + h[7] + rows(1, 2), h[2] + h[6] + rows(2, 0)},
            h[0] + h[4] + h[8] + (pairs + (h[0] * yz - h[1] * zx + h[2] * xy))};
}

/// Principal values of b - I and what the way back needs: the in-plane pair (larger first) and zz, or all three sorted.
template <int dim>
struct PrincipalStretch;
template <>
struct PrincipalStretch<2>
{
    double x[3];
    double half, shear, inverse;
};
template <>
struct PrincipalStretch<3>
{
    double x[3];
    LodeFrame frame;
};

[[gnu::always_inline]] inline PrincipalStretch<2> principal(const LeftStretch<2>& b)
{
    const double centre = 0.5 * (b.x[0] + b.x[1]), half = 0.5 * (b.x[0] - b.x[1]), shear = b.x[3];
    const double radius = std::sqrt(half * half + shear * shear);
    return {{centre + radius, centre - radius, b.x[2]}, half, shear, radius > 0 ? 1 / radius : 0};
}

[[gnu::always_inline]] inline PrincipalStretch<3> principal(const LeftStretch<3>& b)
{
    constexpr double sqrt2over3 = 0.81649658092772603, sqrtHalf = 0.70710678118654752;
    PrincipalStretch<3> out;
    out.frame = lodeFrame(b.x);
    const double u = sqrt2over3 * out.frame.size * out.frame.theta.cosine;
    const double v = sqrtHalf * out.frame.size * out.frame.theta.sine;
    out.x[0] = out.frame.mean + u;
    out.x[1] = out.frame.mean + (v - 0.5 * u);
    out.x[2] = out.frame.mean - (v + 0.5 * u);
    return out;
}

/// The tensor with the principal values t and the axes of b.
[[gnu::always_inline]] inline void turnBack(const PrincipalStretch<2>& b, const double (&t)[3], double (&out)[4])
{
    const double centre = 0.5 * (t[0] + t[1]), radius = 0.5 * (t[0] - t[1]) * b.inverse;
    out[0] = centre + radius * b.half;
    out[1] = centre - radius * b.half;
    out[2] = t[2];
    out[3] = radius * b.shear;
}

[[gnu::always_inline]] inline void turnBack(const PrincipalStretch<3>& b, const double (&t)[3], double (&out)[6])
{
    constexpr double sqrt2over3 = 0.81649658092772603, sqrtHalf = 0.70710678118654752;
    const double mean = (t[0] + t[1] + t[2]) * (1.0 / 3);
    const double u = sqrt2over3 * (t[0] - 0.5 * (t[1] + t[2])), v = sqrtHalf * (t[1] - t[2]);
    const auto& frame = b.frame;
    const double along = u * frame.theta.cosine + v * frame.theta.sine;
    const double across = u * frame.theta.sine - v * frame.theta.cosine;
    for (int k = 0; k < 6; ++k)
        out[k] = (k < 3 ? mean : 0) + (along * frame.n[k] + across * frame.second[k]);
}

} // namespace mpm::constitutive

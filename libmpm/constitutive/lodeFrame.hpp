#pragma once
/// Principal stresses of a symmetric 3 x 3 tensor and the way back, without eigenvectors, branches or trigonometry.
///
/// With n = dev sigma/|dev sigma| and t = dev(n n), the tensors n and t' = t - (t:n) n are orthogonal and share the
/// axes of sigma: every symmetric tensor with these axes is q I + a n + b t'/|t'|. The Lode angle theta in [0, 60 deg]
/// follows from cos 3theta = sqrt6 t:n and sin 3theta = sqrt6 |t'|; principal values of n are sqrt(2/3) cos(theta - 120
/// deg i), those of t'/|t'| are sqrt(2/3) sin(theta - 120 deg i), i = 0, 1, -1, sorted. cos and sin of theta come from
/// u = sin 3theta/(1 + |cos 3theta|) = tan(3 phi/2) in [0, 1], phi = min(theta, 60 deg - theta), by polynomials of
/// cos(2/3 atan u) and sin(2/3 atan u)/u in u^2 - 1/2 (Chebyshev interpolation, error 9e-17).
///
/// Repeated principal values are clean: t'/|t'| is then any tensor or zero, and the b that multiplies it is no larger
/// than the gap between the values. A deviator of zero (up to 1e-100) gives n = 0, theta = 60 deg and three equal
/// values.
#include <cmath>

namespace mpm::constitutive
{
/// p(v) = p0(v^4) + v p1(v^4) + v^2 (p2(v^4) + v p3(v^4)), four short chains instead of a long one.
[[gnu::always_inline]] inline double polynomial(const double (&c)[20], double v)
{
    const double w = v * v, x = w * w;
    double p0 = c[16], p1 = c[17], p2 = c[18], p3 = c[19];
    for (int i = 12; i >= 0; i -= 4)
    {
        p0 = p0 * x + c[i];
        p1 = p1 * x + c[i + 1];
        p2 = p2 * x + c[i + 2];
        p3 = p3 * x + c[i + 3];
    }
    return (p0 + v * p1) + w * (p2 + v * p3);
}

struct Angle
{
    double cosine, sine;
};

/// theta from u = sin 3theta/(1 + |cos 3theta|) >= 0 and whether cos 3theta < 0.
[[gnu::always_inline]] inline Angle thirdAngle(double u, bool mirrored)
{
    constexpr double cosineOf[20] = {
        0.91699329835202015,    -0.12536299522034242,    0.059185543011939359,   -0.031575948729154903,
        0.017847724235548749,   -0.010434773948309741,   0.006237803899769143,   -0.0037880447208296485,
        0.0023275358693854182,  -0.0014432114623975588,  0.00090146533715209699, -0.00056638607613426989,
        0.0003570131097042923,  -0.00022635402670473563, 0.00014743249038568596, -9.4131959394184401e-05,
        4.8686063066059076e-05, -3.117876703483424e-05,  4.1803149446577366e-05, -2.6974031095851923e-05};
    constexpr double sineOf[20] = {
        0.56413347849154094,    -0.15658090144619868,    0.071162049771912719,   -0.037075497737730438,
        0.020609723015370666,   -0.011899091443221679,   0.007042938286131774,   -0.0042425124931650474,
        0.0025892083718289998,  -0.001596238321560538,   0.00099208815248828276, -0.00062060653568057932,
        0.00038969415302965671, -0.00024622135582218728, 0.00015981673819351309, -0.00010175365647054135,
        5.261739804890608e-05,  -3.3612747992081992e-05, 4.4787920102689104e-05, -2.8846019592890903e-05};
    constexpr double halfSqrt3 = 0.86602540378443865;

    const double v = u * u - 0.5;
    const double cosine = polynomial(cosineOf, v);
    const double sine = u * polynomial(sineOf, v);
    Angle theta;
    theta.cosine = mirrored ? 0.5 * cosine + halfSqrt3 * sine : cosine;
    theta.sine = mirrored ? halfSqrt3 * cosine - 0.5 * sine : sine;
    return theta;
}

/// sigma = q I + size n, its Lode angle, and the second direction t'/|t'|; components xx, yy, zz, xy, yz, zx.
struct LodeFrame
{
    double mean, size;
    double n[6], second[6];
    Angle theta;
};

/// a:b of symmetric tensors.
[[gnu::always_inline]] inline double contract(const double (&a)[6], const double (&b)[6])
{
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// Works on the deviator s as it is, |s|^2 t' = dev(s s) - (dev(s s):s/|s|^2) s, and divides what follows from it by
/// powers of |s|: roots and quotients take long, and few have to wait for one another then.
[[gnu::always_inline]] inline LodeFrame lodeFrame(const double (&sigma)[6])
{
    constexpr double sqrt6 = 2.4494897427831781;
    LodeFrame out;
    out.mean = (sigma[0] + sigma[1] + sigma[2]) * (1.0 / 3);
    const double s[6] = {sigma[0] - out.mean, sigma[1] - out.mean, sigma[2] - out.mean, sigma[3], sigma[4], sigma[5]};
    const double square = contract(s, s);
    out.size = std::sqrt(square);
    const bool some = square > 1e-200; // the powers of |s| below stay within doubles
    const double inverse = some ? 1 / out.size : 0, inverse2 = inverse * inverse;

    double t[6];
    t[0] = s[0] * s[0] + s[3] * s[3] + s[5] * s[5];
    t[1] = s[1] * s[1] + s[3] * s[3] + s[4] * s[4];
    t[2] = s[2] * s[2] + s[4] * s[4] + s[5] * s[5];
    t[3] = s[4] * s[5] - s[3] * s[2];
    t[4] = s[3] * s[5] - s[4] * s[0];
    t[5] = s[3] * s[4] - s[5] * s[1];
    const double third = square * (1.0 / 3);
    t[0] -= third;
    t[1] -= third;
    t[2] -= third;

    const double along = contract(t, s), share = some ? along / square : 0;
    for (int k = 0; k < 6; ++k)
        t[k] -= share * s[k];
    const double across2 = contract(t, t), across = std::sqrt(across2);
    const double inverseAcross = across2 > 0 ? 1 / across : 0;
    const double cos3 = sqrt6 * along * (inverse * inverse2);
    const double sin3OverAcross = sqrt6 * inverse2;
    for (int k = 0; k < 6; ++k)
    {
        out.n[k] = inverse * s[k];
        out.second[k] = inverseAcross * t[k];
    }
    out.theta = thirdAngle(across * (sin3OverAcross / (1 + std::abs(cos3))), cos3 < 0);
    return out;
}
} // namespace mpm::constitutive

#pragma once
/// Finite motion over one step (kinematics.hpp has what each function is, and the reasons) of one particle or of as many as
/// a register holds: R is double or Record. For sweeps that keep numbers in registers from the velocity gradient to the
/// law. For kernels only (base/record.hpp). Verified in tests/unit/kinematics.cpp by way of kinematics.cpp.
///
/// Tensors are rows of components: L, F as xx xy (xz) yx yy ...; stress and strain as xx yy zz xy (yz zx).
#include "base/record.hpp"

#include <array>

namespace mpm::constitutive
{
/// Largest |dt L| for which the short series below are exact to round-off.
template <int dim>
inline constexpr double smallMotion = dim == 2 ? 2e-2 : 1e-3;
/// det(I + dt L/2) below which a step deforms too much for its middle to mean anything.
inline constexpr double leastChange = 0.5;

/// 1/(first!), 1/((first + step)!), ...
template <int n>
constexpr std::array<double, n> inverseFactorials(int first, int step)
{
    std::array<double, n> c{};
    double factorial = 1;
    for (int k = 1, i = 0; i < n; ++k)
    {
        if (k - 1 == first + i * step)
            c[std::size_t(i++)] = 1 / factorial;
        factorial *= k;
    }
    return c;
}

/// 1/first! + x/(first + step)! + ... of n terms.
template <int n, int first, int step, class R>
MPM_INLINE R series(const R& x)
{
    constexpr std::array<double, n> c = inverseFactorials<n>(first, step);
    R sum = splat<R>(c[n - 1]);
    MPM_UNROLL
    for (int k = n - 2; k >= 0; --k)
        sum = c[std::size_t(k)] + x * sum;
    return sum;
}

/// e^s by its series to s^terms; with 13 terms to 1e-16 for |s| <= 1/2, with 7 for |s| <= 2e-2, with 5 for 3e-3.
template <int terms, class R>
MPM_INLINE R exponential(const R& s)
{
    return series<terms + 1, 0, 1>(s);
}

template <class R>
MPM_INLINE void multiply3(const R (&a)[9], const R (&b)[9], R (&out)[9])
{
    MPM_UNROLL
    for (int i = 0; i < 3; ++i)
        MPM_UNROLL
    for (int j = 0; j < 3; ++j)
        out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

template <class R>
MPM_INLINE R determinant(const R (&m)[4])
{
    return m[0] * m[3] - m[1] * m[2];
}
template <class R>
MPM_INLINE R determinant(const R (&m)[9])
{
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/// L <- L (I + half L)^-1 = (L + half det L I)/det(I + half L).
template <class R>
MPM_INLINE void toMidStep(double half, R (&L)[4])
{
    const R J = determinant(L), det = 1 + half * (L[0] + L[3] + half * J);
    const R one = splat<R>(1);
    const auto moderate = det > splat<R>(leastChange);
    const R over = one / select(moderate, det, one), add = select(moderate, half * J, splat<R>(0));
    L[0] = (L[0] + add) * over;
    L[1] = L[1] * over;
    L[2] = L[2] * over;
    L[3] = (L[3] + add) * over;
}

/// L (I + a L)^-1 = (I - (I + a L)^-1)/a would cancel; L adj(I + a L) = L (I + a (tr L I - L)) + a^2 det L I by
/// Cayley-Hamilton: adj(I + a L) = I + a (tr L I - L) + a^2 adj L, and L adj L = det L I.
template <class R>
MPM_INLINE void toMidStep(double half, R (&L)[9])
{
    R square[9];
    multiply3(L, L, square);
    const R trace = L[0] + L[4] + L[8], J = determinant(L);
    const R minors = 0.5 * (trace * trace - square[0] - square[4] - square[8]);
    const R det = 1 + half * (trace + half * (minors + half * J));
    const R one = splat<R>(1);
    const auto moderate = det > splat<R>(leastChange);
    const R over = one / select(moderate, det, one);
    const R a = select(moderate, splat<R>(half), splat<R>(0));
    MPM_UNROLL
    for (int k = 0; k < 9; ++k)
    {
        R out = L[k] + a * (trace * L[k] - square[k]);
        if (k % 4 == 0)
            out += a * a * J;
        L[k] = over * out;
    }
}

/// F <- exp(A) F, A = dt L: exp(A) = e^s (cosh(q) I + sinh(q)/q A'), s = tr A/2, A' = A - s I, q^2 = -det A'; both
/// functions are entire in q^2.
template <bool isSmall, class R>
MPM_INLINE void advance(double dt, const R (&L)[4], R (&F)[4])
{
    constexpr int terms = isSmall ? 4 : 7;
    const R xx = dt * L[0], xy = dt * L[1], yx = dt * L[2], yy = dt * L[3];
    const R s = 0.5 * (xx + yy), d = 0.5 * (xx - yy);
    const R z = d * d + xy * yx;
    const R c = series<terms + 1, 0, 2>(z), sh = series<terms + 1, 1, 2>(z);
    const R e = exponential < isSmall ? 7 : 13 > (s);
    const R esh = e * sh, ec = e * c;
    const R a = ec + esh * d, b = esh * xy, g = esh * yx, h = ec - esh * d;
    const R f0 = F[0], f1 = F[1], f2 = F[2], f3 = F[3];
    F[0] = a * f0 + b * f2;
    F[1] = a * f1 + b * f3;
    F[2] = g * f0 + h * f2;
    F[3] = g * f1 + h * f3;
}

/// exp(A) by Taylor's series: to degree 4 for small A, I + A + A^2 (I/2 + A/6 + A^2/24); else to degree 6 of A/2,
/// squared.
template <bool isSmall, class R>
MPM_INLINE void exponential3(const R (&A)[9], R (&out)[9])
{
    R a[9], power[9], sum[9];
    MPM_UNROLL
    for (int k = 0; k < 9; ++k)
        a[k] = isSmall ? A[k] : 0.5 * A[k];
    multiply3(a, a, power);
    if constexpr (isSmall)
    {
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            sum[k] = power[k] * (1.0 / 24) + a[k] * (1.0 / 6);
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            sum[k] = sum[k] + 0.5;
        multiply3(power, sum, out);
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            out[k] += a[k];
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            out[k] = out[k] + 1;
    }
    else
    {
        // 1 + a + a^2 (1/2 + a/6 + a^2 (1/24 + a/120 + a^2/720))
        R inner[9];
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            sum[k] = power[k] * (1.0 / 720) + a[k] * (1.0 / 120);
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            sum[k] = sum[k] + 1.0 / 24;
        multiply3(power, sum, inner);
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            inner[k] += a[k] * (1.0 / 6);
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            inner[k] = inner[k] + 0.5;
        multiply3(power, inner, sum);
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            sum[k] += a[k];
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            sum[k] = sum[k] + 1;
        multiply3(sum, sum, out);
    }
}

/// A last scalar factor makes det exp(A) = exp(tr A) to round-off.
template <bool isSmall, class R>
MPM_INLINE void advance(double dt, const R (&L)[9], R (&F)[9])
{
    R a[9], e[9], f[9];
    MPM_UNROLL
    for (int k = 0; k < 9; ++k)
        a[k] = dt * L[k];
    exponential3<isSmall>(a, e);
    const R volume = exponential < isSmall ? 5 : 13 > (a[0] + a[4] + a[8]);
    const R factor = 1 + (volume / determinant(e) - 1) * (1.0 / 3);
    multiply3(e, F, f);
    MPM_UNROLL
    for (int k = 0; k < 9; ++k)
        F[k] = factor * f[k];
}

/// 1/(1 + q^2) of half an angle's tangent q, by its series where q <= 1e-2.
template <bool isSmall, class R>
MPM_INLINE R overOnePlus(const R& qq)
{
    return isSmall ? 1 - qq * (1 - qq * (1 - qq * (1 - qq))) : 1 / (1 + qq);
}

/// sigma <- dR sigma dR^T.
template <bool isSmall = false, class R>
MPM_INLINE void rotate(double dt, const R (&L)[4], R (&stress)[4])
{
    const R q = 0.25 * dt * (L[2] - L[1]), qq = q * q;
    const R over = overOnePlus<isSmall>(qq);
    const R s = (q + q) * over, c = (1 - qq) * over;      // of the angle
    const R s2 = (s + s) * c, c2 = 1 - (s + s) * s;       // and of twice as much, by which the deviator turns
    const R mean = 0.5 * (stress[0] + stress[1]), half = 0.5 * (stress[0] - stress[1]), xy = stress[3];
    const R turned = c2 * half - s2 * xy;
    stress[0] = mean + turned;
    stress[1] = mean - turned;
    stress[3] = s2 * half + c2 * xy;
}

/// Cayley: dR = I + 2/(1 + |q|^2) (Q + Q^2), Q = [q]x, q = dt omega/2, omega the axial vector of W.
template <bool isSmall = false, class R>
MPM_INLINE void rotate(double dt, const R (&L)[9], R (&stress)[6])
{
    const R q0 = 0.25 * dt * (L[7] - L[5]), q1 = 0.25 * dt * (L[2] - L[6]), q2 = 0.25 * dt * (L[3] - L[1]);
    const R b = 2 * overOnePlus<isSmall>(q0 * q0 + q1 * q1 + q2 * q2);
    const R dR[9] = {1 - b * (q1 * q1 + q2 * q2), b * (q0 * q1 - q2),          b * (q0 * q2 + q1),
                     b * (q0 * q1 + q2),          1 - b * (q0 * q0 + q2 * q2), b * (q1 * q2 - q0),
                     b * (q0 * q2 - q1),          b * (q1 * q2 + q0),          1 - b * (q0 * q0 + q1 * q1)};
    const R S[9] = {stress[0], stress[3], stress[5], stress[3], stress[1], stress[4], stress[5], stress[4], stress[2]};
    R T[9];
    multiply3(dR, S, T);
    stress[0] = T[0] * dR[0] + T[1] * dR[1] + T[2] * dR[2];
    stress[1] = T[3] * dR[3] + T[4] * dR[4] + T[5] * dR[5];
    stress[2] = T[6] * dR[6] + T[7] * dR[7] + T[8] * dR[8];
    stress[3] = T[0] * dR[3] + T[1] * dR[4] + T[2] * dR[5];
    stress[4] = T[3] * dR[6] + T[4] * dR[7] + T[5] * dR[8];
    stress[5] = T[6] * dR[0] + T[7] * dR[1] + T[8] * dR[2];
}

/// dEps = dt sym L; plane strain: zz = 0.
template <class R>
MPM_INLINE void strainOf(double dt, const R (&L)[4], R (&strain)[4])
{
    strain[0] = dt * L[0];
    strain[1] = dt * L[3];
    strain[2] = splat<R>(0);
    strain[3] = 0.5 * dt * (L[1] + L[2]);
}
template <class R>
MPM_INLINE void strainOf(double dt, const R (&L)[9], R (&strain)[6])
{
    strain[0] = dt * L[0];
    strain[1] = dt * L[4];
    strain[2] = dt * L[8];
    strain[3] = 0.5 * dt * (L[1] + L[3]);
    strain[4] = 0.5 * dt * (L[5] + L[7]);
    strain[5] = 0.5 * dt * (L[2] + L[6]);
}

/// sigma : dEps; in plane strain dEps_zz = 0.
template <class R>
MPM_INLINE R work(const R (&stress)[4], const R (&strain)[4])
{
    return stress[0] * strain[0] + stress[1] * strain[1] + 2 * (stress[3] * strain[3]);
}
template <class R>
MPM_INLINE R work(const R (&stress)[6], const R (&strain)[6])
{
    return stress[0] * strain[0] + stress[1] * strain[1] + stress[2] * strain[2] +
           2 * (stress[3] * strain[3] + stress[4] * strain[4] + stress[5] * strain[5]);
}

/// 1/2 sigma : C^-1 : sigma = p^2/(2 K) + s : s/(4 G) from 1/(2 K) and 1/(4 G) [J/m^3].
template <class R, int nc>
MPM_INLINE R elasticEnergy(const R (&stress)[nc], const R& halfOverBulk, const R& quarterOverShear)
{
    const R p = (stress[0] + stress[1] + stress[2]) * (1.0 / 3);
    R normal = splat<R>(0), shear = splat<R>(0);
    MPM_UNROLL
    for (int k = 0; k < 3; ++k)
        normal += (stress[k] - p) * (stress[k] - p);
    MPM_UNROLL
    for (int k = 3; k < nc; ++k)
        shear += stress[k] * stress[k];
    return p * p * halfOverBulk + (normal + 2 * shear) * quarterOverShear;
}
} // namespace mpm::constitutive

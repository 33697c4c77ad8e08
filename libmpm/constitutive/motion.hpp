#pragma once
/// Finite motion over one step (kinematics.hpp has what each function is, and the reasons) of one particle or of as
/// many as a register holds: R is double or Record. For sweeps that keep numbers in registers from the velocity
/// gradient to the law. For kernels only (base/record.hpp). Verified in tests/unit/kinematics.cpp by way of
/// kinematics.cpp.
///
/// Tensors are rows of components: L, F as xx xy (xz) yx yy ...; stress and strain as xx yy zz xy (yz zx).
#include "base/record.hpp"

#include <array>

namespace mpm::constitutive
{
/// Largest |dt L| for which the short series below are exact to round-off.
template <int dim>
inline constexpr double smallMotion = dim == 2 ? 2e-2 : 5e-3;
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

/// m^-1 det m = m^2 - tr m m + minors I.
template <class R>
MPM_INLINE void adjugate(const R (&m)[9], R (&out)[9])
{
    out[0] = m[4] * m[8] - m[5] * m[7];
    out[1] = m[2] * m[7] - m[1] * m[8];
    out[2] = m[1] * m[5] - m[2] * m[4];
    out[3] = m[5] * m[6] - m[3] * m[8];
    out[4] = m[0] * m[8] - m[2] * m[6];
    out[5] = m[2] * m[3] - m[0] * m[5];
    out[6] = m[3] * m[7] - m[4] * m[6];
    out[7] = m[1] * m[6] - m[0] * m[7];
    out[8] = m[0] * m[4] - m[1] * m[3];
}

template <class R>
struct Invariants
{
    R trace, minors, det;
};
template <class R>
MPM_INLINE Invariants<R> invariants(const R (&m)[9], const R (&adj)[9])
{
    return {m[0] + m[4] + m[8], adj[0] + adj[4] + adj[8], m[0] * adj[0] + m[1] * adj[3] + m[2] * adj[6]};
}

/// out = one I + linear m + adjoint adj.
template <class R>
MPM_INLINE void combine(const R& one, const R& linear, const R (&m)[9], const R& adjoint, const R (&adj)[9],
                        R (&out)[9])
{
    MPM_UNROLL
    for (int k = 0; k < 9; ++k)
        out[k] = linear * m[k] + adjoint * adj[k];
    MPM_UNROLL
    for (int k = 0; k < 9; k += 4)
        out[k] += one;
}

/// exp(A) = one I + linear A + adjoint adj A: Taylor's series to degree 6, its powers by A^3 = tr A^2 - minors A + det
/// I (Cayley & Hamilton). To round-off, det exp(A) = exp(tr A) with it, for |A| <= 1.5e-2.
template <class R>
struct Exponential
{
    R one, linear, adjoint;

    MPM_INLINE explicit Exponential(const Invariants<R>& a)
    {
        constexpr std::array<double, 7> c = inverseFactorials<7>(0, 1);
        R square = splat<R>(c[6]);
        linear = splat<R>(c[5]);
        one = splat<R>(c[4]);
        MPM_UNROLL
        for (int k = 3; k >= 0; --k)
        {
            const R next = linear + a.trace * square;
            linear = one - a.minors * square;
            one = c[std::size_t(k)] + a.det * square;
            square = next;
        }
        linear += a.trace * square; // A^2 = tr A - minors I + adj A
        one -= a.minors * square;
        adjoint = square;
    }
};

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

/// L (I + a L)^-1 = (I - (I + a L)^-1)/a would cancel; L adj(I + a L) = L - a adj L + a (minors + a det) I.
template <class R>
MPM_INLINE void toMidStep(double half, R (&L)[9])
{
    R adj[9];
    adjugate(L, adj);
    const Invariants<R> l = invariants(L, adj);
    const R bulk = half * (l.minors + half * l.det), det = 1 + half * (l.trace + bulk);
    const R one = splat<R>(1), zero = splat<R>(0);
    const auto moderate = det > splat<R>(leastChange);
    const R over = one / select(moderate, det, one);
    combine(select(moderate, bulk * over, zero), over, L, select(moderate, -half * over, zero), adj, L);
}

/// The same where motion is small, and out <- exp(dt L) of that L: with D = det(I + a L) the invariants of L (I + a
/// L)^-1 are (tr + 2 a minors + 3 a^2 det)/D, (minors + 3 a det)/D and det/D, and adj of it is (adj L + a det I)/D.
template <class R>
MPM_INLINE void toMidStep(double dt, double half, R (&L)[9], R (&out)[9])
{
    R adj[9];
    adjugate(L, adj);
    const Invariants<R> l = invariants(L, adj);
    const R bulk = half * (l.minors + half * l.det), over = 1 / (1 + half * (l.trace + bulk)), step = dt * over;
    const R minors = l.minors + 3 * half * l.det;
    const Exponential<R> e({step * (l.trace + half * (l.minors + minors)), dt * step * minors, dt * dt * step * l.det});
    const R linear = step * e.linear, adjoint = dt * step * e.adjoint;
    combine(e.one + linear * bulk + half * adjoint * l.det, linear, L, adjoint - half * linear, adj, out);
    combine(bulk * over, over, L, -half * over, adj, L);
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

/// exp(A) by Taylor's series to degree 6 of A/2, squared.
template <class R>
MPM_INLINE void exponential3(const R (&A)[9], R (&out)[9])
{
    R a[9], power[9], sum[9], inner[9];
    MPM_UNROLL
    for (int k = 0; k < 9; ++k)
        a[k] = 0.5 * A[k];
    multiply3(a, a, power);
    // 1 + a + a^2 (1/2 + a/6 + a^2 (1/24 + a/120 + a^2/720))
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

/// Of what is not small, a last scalar factor makes det exp(A) = exp(tr A) to round-off.
template <bool isSmall, class R>
MPM_INLINE void advance(double dt, const R (&L)[9], R (&F)[9])
{
    R a[9], e[9], f[9];
    MPM_UNROLL
    for (int k = 0; k < 9; ++k)
    {
        a[k] = dt * L[k];
        f[k] = F[k];
    }
    if constexpr (isSmall)
    {
        R adj[9];
        adjugate(a, adj);
        const Exponential<R> of(invariants(a, adj));
        combine(of.one, of.linear, a, of.adjoint, adj, e);
    }
    else
    {
        exponential3(a, e);
        const R factor = 1 + (exponential<13>(a[0] + a[4] + a[8]) / determinant(e) - 1) * (1.0 / 3);
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            e[k] *= factor;
    }
    multiply3(e, f, F);
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
    const R s = (q + q) * over, c = (1 - qq) * over; // of the angle
    const R s2 = (s + s) * c, c2 = 1 - (s + s) * s;  // and of twice as much, by which the deviator turns
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
    const R x = b * q0, y = b * q1, z = b * q2;
    const R xx = x * q0, yy = y * q1, zz = z * q2, xy = x * q1, yz = y * q2, zx = z * q0;
    const R d[9] = {1 - (yy + zz), xy - z, zx + y, xy + z, 1 - (zz + xx), yz - x, zx - y, yz + x, 1 - (xx + yy)};
    // s = sigma - sigma_zz I: fewer products, and what is isotropic stays as it is
    const R base = stress[2], sxx = stress[0] - base, syy = stress[1] - base;
    const R sxy = stress[3], syz = stress[4], szx = stress[5];
    const R t0 = d[0] * sxx + d[1] * sxy + d[2] * szx, t3 = d[3] * sxx + d[4] * sxy + d[5] * szx;
    const R t1 = d[0] * sxy + d[1] * syy + d[2] * syz, t4 = d[3] * sxy + d[4] * syy + d[5] * syz;
    const R t2 = d[0] * szx + d[1] * syz, t5 = d[3] * szx + d[4] * syz;
    const R first = t0 * d[0] + t1 * d[1] + t2 * d[2], second = t3 * d[3] + t4 * d[4] + t5 * d[5];
    stress[0] = base + first;
    stress[1] = base + second;
    stress[2] = base + ((sxx + syy) - (first + second));
    stress[3] = t0 * d[3] + t1 * d[4] + t2 * d[5];
    stress[4] = t3 * d[6] + t4 * d[7] + t5 * d[8];
    stress[5] = t0 * d[6] + t1 * d[7] + t2 * d[8];
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

#include "constitutive/kinematics.hpp"

#include "base/record.hpp"

#include <cmath>

namespace mpm::constitutive
{
namespace
{
/// Largest |dt L| for which the short series below are exact to round-off.
constexpr double small = 1e-3;
/// det(I + dt L/2) below which a step deforms too much for its middle to mean anything.
constexpr double leastChange = 0.5;

bool allSmall(const double* L, int count, double dt)
{
    Record most{};
    for (int i = 0; i < count; i += 8)
    {
        const Record x = load(L + i);
        most = largerOf(select(x < Record{}, -x, x), most);
    }
    double largest = 0;
    for (int l = 0; l < 8; ++l)
        largest = most[l] > largest ? most[l] : largest;
    return dt * largest <= small;
}

/// e^s - 1 by its series to s^terms; with 13 terms 1e-16 for |s| <= 1/2, with 5 for |s| <= 3e-3.
template <int terms, class R>
[[gnu::always_inline]] inline R expMinusOne(const R& s)
{
    R sum = s * 0 + 1;
    MPM_UNROLL
    for (int k = terms; k >= 2; --k)
        sum = 1 + s * sum * (1.0 / k);
    return s * sum;
}

template <class R>
[[gnu::always_inline]] inline void multiply3(const R (&a)[9], const R (&b)[9], R (&out)[9])
{
    MPM_UNROLL
    for (int i = 0; i < 3; ++i)
        MPM_UNROLL
    for (int j = 0; j < 3; ++j)
        out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

template <class R>
[[gnu::always_inline]] inline R determinant3(const R (&m)[9])
{
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

// exp(A) = e^s (cosh(q) I + sinh(q)/q A'), s = tr A/2, A' = A - s I, q^2 = -det A'; both functions are entire in q^2.
template <int expTerms, int terms>
void advance2(const TensorLanes<2>& L, double dt, TensorLanes<2>& F)
{
    for (int l = 0; l < lanes; ++l)
    {
        const double xx = dt * L[0][l], xy = dt * L[1][l], yx = dt * L[2][l], yy = dt * L[3][l];
        const double s = 0.5 * (xx + yy), d = 0.5 * (xx - yy);
        const double z = d * d + xy * yx;
        double c = 1, sh = 1;
        for (int k = terms; k >= 1; --k)
        {
            c = 1 + z * c * (1.0 / ((2 * k - 1) * (2 * k)));
            sh = 1 + z * sh * (1.0 / ((2 * k) * (2 * k + 1)));
        }
        const double e = 1 + expMinusOne<expTerms>(s);
        const double a = e * (c + sh * d), b = e * sh * xy, g = e * sh * yx, h = e * (c - sh * d);
        const double f0 = F[0][l], f1 = F[1][l], f2 = F[2][l], f3 = F[3][l];
        F[0][l] = a * f0 + b * f2;
        F[1][l] = a * f1 + b * f3;
        F[2][l] = g * f0 + h * f2;
        F[3][l] = g * f1 + h * f3;
    }
}

/// exp(A) by Taylor's series: to degree 4 for small A, I + A + A^2 (I/2 + A/6 + A^2/24); else to degree 6 of A/2,
/// squared.
template <bool isSmall>
[[gnu::always_inline]] inline void exponential3(const Record (&A)[9], Record (&out)[9])
{
    Record a[9], power[9], sum[9];
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
            sum[k] += 0.5;
        multiply3(power, sum, out);
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            out[k] += a[k];
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            out[k] += 1;
    }
    else
    {
        // 1 + a + a^2 (1/2 + a/6 + a^2 (1/24 + a/120 + a^2/720))
        Record inner[9];
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            sum[k] = power[k] * (1.0 / 720) + a[k] * (1.0 / 120);
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            sum[k] += 1.0 / 24;
        multiply3(power, sum, inner);
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            inner[k] += a[k] * (1.0 / 6);
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            inner[k] += 0.5;
        multiply3(power, inner, sum);
        MPM_UNROLL
        for (int k = 0; k < 9; ++k)
            sum[k] += a[k];
        MPM_UNROLL
        for (int k = 0; k < 9; k += 4)
            sum[k] += 1;
        multiply3(sum, sum, out);
    }
}

/// A last scalar factor makes det exp(A) = exp(tr A) to round-off.
template <bool isSmall>
void advance3(const TensorLanes<3>& L, double dt, TensorLanes<3>& F)
{
    for (int g = 0; g < lanes; g += 8)
    {
        Record a[9], e[9], f[9], out[9];
        for (int k = 0; k < 9; ++k)
            a[k] = dt * load(L[k] + g);
        exponential3<isSmall>(a, e);
        const Record volume = 1 + expMinusOne < isSmall ? 5 : 13 > (a[0] + a[4] + a[8]);
        const Record factor = 1 + (volume / determinant3(e) - 1) * (1.0 / 3);
        for (int k = 0; k < 9; ++k)
            f[k] = load(F[k] + g);
        multiply3(e, f, out);
        for (int k = 0; k < 9; ++k)
            store(F[k] + g, factor * out[k]);
    }
}
} // namespace

void toMidStep(TakenOver where, double dt, TensorLanes<2>& L)
{
    const double half = where == TakenOver::start ? 0.5 * dt : -0.5 * dt;
    for (int l = 0; l < lanes; ++l)
    {
        const double xx = L[0][l], xy = L[1][l], yx = L[2][l], yy = L[3][l];
        const double J = xx * yy - xy * yx, det = 1 + half * (xx + yy + half * J);
        // L (I + a L)^-1 = (L + a det L I)/det(I + a L)
        const bool moderate = det > leastChange;
        const double over = moderate ? 1 / det : 1, add = moderate ? half * J : 0;
        L[0][l] = (xx + add) * over;
        L[1][l] = xy * over;
        L[2][l] = yx * over;
        L[3][l] = (yy + add) * over;
    }
}

// L (I + a L)^-1 = (I - (I + a L)^-1)/a would cancel; L adj(I + a L) = L (I + a (tr L I - L)) + a^2 det L I by
// Cayley-Hamilton: adj(I + a L) = I + a (tr L I - L) + a^2 adj L, and L adj L = det L I.
void toMidStep(TakenOver where, double dt, TensorLanes<3>& L)
{
    const double half = where == TakenOver::start ? 0.5 * dt : -0.5 * dt;
    for (int g = 0; g < lanes; g += 8)
    {
        Record m[9], square[9];
        for (int k = 0; k < 9; ++k)
            m[k] = load(L[k] + g);
        multiply3(m, m, square);
        const Record trace = m[0] + m[4] + m[8], J = determinant3(m);
        const Record minors = 0.5 * (trace * trace - square[0] - square[4] - square[8]);
        const Record det = 1 + half * (trace + half * (minors + half * J));
        const Record one = Record{} + 1.0;
        const auto moderate = det > leastChange * one;
        const Record over = one / select(moderate, det, one);
        const Record a = select(moderate, half * one, Record{});
        for (int k = 0; k < 9; ++k)
        {
            Record out = m[k] + a * (trace * m[k] - square[k]);
            if (k % 4 == 0)
                out += a * a * J;
            store(L[k] + g, over * out);
        }
    }
}

void advanceDeformation(const TensorLanes<2>& L, double dt, TensorLanes<2>& F)
{
    if (allSmall(L[0], 4 * lanes, dt))
        advance2<5, 3>(L, dt, F);
    else
        advance2<13, 7>(L, dt, F);
}

void advanceDeformation(const TensorLanes<3>& L, double dt, TensorLanes<3>& F)
{
    if (allSmall(L[0], 9 * lanes, dt))
        advance3<true>(L, dt, F);
    else
        advance3<false>(L, dt, F);
}

void rotateStress(const TensorLanes<2>& L, double dt, StressLanes<2>& stress)
{
    for (int l = 0; l < lanes; ++l)
    {
        const double q = 0.25 * dt * (L[2][l] - L[1][l]);
        const double over = 1 / (1 + q * q);
        const double c = (1 - q * q) * over, s = 2 * q * over;
        const double xx = stress[0][l], yy = stress[1][l], xy = stress[3][l];
        const double cc = c * c, ss = s * s, cs = c * s;
        stress[0][l] = cc * xx - 2 * cs * xy + ss * yy;
        stress[1][l] = ss * xx + 2 * cs * xy + cc * yy;
        stress[3][l] = cs * (xx - yy) + (cc - ss) * xy;
    }
}

// Cayley: dR = I + 2/(1 + |q|^2) (Q + Q^2), Q = [q]x, q = dt omega/2, omega the axial vector of W.
void rotateStress(const TensorLanes<3>& L, double dt, StressLanes<3>& stress)
{
    for (int l = 0; l < lanes; ++l)
    {
        const double q0 = 0.25 * dt * (L[7][l] - L[5][l]);
        const double q1 = 0.25 * dt * (L[2][l] - L[6][l]);
        const double q2 = 0.25 * dt * (L[3][l] - L[1][l]);
        const double b = 2 / (1 + q0 * q0 + q1 * q1 + q2 * q2);
        const double R[9] = {1 - b * (q1 * q1 + q2 * q2), b * (q0 * q1 - q2),          b * (q0 * q2 + q1),
                             b * (q0 * q1 + q2),          1 - b * (q0 * q0 + q2 * q2), b * (q1 * q2 - q0),
                             b * (q0 * q2 - q1),          b * (q1 * q2 + q0),          1 - b * (q0 * q0 + q1 * q1)};
        const double xx = stress[0][l], yy = stress[1][l], zz = stress[2][l];
        const double xy = stress[3][l], yz = stress[4][l], zx = stress[5][l];
        const double S[9] = {xx, xy, zx, xy, yy, yz, zx, yz, zz};
        double T[9];
        multiply3(R, S, T);
        stress[0][l] = T[0] * R[0] + T[1] * R[1] + T[2] * R[2];
        stress[1][l] = T[3] * R[3] + T[4] * R[4] + T[5] * R[5];
        stress[2][l] = T[6] * R[6] + T[7] * R[7] + T[8] * R[8];
        stress[3][l] = T[0] * R[3] + T[1] * R[4] + T[2] * R[5];
        stress[4][l] = T[3] * R[6] + T[4] * R[7] + T[5] * R[8];
        stress[5][l] = T[6] * R[0] + T[7] * R[1] + T[8] * R[2];
    }
}

void strainIncrement(const TensorLanes<2>& L, double dt, StressLanes<2>& dStrain)
{
    for (int l = 0; l < lanes; ++l)
    {
        dStrain[0][l] = dt * L[0][l];
        dStrain[1][l] = dt * L[3][l];
        dStrain[2][l] = 0;
        dStrain[3][l] = 0.5 * dt * (L[1][l] + L[2][l]);
    }
}

void strainIncrement(const TensorLanes<3>& L, double dt, StressLanes<3>& dStrain)
{
    for (int l = 0; l < lanes; ++l)
    {
        dStrain[0][l] = dt * L[0][l];
        dStrain[1][l] = dt * L[4][l];
        dStrain[2][l] = dt * L[8][l];
        dStrain[3][l] = 0.5 * dt * (L[1][l] + L[3][l]);
        dStrain[4][l] = 0.5 * dt * (L[5][l] + L[7][l]);
        dStrain[5][l] = 0.5 * dt * (L[2][l] + L[6][l]);
    }
}

void determinant(const TensorLanes<2>& F, double (&J)[lanes])
{
    for (int l = 0; l < lanes; ++l)
        J[l] = F[0][l] * F[3][l] - F[1][l] * F[2][l];
}

void determinant(const TensorLanes<3>& F, double (&J)[lanes])
{
    for (int l = 0; l < lanes; ++l)
    {
        double f[9];
        for (int k = 0; k < 9; ++k)
            f[k] = F[k][l];
        J[l] = determinant3(f);
    }
}

// U = (C + J I)/sqrt(tr C + 2 J), C = F^T F (Hoger & Carlson 1984).
void stretchDiagonal(const TensorLanes<2>& F, double (&U)[2][lanes])
{
    for (int l = 0; l < lanes; ++l)
    {
        const double cxx = F[0][l] * F[0][l] + F[2][l] * F[2][l];
        const double cyy = F[1][l] * F[1][l] + F[3][l] * F[3][l];
        const double J = F[0][l] * F[3][l] - F[1][l] * F[2][l];
        const double over = 1 / std::sqrt(cxx + cyy + 2 * J);
        U[0][l] = (cxx + J) * over;
        U[1][l] = (cyy + J) * over;
    }
}

// R by Newton's iteration R <- (g R + R^-T/g)/2 with Frobenius scaling g (Higham 1986), to round-off in at most nine
// steps for stretch ratios up to 1e6. Then U = R^T F.
void stretchDiagonal(const TensorLanes<3>& F, double (&U)[3][lanes])
{
    for (int group = 0; group < lanes; group += 8)
    {
        Record r[9], f[9];
        for (int k = 0; k < 9; ++k)
            r[k] = f[k] = load(F[k] + group);
        for (int step = 0; step < 9; ++step)
        {
            const Record cof[9] = {r[4] * r[8] - r[5] * r[7], r[5] * r[6] - r[3] * r[8], r[3] * r[7] - r[4] * r[6],
                                   r[2] * r[7] - r[1] * r[8], r[0] * r[8] - r[2] * r[6], r[1] * r[6] - r[0] * r[7],
                                   r[1] * r[5] - r[2] * r[4], r[2] * r[3] - r[0] * r[5], r[0] * r[4] - r[1] * r[3]};
            const Record over = 1 / (r[0] * cof[0] + r[1] * cof[1] + r[2] * cof[2]);
            Record rr{}, ii{};
            for (int k = 0; k < 9; ++k)
            {
                rr += r[k] * r[k];
                ii += cof[k] * cof[k] * over * over;
            }
            Record g = ii / rr;
            for (int l = 0; l < 8; ++l)
                g[l] = std::sqrt(std::sqrt(g[l]));
            const Record plain = 0.5 * g, inverse = 0.5 * over / g;
            Record change{};
            for (int k = 0; k < 9; ++k)
            {
                const Record next = plain * r[k] + inverse * cof[k], d = next - r[k];
                change += d * d;
                r[k] = next;
            }
            if (sumOf(change) < 1e-17) // the next step would change R by the square of this one
                break;
        }
        for (int k = 0; k < 3; ++k)
            store(U[k] + group, r[k] * f[k] + r[3 + k] * f[3 + k] + r[6 + k] * f[6 + k]);
    }
}
} // namespace mpm::constitutive

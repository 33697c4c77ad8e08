#include "constitutive/kinematics.hpp"

#include "constitutive/motion.hpp"

#include <cmath>

namespace mpm::constitutive
{
namespace
{
template <int dim>
bool allSmall(const TensorLanes<dim>& L, double dt)
{
    Record high{}, low{};
    for (int k = 0; k < dim * dim; ++k)
        for (int g = 0; g < lanes; g += 8)
        {
            const Record x = load(L[k] + g);
            high = largerOf(x, high);
            low = smallerOf(x, low);
        }
    return dt * largestOf(largerOf(-low, high)) <= smallMotion<dim>;
}

/// kernel(a, b) on registers of all lanes of two rows of columns, of which those of b change.
template <int na, int nb, class Kernel>
[[gnu::always_inline]] inline void sweep(const double (&a)[na][lanes], double (&b)[nb][lanes], const Kernel& kernel)
{
    for (int g = 0; g < lanes; g += 8)
    {
        Record x[na], y[nb];
        loadRow(a, g, x);
        loadRow(b, g, y);
        kernel(x, y);
        storeRow(b, g, y);
    }
}

template <int n>
void toMidStepOfLanes(TakenOver where, double dt, double (&L)[n][lanes])
{
    const double half = where == TakenOver::start ? 0.5 * dt : -0.5 * dt;
    sweep(L, L, [=](const Record(&)[n], Record(&m)[n]) { toMidStep(half, m); });
}

template <int dim, int n = dim* dim>
void advanceLanes(const TensorLanes<dim>& L, double dt, TensorLanes<dim>& F)
{
    if (allSmall<dim>(L, dt))
        sweep(L, F, [=](const Record(&l)[n], Record(&f)[n]) { advance<true>(dt, l, f); });
    else
        sweep(L, F, [=](const Record(&l)[n], Record(&f)[n]) { advance<false>(dt, l, f); });
}
} // namespace

bool isSmallMotion(const TensorLanes<2>& L, double dt)
{
    return allSmall<2>(L, dt);
}
bool isSmallMotion(const TensorLanes<3>& L, double dt)
{
    return allSmall<3>(L, dt);
}

void toMidStep(TakenOver where, double dt, TensorLanes<2>& L)
{
    toMidStepOfLanes(where, dt, L);
}
void toMidStep(TakenOver where, double dt, TensorLanes<3>& L)
{
    toMidStepOfLanes(where, dt, L);
}

void advanceDeformation(const TensorLanes<2>& L, double dt, TensorLanes<2>& F)
{
    advanceLanes<2>(L, dt, F);
}
void advanceDeformation(const TensorLanes<3>& L, double dt, TensorLanes<3>& F)
{
    advanceLanes<3>(L, dt, F);
}

void rotateStress(const TensorLanes<2>& L, double dt, StressLanes<2>& stress)
{
    sweep(L, stress, [=](const Record(&l)[4], Record(&s)[4]) { rotate(dt, l, s); });
}
void rotateStress(const TensorLanes<3>& L, double dt, StressLanes<3>& stress)
{
    sweep(L, stress, [=](const Record(&l)[9], Record(&s)[6]) { rotate(dt, l, s); });
}

void strainIncrement(const TensorLanes<2>& L, double dt, StressLanes<2>& dStrain)
{
    sweep(L, dStrain, [=](const Record(&l)[4], Record(&s)[4]) { strainOf(dt, l, s); });
}
void strainIncrement(const TensorLanes<3>& L, double dt, StressLanes<3>& dStrain)
{
    sweep(L, dStrain, [=](const Record(&l)[9], Record(&s)[6]) { strainOf(dt, l, s); });
}

void determinant(const TensorLanes<2>& F, double (&J)[lanes])
{
    for (int l = 0; l < lanes; ++l)
        J[l] = F[0][l] * F[3][l] - F[1][l] * F[2][l];
}

void determinant(const TensorLanes<3>& F, double (&J)[lanes])
{
    for (int g = 0; g < lanes; g += 8)
    {
        Record f[9];
        loadRow(F, g, f);
        store(J + g, determinant(f));
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

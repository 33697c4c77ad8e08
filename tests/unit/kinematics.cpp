// Finite motion of one step against closed forms and Eigen: exponential, volume in rotation, rotation of stress,
// stretch.
#include "constitutive/kinematics.hpp"

#include "constitutive/motion.hpp"

#include <catch2/catch.hpp>
#include <Eigen/Dense>
#include <random>

using namespace mpm;
using constitutive::TensorLanes;

namespace
{
template <int dim>
using Matrix = Eigen::Matrix<double, dim, dim>;

template <int dim>
Matrix<dim> lane(const TensorLanes<dim>& t, int l)
{
    Matrix<dim> m;
    for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
            m(i, j) = t[i * dim + j][l];
    return m;
}

template <int dim>
void fill(TensorLanes<dim>& t, double size, unsigned seed, bool nearIdentity)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-size, size);
    for (int l = 0; l < lanes; ++l)
        for (int k = 0; k < dim * dim; ++k)
            t[k][l] = any(random) + (nearIdentity && k % (dim + 1) == 0 ? 1 : 0);
}

/// exp by a long Taylor series.
template <int dim>
Matrix<dim> exponential(const Matrix<dim>& A)
{
    Matrix<dim> sum = Matrix<dim>::Identity(), term = sum;
    for (int k = 1; k < 40; ++k)
    {
        term = term * A / k;
        sum += term;
    }
    return sum;
}

template <int dim>
void checkExponential(double size)
{
    alignas(64) TensorLanes<dim> L, F, before;
    fill<dim>(L, size, 1, false);
    fill<dim>(before, 0.5, 2, true);
    std::copy(&before[0][0], &before[0][0] + dim * dim * lanes, &F[0][0]);
    const double dt = 0.5;
    constitutive::advanceDeformation(L, dt, F);
    for (int l = 0; l < lanes; ++l)
    {
        const Matrix<dim> want = exponential<dim>(dt * lane<dim>(L, l)) * lane<dim>(before, l);
        CHECK((lane<dim>(F, l) - want).norm() <= 2e-9 * size * want.norm());
        // the volume is exact whatever the truncation
        CHECK(lane<dim>(F, l).determinant() ==
              Approx(std::exp(dt * lane<dim>(L, l).trace()) * lane<dim>(before, l).determinant()).epsilon(1e-12));
    }
}

/// Ten turns about an axis in steps of 2 pi/100.
template <int dim>
double volumeAfterTurns()
{
    alignas(64) TensorLanes<dim> L{}, F{};
    for (int l = 0; l < lanes; ++l)
        for (int k = 0; k < dim; ++k)
            F[k * dim + k][l] = 1;
    const double w = 2 * M_PI / 100;
    for (int l = 0; l < lanes; ++l)
    {
        L[1][l] = -w;
        L[dim][l] = w;
    }
    for (int step = 0; step < 1000; ++step)
        constitutive::advanceDeformation(L, 1.0, F);
    CHECK((lane<dim>(F, 5) - Matrix<dim>::Identity()).norm() < 1e-9);
    return lane<dim>(F, 5).determinant();
}

template <int dim>
void checkStretch()
{
    alignas(64) TensorLanes<dim> F;
    fill<dim>(F, 0.8, 3, true);
    for (int l = 0; l < lanes; ++l)
        if (lane<dim>(F, l).determinant() < 0.05) // keep away from inverted samples
            for (int k = 0; k < dim * dim; ++k)
                F[k][l] = k % (dim + 1) == 0 ? 1 + 0.3 * k : 0.2;
    // a quarter turn of a block stretched to 3 x 0.5: F_xx vanishes, sizes must not
    for (int k = 0; k < dim * dim; ++k)
        F[k][0] = dim == 3 && k == 8 ? 1 : 0;
    F[1][0] = -0.5;
    F[dim][0] = 3;
    alignas(64) double U[dim][lanes];
    constitutive::stretchDiagonal(F, U);
    CHECK(U[0][0] == Approx(3).epsilon(1e-13));
    CHECK(U[1][0] == Approx(0.5).epsilon(1e-13));
    for (int l = 0; l < lanes; ++l)
    {
        const Matrix<dim> C = lane<dim>(F, l).transpose() * lane<dim>(F, l);
        const Eigen::SelfAdjointEigenSolver<Matrix<dim>> eigen(C);
        const Matrix<dim> root = eigen.operatorSqrt();
        for (int k = 0; k < dim; ++k)
            CHECK(U[k][l] == Approx(root(k, k)).epsilon(1e-11));
    }
}
} // namespace

TEST_CASE("F follows the exponential of the velocity gradient, its volume exactly")
{
    checkExponential<2>(0.1);
    checkExponential<3>(0.1);
    checkExponential<2>(1);
}

TEST_CASE("small motion in 3D: its middle and its exponential to round-off, from either end of the step")
{
    const double dt = 0.5;
    alignas(64) TensorLanes<3> L;
    fill<3>(L, constitutive::smallMotion<3> / dt, 8, false);
    for (const double half : {0.5 * dt, -0.5 * dt})
        for (int l = 0; l < lanes; ++l)
        {
            const Matrix<3> whole = lane<3>(L, l), I = Matrix<3>::Identity();
            const Matrix<3> middle = whole * (I + half * whole).inverse(), want = exponential<3>(dt * middle);
            double m[9], change[9], F[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
            for (int k = 0; k < 9; ++k)
                m[k] = L[k][l];
            constitutive::toMidStep(dt, half, m, change);
            constitutive::advance<true>(dt, m, F);
            for (int k = 0; k < 9; ++k)
            {
                CHECK(m[k] == Approx(middle(k / 3, k % 3)).epsilon(0).margin(2e-17));
                CHECK(change[k] == Approx(want(k / 3, k % 3)).epsilon(0).margin(1e-15));
                CHECK(F[k] == Approx(want(k / 3, k % 3)).epsilon(0).margin(1e-15));
            }
            CHECK(constitutive::determinant(change) == Approx(std::exp(dt * middle.trace())).epsilon(1e-15));
            double exact[6] = {1, -2, 3, 0.5, -0.3, 2}, quick[6] = {1, -2, 3, 0.5, -0.3, 2};
            constitutive::rotate<false>(dt, m, exact);
            constitutive::rotate<true>(dt, m, quick);
            for (int k = 0; k < 6; ++k)
                CHECK(quick[k] == Approx(exact[k]).epsilon(0).margin(5e-15));
        }
}

TEST_CASE("small motion in 2D: its exponential and turn to round-off")
{
    const double dt = 0.5;
    alignas(64) TensorLanes<2> L;
    fill<2>(L, constitutive::smallMotion<2> / dt, 8, false);
    for (int l = 0; l < 4; ++l) // the largest there are
        for (int k = 0; k < 4; ++k)
            L[k][l] = (l == 1 && k == 1) || (l == 2 && k == 3) || (l == 3 && k != 0) ? -0.04 : 0.04;
    for (int l = 0; l < lanes; ++l)
    {
        const Matrix<2> want = exponential<2>(dt * lane<2>(L, l));
        const double m[4] = {L[0][l], L[1][l], L[2][l], L[3][l]};
        double F[4] = {1, 0, 0, 1};
        constitutive::advance<true>(dt, m, F);
        for (int k = 0; k < 4; ++k)
            CHECK(F[k] == Approx(want(k / 2, k % 2)).epsilon(0).margin(1e-15));
        double exact[4] = {1, -2, 3, 0.5}, quick[4] = {1, -2, 3, 0.5};
        constitutive::rotate<false>(dt, m, exact);
        constitutive::rotate<true>(dt, m, quick);
        for (int k = 0; k < 4; ++k)
            CHECK(quick[k] == Approx(exact[k]).epsilon(0).margin(2e-15));
    }
}

TEST_CASE("ten turns keep the volume")
{
    CHECK(std::abs(volumeAfterTurns<2>() - 1) < 1e-11);
    CHECK(std::abs(volumeAfterTurns<3>() - 1) < 1e-11);
}

/// dt L = T - I (over the start) or I - T^-1 (over the end) for the step's deformation T: both ends give the same
/// middle.
template <int dim>
void checkMidStep()
{
    const double dt = 0.3;
    alignas(64) TensorLanes<dim> T, fromStart, fromEnd;
    fill<dim>(T, 0.2, 7, true);
    const Matrix<dim> I = Matrix<dim>::Identity();
    for (int l = 0; l < lanes; ++l)
    {
        const Matrix<dim> start = (lane<dim>(T, l) - I) / dt, end = (I - lane<dim>(T, l).inverse()) / dt;
        for (int k = 0; k < dim * dim; ++k)
        {
            fromStart[k][l] = start(k / dim, k % dim);
            fromEnd[k][l] = end(k / dim, k % dim);
        }
    }
    constitutive::toMidStep(constitutive::TakenOver::start, dt, fromStart);
    constitutive::toMidStep(constitutive::TakenOver::end, dt, fromEnd);
    for (int l = 0; l < lanes; ++l)
    {
        const Matrix<dim> step = lane<dim>(T, l), middle = 2 * (step - I) * (step + I).inverse() / dt;
        CHECK((lane<dim>(fromStart, l) - middle).norm() < 1e-12);
        CHECK((lane<dim>(fromEnd, l) - middle).norm() < 1e-12);
    }
}

/// A turn about (1, 2, 3) (in the plane: about z) by 0.3 a step is no strain, and turns stress by exactly that.
template <int dim>
void checkTurn()
{
    Matrix<dim> Q;
    if constexpr (dim == 2)
        Q << std::cos(0.3), -std::sin(0.3), std::sin(0.3), std::cos(0.3);
    else
        Q = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    alignas(64) TensorLanes<dim> L;
    alignas(64) constitutive::StressLanes<dim> strain, stress{};
    for (int l = 0; l < lanes; ++l)
    {
        for (int k = 0; k < dim * dim; ++k)
            L[k][l] = (Q(k / dim, k % dim) - (k % (dim + 1) == 0)) / 0.01;
        stress[0][l] = 1;
    }
    constitutive::toMidStep(constitutive::TakenOver::start, 0.01, L);
    constitutive::strainIncrement(L, 0.01, strain);
    constitutive::rotateStress(L, 0.01, stress);
    for (int k = 0; k < stressSize<dim>; ++k)
        CHECK(strain[k][3] == Approx(0).margin(1e-14));
    const Matrix<dim> turned = Q.col(0) * Q.col(0).transpose();
    CHECK(stress[0][3] == Approx(turned(0, 0)).margin(1e-14));
    CHECK(stress[1][3] == Approx(turned(1, 1)).margin(1e-14));
    CHECK(stress[3][3] == Approx(turned(0, 1)).margin(1e-14));
}

TEST_CASE("the gradient over mid-step is the same from both ends, and a turn is no strain")
{
    checkMidStep<2>();
    checkMidStep<3>();
    checkTurn<2>();
    checkTurn<3>();
}

TEST_CASE("a step that deforms by half or more keeps its gradient")
{
    alignas(64) TensorLanes<2> flat{};
    alignas(64) TensorLanes<3> solid{};
    flat[0][5] = solid[0][5] = -3;
    constitutive::toMidStep(constitutive::TakenOver::start, 1, flat);
    constitutive::toMidStep(constitutive::TakenOver::start, 1, solid);
    CHECK(flat[0][5] == -3);
    CHECK(solid[0][5] == -3);
}

TEST_CASE("stress turns by the Hughes-Winget rotation")
{
    alignas(64) TensorLanes<3> L;
    alignas(64) constitutive::StressLanes<3> s;
    fill<3>(L, 1, 4, false);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (auto& component : s)
        for (double& value : component)
            value = any(random);
    alignas(64) constitutive::StressLanes<3> before;
    std::copy(&s[0][0], &s[0][0] + 6 * lanes, &before[0][0]);
    const double dt = 0.7;
    constitutive::rotateStress(L, dt, s);
    for (int l = 0; l < lanes; ++l)
    {
        const auto matrix = [&](const auto& t) {
            Eigen::Matrix3d m;
            m << t[0][l], t[3][l], t[5][l], t[3][l], t[1][l], t[4][l], t[5][l], t[4][l], t[2][l];
            return m;
        };
        const Eigen::Matrix3d G = lane<3>(L, l), I = Eigen::Matrix3d::Identity();
        const Eigen::Matrix3d W = 0.5 * (G - G.transpose());
        const Eigen::Matrix3d R = (I - 0.5 * dt * W).inverse() * (I + 0.5 * dt * W);
        CHECK((matrix(s) - R * matrix(before) * R.transpose()).norm() < 1e-13);
    }
}

TEST_CASE("plane strain is the 3D motion with a plane of symmetry")
{
    alignas(64) TensorLanes<2> flat;
    alignas(64) TensorLanes<3> solid{};
    alignas(64) constitutive::StressLanes<2> s2, e2;
    alignas(64) constitutive::StressLanes<3> s3{}, e3;
    fill<2>(flat, 1, 6, false);
    for (int l = 0; l < lanes; ++l)
    {
        solid[0][l] = flat[0][l];
        solid[1][l] = flat[1][l];
        solid[3][l] = flat[2][l];
        solid[4][l] = flat[3][l];
        for (int k = 0; k < 4; ++k)
            s2[k][l] = s3[k][l] = std::sin(l + 3.0 * k);
    }
    constitutive::rotateStress(flat, 0.3, s2);
    constitutive::rotateStress(solid, 0.3, s3);
    constitutive::strainIncrement(flat, 0.3, e2);
    constitutive::strainIncrement(solid, 0.3, e3);
    for (int l = 0; l < lanes; ++l)
        for (int k = 0; k < 4; ++k)
        {
            CHECK(s2[k][l] == Approx(s3[k][l]).margin(1e-14));
            CHECK(e2[k][l] == Approx(e3[k][l]).margin(1e-15));
        }
}

TEST_CASE("the stretch follows U, not F: a rigid quarter turn leaves sizes unchanged")
{
    checkStretch<2>();
    checkStretch<3>();
}

// Laws that are functions of F: stress is the derivative of the energy, closed forms, objectivity, plane strain and 3D,
// repeated principal stretches, the bound of wave speeds, and a budget that closes.
#include "case/makeStepper.hpp"
#include "constitutive/hencky.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/neoHookean.hpp"
#include "constitutive/singlePoint.hpp"
#include "constitutive/smallStrain.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <Eigen/Dense>
#include <numbers>
#include <random>

using namespace mpm;
using namespace mpm::constitutive;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
const ElasticModuli moduli{1e7, 0.3};

std::vector<std::unique_ptr<Hyperelastic>> laws(const ElasticModuli& m = moduli)
{
    std::vector<std::unique_ptr<Hyperelastic>> out;
    out.push_back(std::make_unique<NeoHookean>(m));
    out.push_back(std::make_unique<Hencky>(m));
    out.push_back(std::make_unique<SmallStrain>(m));
    return out;
}

template <int dim>
struct Response
{
    Matrix3d stress = Matrix3d::Zero();
    double energy, factor;
    Region region;
};

template <int dim>
Response<dim> respond(const Hyperelastic& law, const Matrix3d& F)
{
    alignas(64) TensorLanes<dim> f;
    for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
            std::fill_n(f[i * dim + j], lanes, F(i, j));
    Chunk<dim> chunk;
    for (auto& row : chunk.stress)
        std::fill_n(row, lanes, 1e300); // must not matter
    for (auto& row : chunk.dStrain)
        std::fill_n(row, lanes, 1e300);
    chunk.F = &f;
    law.update(chunk);
    alignas(64) double energy[lanes], factor[lanes];
    law.strainEnergy(f, energy);
    law.waveFactor(f, factor);
    Response<dim> out;
    out.energy = energy[63];
    out.factor = factor[63];
    out.region = chunk.region[63];
    const auto s = [&](int k) { return k < stressSize<dim> ? chunk.stress[k < stressSize<dim> ? k : 0][63] : 0.0; };
    out.stress << s(0), s(3), s(5), s(3), s(1), s(4), s(5), s(4), s(2);
    return out;
}

Matrix3d rotation(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized().matrix();
}

Matrix3d inPlane(double angle)
{
    Matrix3d R = Matrix3d::Identity();
    R(0, 0) = R(1, 1) = std::cos(angle);
    R(1, 0) = std::sin(angle);
    R(0, 1) = -R(1, 0);
    return R;
}

/// F with principal stretches between e^-reach and e^reach; in plane strain where dim = 2.
Matrix3d deformation(std::mt19937& random, int dim, double reach)
{
    std::uniform_real_distribution<double> log(-reach, reach), angle(0, 2 * std::numbers::pi);
    const Vector3d stretch(std::exp(log(random)), std::exp(log(random)), dim == 3 ? std::exp(log(random)) : 1);
    const Matrix3d A = dim == 3 ? rotation(random) : inPlane(angle(random));
    const Matrix3d B = dim == 3 ? rotation(random) : inPlane(angle(random));
    return A * stretch.asDiagonal() * B;
}

template <int dim>
Matrix3d nominal(const Hyperelastic& law, const Matrix3d& F)
{
    return F.determinant() * respond<dim>(law, F).stress * F.inverse().transpose();
}
} // namespace

TEMPLATE_TEST_CASE_SIG("stress is the derivative of the energy, and turns with the body", "", ((int dim), dim), 2, 3)
{
    std::mt19937 random(1);
    for (const auto& law : laws())
        for (int trial = 0; trial < 40; ++trial)
        {
            const Matrix3d F = deformation(random, dim, trial < 20 ? 0.7 : 0.05);
            const auto here = respond<dim>(*law, F);
            CHECK(here.region == Region::elastic);
            const Matrix3d P = nominal<dim>(*law, F);
            for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                {
                    const double d = 1e-4;
                    const auto energy = [&](double step) {
                        Matrix3d moved = F;
                        moved(i, j) += step;
                        return respond<dim>(*law, moved).energy;
                    };
                    const double slope = (8 * (energy(d) - energy(-d)) - (energy(2 * d) - energy(-2 * d))) / (12 * d);
                    CHECK(P(i, j) == Approx(slope).margin(1e-7 * moduli.young));
                }
            const Matrix3d R = dim == 3 ? rotation(random) : inPlane(0.3 * trial);
            const auto turned = respond<dim>(*law, R * F), other = respond<dim>(*law, F * R);
            CHECK((turned.stress - R * here.stress * R.transpose()).norm() <= 1e-13 * moduli.young);
            CHECK(turned.energy == Approx(here.energy).epsilon(1e-11));
            CHECK(turned.factor == Approx(here.factor).epsilon(1e-12));
            CHECK((other.stress - here.stress).norm() <= 1e-13 * moduli.young); // isotropy
        }
}

TEST_CASE("closed forms: confined compression, and pure rotation without stress")
{
    const double lambda = moduli.lame(), mu = moduli.shear(), M = lambda + 2 * mu;
    for (const double l : {0.5, 0.9, 1 + 1e-9, 1.7})
    {
        const Matrix3d F = Vector3d(1, l, 1).asDiagonal();
        const auto neo = respond<2>(NeoHookean(moduli), F), hencky = respond<2>(Hencky(moduli), F),
                   small = respond<2>(SmallStrain(moduli), F);
        const double e = l - 1, log = std::log1p(e);
        CHECK(neo.stress(1, 1) == Approx((mu * (2 * e + e * e) + lambda * log) / l).epsilon(1e-14));
        CHECK(neo.stress(0, 0) == Approx(lambda * log / l).epsilon(1e-14));
        CHECK(neo.stress(2, 2) == neo.stress(0, 0));
        CHECK(neo.energy ==
              Approx(mu * (e + e * e / 2 - log) + lambda / 2 * log * log).epsilon(std::abs(e) < 1e-6 ? 1e-6 : 1e-12));
        CHECK(hencky.stress(1, 1) == Approx(M * log / l).epsilon(1e-13));
        CHECK(hencky.stress(0, 0) == Approx(lambda * log / l).epsilon(1e-13));
        CHECK(hencky.energy == Approx(M * log * log / 2).epsilon(1e-13));
        CHECK(small.stress(1, 1) == Approx(M * e).epsilon(1e-13)); // M (l - 1), whatever the stretch
        CHECK(small.stress(2, 2) == Approx(lambda * e / l).epsilon(1e-13));
        CHECK(small.energy == Approx(M * e * e / 2).epsilon(1e-13));
    }
    // the energy of small strains keeps its digits: M e^2/2 (1 + O(e))
    const double e = 1e-8;
    CHECK(respond<2>(NeoHookean(moduli), Vector3d(1, 1 + e, 1).asDiagonal()).energy ==
          Approx(M * e * e / 2).epsilon(3 * e));
    // nominal stress of smallStrain is linear in the displacement gradient where nothing rotates
    Matrix3d H;
    H << 0.2, 0.1, 0, 0.1, -0.3, 0, 0, 0, 0;
    const Matrix3d P = nominal<2>(SmallStrain(moduli), Matrix3d::Identity() + H);
    CHECK((P - (lambda * H.trace() * Matrix3d::Identity() + 2 * mu * H)).norm() <= 1e-13 * moduli.young);
    for (const auto& law : laws())
    {
        CHECK(respond<2>(*law, Matrix3d::Identity()).stress.norm() == 0);
        CHECK(respond<3>(*law, Matrix3d::Identity()).stress.norm() == 0);
        CHECK(respond<3>(*law, Matrix3d::Identity()).factor == Approx(1).epsilon(1e-15));
        CHECK(respond<2>(*law, inPlane(1)).stress.norm() <= 4e-16 * 10 * moduli.young);
        CHECK(law->waveModulus() == Approx(M).epsilon(1e-14));
        CHECK_FALSE(law->plastic());
    }
}

TEST_CASE("Hencky's stress against the logarithm of a matrix, and plane strain against 3D")
{
    std::mt19937 random(2);
    const double lambda = moduli.lame(), mu = moduli.shear();
    for (int trial = 0; trial < 50; ++trial)
    {
        Matrix3d F = deformation(random, 3, 1);
        const Eigen::SelfAdjointEigenSolver<Matrix3d> b(F * F.transpose());
        const Matrix3d logV = b.eigenvectors() * (0.5 * b.eigenvalues().array().log()).matrix().asDiagonal() *
                              b.eigenvectors().transpose();
        const Matrix3d kirchhoff = lambda * logV.trace() * Matrix3d::Identity() + 2 * mu * logV;
        const Matrix3d stress = respond<3>(Hencky(moduli), F).stress;
        CHECK((F.determinant() * stress - kirchhoff).norm() <= 3e-13 * moduli.young * b.eigenvalues()(2));
        F = deformation(random, 2, 1);
        for (const auto& law : laws())
        {
            const auto plane = respond<2>(*law, F);
            const auto solid = respond<3>(*law, F);
            CHECK((plane.stress - solid.stress).norm() <= 2e-14 * moduli.young * F.squaredNorm() / F.determinant());
            CHECK(plane.energy == Approx(solid.energy).epsilon(1e-12));
            CHECK(plane.factor == Approx(solid.factor).epsilon(1e-12));
        }
    }
}

TEST_CASE("repeated and nearly repeated principal stretches lose no digit")
{
    std::mt19937 random(3);
    const double lambda = moduli.lame(), mu = moduli.shear();
    for (const double gap : {0.0, 1e-16, 1e-12, 1e-8, 1e-4})
        for (const double size : {1e-6, 0.3})
            for (int twice = 0; twice < 3; ++twice)
            {
                Vector3d h(size, size + gap, size - gap);
                if (twice > 0)
                    h(twice) = -size;
                const Matrix3d R = rotation(random);
                const Matrix3d F = R * h.array().exp().matrix().asDiagonal() * R.transpose();
                const Matrix3d logV = R * h.asDiagonal() * R.transpose();
                const Matrix3d kirchhoff = lambda * h.sum() * Matrix3d::Identity() + 2 * mu * logV;
                // F itself is only known to 1e-16
                CHECK((F.determinant() * respond<3>(Hencky(moduli), F).stress - kirchhoff).norm() <=
                      5e-15 * moduli.young);
            }
    // equal stretches in the plane, to the last bit: no direction is preferred
    const auto stress = respond<2>(Hencky(moduli), 0.8 * Matrix3d::Identity()).stress;
    CHECK(stress(0, 0) == stress(1, 1));
    CHECK(stress(0, 1) == 0);
}

TEMPLATE_TEST_CASE_SIG("the wave factor bounds the acoustic tensor", "", ((int dim), dim), 2, 3)
{
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    for (const double nu : {0.0, 0.3, 0.49})
        for (const auto& law : laws({1e7, nu}))
        {
            double closest = 0;
            for (int trial = 0; trial < 60; ++trial)
            {
                const Matrix3d F = trial == 0 ? Matrix3d(Vector3d(1, 0.7, 1).asDiagonal())
                                              : deformation(random, dim, trial < 30 ? 0.4 : 1.0);
                const double bound = respond<dim>(*law, F).factor;
                for (int k = 0; k < 20; ++k)
                {
                    Vector3d n(normal(random), normal(random), dim == 3 ? normal(random) : 0);
                    if (k < dim)
                        n = Eigen::SelfAdjointEigenSolver<Matrix3d>(F * F.transpose()).eigenvectors().col(k);
                    if (dim == 2)
                        n(2) = 0;
                    if (n.norm() < 0.5)
                        continue;
                    n.normalize();
                    const Vector3d m = F.transpose() * n;
                    // Q v = d/ds P(F + s v m^T) m, since dF = s v m^T is a wave's displacement gradient times F
                    Matrix3d Q = Matrix3d::Zero();
                    const double d = 1e-5 / m.norm();
                    for (int a = 0; a < dim; ++a)
                        Q.col(a) = (nominal<dim>(*law, F + d * Vector3d::Unit(a) * m.transpose()) -
                                    nominal<dim>(*law, F - d * Vector3d::Unit(a) * m.transpose())) *
                                   m / (2 * d);
                    const double fastest =
                        Eigen::SelfAdjointEigenSolver<Matrix3d>(0.5 * (Q + Q.transpose())).eigenvalues()(2) /
                        law->waveModulus();
                    CHECK(fastest <= bound * (1 + 1e-6) + 1e-6);
                    closest = std::max(closest, fastest / bound);
                }
            }
            CHECK(closest > 0.9); // a bound worth having
        }
}

TEST_CASE("the budget of a vibrating block closes to round-off, and the scheme keeps its energy")
{
    for (const auto& law : laws({1e5, 0.3}))
        for (const auto update :
             {stepping::StressUpdate::USF, stepping::StressUpdate::USL, stepping::StressUpdate::MUSL})
        {
            auto s =
                scenes::seedBlock({.corner = {1, 1, 0}, .n = {6, 6, 1}, .spacing = 0.25, .h = 0.5, .cells = {7, 7, 1}});
            auto& p = s.particles;
            for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            {
                p.v[0][i] = 2 * std::cos(2 * p.x[0][i]);
                p.v[1][i] = std::sin(p.x[0][i] + 2 * p.x[1][i]);
            }
            stepping::Scene scene;
            scene.materials = {{"solid", 1000, std::shared_ptr<const Law>(law.get(), [](const Law*) {})}};
            scene.stressUpdate = update;
            auto stepper = cases::makeStepper("uGIMP", s, scene);
            stepping::beginLedger(s, scene.materials);
            const double start = s.ledger.initialKineticEnergy;
            double stored = 0;
            for (int i = 0; i < 400; ++i)
            {
                stepper->step(2e-3);
                stored = std::max(stored, stepper->report().strainEnergy);
            }
            const auto t = stepping::totals(s, scene.materials);
            CHECK(stored > 0.2 * start);
            CHECK(stepper->report().strainEnergy == Approx(t.strainEnergy).epsilon(1e-12));
            CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 1e-10 * start);
            CHECK(std::abs(s.ledger.finiteStrainWork) < 0.02 * start); // an error of time integration, no source
        }
}

TEST_CASE("chunks of several materials: each law acts on its own particles")
{
    auto s = scenes::seedBlock({.corner = {1, 1, 0}, .n = {6, 6, 1}, .spacing = 0.25, .h = 0.5, .cells = {7, 7, 1}});
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.v[0][i] = std::cos(2 * p.x[0][i]);
        p.material[i] = std::int32_t(i % 3);
    }
    s.materials = {"a", "b", "c"};
    stepping::Scene scene;
    const ElasticModuli m{1e5, 0.3};
    scene.materials = {{"a", 1000, std::make_shared<NeoHookean>(m)},
                       {"b", 1000, std::make_shared<LinearElastic>(m)},
                       {"c", 1000, std::make_shared<Hencky>(m)}};
    auto stepper = cases::makeStepper("uGIMP", s, scene);
    stepping::beginLedger(s, scene.materials);
    for (int i = 0; i < 200; ++i)
        stepper->step(2e-3);
    const auto t = stepping::totals(s, scene.materials);
    CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 1e-10 * s.ledger.initialKineticEnergy);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        if (p.material[i] != 1)
        {
            Matrix3d F = Matrix3d::Identity();
            for (int k = 0; k < 4; ++k)
                F(k / 2, k % 2) = p.F[std::size_t(k)][i];
            const auto* law = scene.materials[std::size_t(p.material[i])].law->hyperelastic();
            const auto expected = respond<2>(*law, F).stress;
            CHECK(p.stress[0][i] == Approx(expected(0, 0)).margin(1e-9 * m.young));
            CHECK(p.stress[3][i] == Approx(expected(0, 1)).margin(1e-9 * m.young));
        }
}

TEST_CASE("moduli out of bounds are refused")
{
    CHECK_THROWS_AS(NeoHookean({0, 0.3}), InputError);
    CHECK_THROWS_AS(Hencky({1e6, 0.5}), InputError);
    CHECK_THROWS_AS(SmallStrain({1e6, -1}), InputError);
}

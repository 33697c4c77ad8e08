// The semi-discrete equations: balances of one evaluation, order of particles, strays, what is refused.
#include "case/makeStepper.hpp"
#include "constitutive/hencky.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/neoHookean.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <Eigen/Dense>
#include <random>

using namespace mpm;
using Catch::Matchers::Contains;

namespace
{
constexpr double E = 1e7, density = 1000;

/// A block moving and stressed at random, beside walls.
state::State randomBlock(int dim)
{
    auto s = scenes::seedBlock(
        {.dim = dim, .n = {10, 8, 6}, .spacing = 0.5, .h = 1, .density = density, .cells = {9, 8, 7}});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        for (int a = 0; a < dim; ++a)
        {
            p.x[std::size_t(a)][i] += 0.1 * any(random);
            p.v[std::size_t(a)][i] = any(random);
        }
        for (int k = 0; k < stressComponents(dim); ++k)
            p.stress[std::size_t(k)][i] = 1e4 * any(random);
        for (int k = 0; k < dim * dim; ++k)
            p.F[std::size_t(k)][i] += 0.1 * any(random);
    }
    return s;
}

class Push : public stepping::BodyForce
{
  public:
    void acceleration(const state::Particles& p, Index first, int count, double t, double (&b)[3][lanes]) const override
    {
        for (int l = 0; l < count; ++l)
            for (std::size_t a = 0; a < 3; ++a)
                b[a][l] = std::sin(t + p.x[0][std::size_t(first + l)] + double(a));
    }
};

stepping::Scene scene()
{
    stepping::Scene out;
    out.materials = {scenes::elastic(E, 0.3, density)};
    out.gravity = Vector3{1, -9.8, 0};
    out.relaxationTime = 0.3;
    out.bodyForce = std::make_shared<Push>();
    out.walls = {{"base", nodal::WallType::fixed, 1, -1, 0, 0, false},
                 {"left", nodal::WallType::roller, 0, -1, 0, 0, false}};
    return out;
}

struct Rates
{
    std::vector<double> y, rate;
    semiDiscrete::Powers powers;
};

Rates evaluate(const std::string& shape, const state::State& s)
{
    Rates out;
    auto equations = cases::makeSemiDiscrete(shape, s, scene());
    equations->pack(s, out.y);
    out.rate.resize(out.y.size());
    equations->rates(0.7, out.y.data(), out.rate.data(), &out.powers);
    return out;
}
} // namespace

TEST_CASE("one evaluation keeps the balances of energy, momentum and volume")
{
    for (const int dim : {2, 3})
        for (const std::string shape : {"uGIMP", "cpGIMP", "quadraticBSpline", "cubicBSpline"})
        {
            const auto s = randomBlock(dim);
            const auto r = evaluate(shape, s);
            const auto& p = s.particles;
            const std::size_t n = std::size_t(p.size()), d = std::size_t(dim);
            double power = 0, stress = 0, volume = 0;
            Vector3 force{}, body{};
            for (std::size_t i = 0; i < n; ++i)
            {
                double b[3];
                for (std::size_t a = 0; a < d; ++a)
                {
                    b[a] = std::sin(0.7 + p.x[0][i] + double(a));
                    power += p.mass[i] * p.v[a][i] * r.rate[(d + a) * n + i];
                    force[a] += p.mass[i] * r.rate[(d + a) * n + i];
                    body[a] += p.mass[i] * b[a];
                }
                // F' F^-1 is the velocity gradient: V sigma : L
                Eigen::Matrix3d F = Eigen::Matrix3d::Identity(), rate = Eigen::Matrix3d::Zero(), sigma;
                for (std::size_t a = 0; a < d; ++a)
                    for (std::size_t c = 0; c < d; ++c)
                    {
                        F(Index(a), Index(c)) = p.F[a * d + c][i];
                        rate(Index(a), Index(c)) = r.rate[(2 * d + a * d + c) * n + i];
                    }
                const auto t = [&](std::size_t k) { return dim == 3 || k < 4 ? p.stress[k][i] : 0.0; };
                sigma << t(0), t(3), t(5), t(3), t(1), t(4), t(5), t(4), t(2);
                const Eigen::Matrix3d L = rate * F.inverse();
                stress += p.volume0[i] * F.determinant() * sigma.cwiseProduct(L).sum();
                volume += p.volume0[i] * std::abs(L.trace());
            }
            INFO(dim << "D " << shape);
            CHECK(stress == Approx(r.powers.stress).epsilon(1e-10).margin(1e-10 * E * volume));
            const double supplied = r.powers.gravity + r.powers.bodyForce - r.powers.damping - r.powers.stress;
            CHECK(power == Approx(supplied).epsilon(1e-10));
            for (std::size_t a = 0; a < d; ++a)
            {
                // of the body force, walls have taken what acts at their nodes
                const double walls =
                    r.powers.wallForce[a] + r.powers.gravityForce[a] + r.powers.dampingForce[a] + body[a];
                CHECK(force[a] == Approx(walls).epsilon(1e-10));
            }
        }
}

TEST_CASE("strain energy grows by the power of stress, and of rate laws by what finite strain adds")
{
    using constitutive::ElasticModuli;
    const std::vector<std::shared_ptr<const constitutive::Law>> laws = {
        std::make_shared<constitutive::LinearElastic>(ElasticModuli{E, 0.3}),
        std::make_shared<constitutive::NeoHookean>(ElasticModuli{E, 0.3}),
        std::make_shared<constitutive::Hencky>(ElasticModuli{E, 0.3})};
    for (const int dim : {2, 3})
        for (const auto& law : laws)
        {
            auto what = scene();
            what.materials[0].law = law;
            const auto s = randomBlock(dim);
            auto equations = cases::makeSemiDiscrete("cubicBSpline", s, what);
            std::vector<double> y, rate, moved;
            equations->pack(s, y);
            rate.resize(y.size());
            semiDiscrete::Powers powers;
            equations->rates(0, y.data(), rate.data(), &powers);
            const auto energyAt = [&](double t) {
                moved = y;
                for (std::size_t i = 0; i < y.size(); ++i)
                    moved[i] += t * rate[i];
                auto copy = s;
                return equations->unpack(moved.data(), copy).strainEnergy;
            };
            const double dt = 1e-5, change = (energyAt(dt) - energyAt(-dt)) / (2 * dt);
            INFO(dim << "D " << law->name());
            CHECK(change == Approx(powers.stress + powers.finiteStrain).epsilon(1e-5));
            CHECK((powers.finiteStrain == 0) == (law->hyperelastic() != nullptr));
            CHECK(equations->size() ==
                  std::size_t(s.particles.size()) *
                      std::size_t(2 * dim + dim * dim + (law->hyperelastic() ? 0 : stressComponents(dim))));
        }
}

TEST_CASE("a periodic axis has no ends: a block moved round it has the same rates")
{
    auto s = randomBlock(2);
    s.grid.periodic[0] = true;
    auto what = scene();
    what.bodyForce.reset();
    what.walls.pop_back();
    auto equations = cases::makeSemiDiscrete("cubicBSpline", s, what);
    std::vector<double> y, rate, round;
    equations->pack(s, y);
    rate.resize(y.size());
    round.resize(y.size());
    equations->rates(0, y.data(), rate.data());
    const std::size_t n = std::size_t(s.particles.size());
    for (const double shift : {7.0, 9.0, -20.0}) // whole cells; a period is 9 of them
    {
        auto moved = y;
        for (std::size_t i = 0; i < n; ++i)
            moved[i] += shift;
        equations->rates(0, moved.data(), round.data());
        for (std::size_t column = 0; column < y.size() / n; ++column)
        {
            double largest = 0;
            for (std::size_t i = column * n; i < (column + 1) * n; ++i)
                largest = std::max(largest, std::abs(rate[i]));
            for (std::size_t i = column * n; i < (column + 1) * n; ++i)
                REQUIRE(round[i] == Approx(rate[i]).margin(1e-11 * largest));
        }
    }
}

TEST_CASE("rates belong to particles, whatever their order, and follow them out of their tiles")
{
    const auto s = randomBlock(2);
    const auto straight = evaluate("cpGIMP", s);
    auto turned = s;
    std::vector<Index> order;
    for (Index i = 0; i < s.particles.size(); ++i)
        order.push_back(s.particles.size() - 1 - i);
    turned.particles.permute(order);
    const auto back = evaluate("cpGIMP", turned);
    const std::size_t n = order.size();
    const double largest = *std::max_element(straight.rate.begin(), straight.rate.end());
    for (std::size_t k = 0; k < straight.rate.size(); ++k)
    {
        const std::size_t column = k / n, i = k % n;
        REQUIRE(straight.rate[k] == Approx(back.rate[column * n + (n - 1 - i)]).margin(1e-13 * largest));
    }

    auto equations = cases::makeSemiDiscrete("cpGIMP", s, scene());
    auto far = s; // the same motion, three and a half cells up and to the right
    for (std::size_t a = 0; a < 2; ++a)
        for (double& x : far.particles.x[a])
            x += 3.5 - 0.5 * double(a);
    std::vector<double> y, rate, fresh;
    equations->pack(s, y);
    rate.resize(y.size());
    equations->rates(0.7, y.data(), rate.data());
    equations->pack(far, y);
    equations->rates(0.7, y.data(), rate.data());
    CHECK(equations->strayed());
    const auto expected = evaluate("cpGIMP", far);
    for (std::size_t k = 0; k < rate.size(); ++k)
        REQUIRE(rate[k] == Approx(expected.rate[k]).margin(1e-13 * largest));

    for (double& x : far.particles.x[0])
        x += 3;
    equations->pack(far, y);
    CHECK_THROWS_AS(equations->rates(0.7, y.data(), rate.data()), OutsideGrid);
}

TEST_CASE("what has no smooth equations is refused with the reason")
{
    const auto s = randomBlock(2);
    const auto refused = [&](const std::string& shape, const stepping::Scene& what, const std::string& reason) {
        auto copy = s;
        CHECK_THROWS_WITH(cases::makeRungeKutta(shape, stepping::RungeKuttaOrder::RK4, copy, what), Contains(reason));
        CHECK_THAT(cases::whyNotSmooth(shape, what), Contains(reason));
    };
    CHECK(cases::whyNotSmooth("uGIMP", scene()).empty());
    refused("linear", scene(), "gradients of the shape linear jump");
    refused("CPDI", scene(), "gradients of the shape CPDI jump");
    auto other = scene();
    other.walls[0].separation = true;
    refused("uGIMP", other, "'base' separates");
    other = scene();
    other.walls[1] = {"left", nodal::WallType::friction, 0, -1, 0, 0.3, false};
    refused("uGIMP", other, "'left' has friction");
    other = scene();
    other.picRate = 1;
    refused("uGIMP", other, "picRate");
    other = scene();
    other.splitting = splitting::Rule{};
    refused("uGIMP", other, "splitting");
    other = scene();
    other.transfer = stepping::Transfer::APIC;
    refused("uGIMP", other, "FLIP");
    other = scene();
    other.loads = {{"top", true, {}, 1e3}};
    refused("uGIMP", other, "'top'");
    other = scene();
    other.materials[0].law =
        std::make_shared<constitutive::MohrCoulomb>(constitutive::MohrCoulombParameters{{E, 0.3}, 1e3, 30, 0});
    refused("uGIMP", other, "mohrCoulomb of 'solid' can yield");
}

// Viscous damping: exact decay and free fall, its impulse and dissipation in the books, nothing where nothing moves.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
constexpr double tau = 0.05, dt = 1e-3;

stepping::Scene scene(StressUpdate update = StressUpdate::MUSL, bool damped = true)
{
    stepping::Scene out;
    out.materials = {scenes::elastic(1e6, 0.3)};
    out.stressUpdate = update;
    if (damped)
        out.relaxationTime = tau;
    return out;
}

state::State block(const Vector3& velocity, int dim = 2)
{
    return scenes::seedBlock({.dim = dim,
                              .corner = {1, 1.5, 1},
                              .n = {4, 6, 2},
                              .spacing = 0.25,
                              .h = 0.5,
                              .cells = {10, 16, 8},
                              .velocity = velocity});
}

stepping::Totals run(state::State& s, const stepping::Scene& scene, int steps, const std::string& shape = "uGIMP",
                     double step = dt)
{
    const auto stepper = cases::makeStepper(shape, s, scene);
    stepping::beginLedger(s, scene.materials);
    for (int i = 0; i < steps; ++i)
        stepper->step(step);
    return stepping::totals(s, scene.materials);
}

std::map<std::int64_t, std::array<double, 4>> byId(const state::Particles& p)
{
    std::map<std::int64_t, std::array<double, 4>> out;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        out[p.id[i]] = {p.x[0][i], p.x[1][i], p.v[0][i], p.v[1][i]};
    return out;
}

/// p - p_0 - all impulses, largest component.
double momentumMissing(const state::State& s, const stepping::Totals& t)
{
    double worst = 0;
    const auto& l = s.ledger;
    for (int a = 0; a < s.particles.dim; ++a)
        worst = std::max(worst, std::abs(t.momentum[a] - l.initialMomentum[a] - l.gravityImpulse[a] - l.wallImpulse[a] -
                                         l.dampingImpulse[a]));
    return worst;
}
} // namespace

TEST_CASE("uniform motion decays as exp(-t/tau)")
{
    for (const int dim : {2, 3})
        for (const std::string shape : {"linear", "uGIMP", "cpGIMP", "quadraticBSpline"})
            for (const auto update : {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL})
            {
                auto s = block({3, -2, 0}, dim);
                const auto t = run(s, scene(update), 100, shape);
                const double left = std::exp(-100 * dt / tau);
                for (Index i = 0; i < s.particles.size(); ++i)
                {
                    CHECK(s.particles.v[0][std::size_t(i)] == Approx(3 * left).epsilon(1e-12));
                    CHECK(s.particles.v[1][std::size_t(i)] == Approx(-2 * left).epsilon(1e-12));
                }
                const double kinetic = 0.5 * t.mass * 13;
                CHECK(t.kineticEnergy == Approx(kinetic * left * left).epsilon(1e-12));
                CHECK(s.ledger.dampingDissipation == Approx(kinetic * (1 - left * left)).epsilon(1e-12));
                CHECK(s.ledger.dampingImpulse[0] == Approx(-3 * t.mass * (1 - left)).epsilon(1e-12));
                CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 1e-10 * kinetic);
            }
}

TEST_CASE("a damped fall ends at g tau, for any dt")
{
    for (const double step : {1e-3, 1e-2})
    {
        auto s = block({});
        auto fall = scene();
        fall.gravity = Vector3{0, -9.8, 0};
        const int steps = int(std::lround(0.1 / step));
        const auto t = run(s, fall, steps, "uGIMP", step);
        CHECK(s.particles.v[1][0] == Approx(-9.8 * tau * (1 - std::exp(-0.1 / tau))).epsilon(1e-12));
        CHECK(momentumMissing(s, t) < 1e-12 * t.mass);
        CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 1e-10 * s.ledger.gravityWork);
    }
}

TEST_CASE("damped impact on walls: books close, and not without the entry")
{
    for (const auto update : {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL})
    {
        auto s = block({0.2, -0.6, 0});
        auto fall = scene(update);
        fall.gravity = Vector3{0, -9.8, 0};
        fall.walls = {{"base", nodal::WallType::friction, 1, -1, 3, 0.4, true},
                      {"side", nodal::WallType::roller, 0, 1, 4, 0, true}};
        const auto t = run(s, fall, 600, "uGIMP", 5e-4);
        CHECK(s.ledger.wallContacts > 0);
        CHECK(momentumMissing(s, t) < 1e-11 * t.mass);
        const double supplied = s.ledger.initialKineticEnergy + std::abs(s.ledger.gravityWork);
        CHECK(s.ledger.dampingDissipation > 0.5 * supplied);
        // what is left is the time step's: it falls with dt, and is larger in the same scene without damping
        CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 0.04 * s.ledger.dampingDissipation);
    }
}

TEST_CASE("rest stays rest, bitwise; no dt is too large for tau")
{
    auto s = block({});
    const auto start = byId(s.particles);
    run(s, scene(), 50);
    CHECK(byId(s.particles) == start);
    CHECK(s.ledger.dampingDissipation == 0);

    // c_p dt/h = 1.3 of 1.4, dt = 100 tau: motion creeps, and stays bounded
    auto pulled = block({});
    for (Index i = 0; i < pulled.particles.size(); ++i)
        pulled.particles.stress[1][std::size_t(i)] = 1e4;
    auto creep = scene();
    const double large = 1.3 * 0.5 / creep.materials[0].waveSpeed();
    creep.relaxationTime = large / 100;
    const auto before = stepping::totals(pulled, creep.materials);
    const auto after = run(pulled, creep, 400, "uGIMP", large);
    CHECK(after.strainEnergy < before.strainEnergy);
    CHECK(after.kineticEnergy < 1e-4 * before.strainEnergy);
}

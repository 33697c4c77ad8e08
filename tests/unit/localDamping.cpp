// Local damping: nothing at rest or in steady motion, (1 - alpha) g in a fall, never negative dissipation, no part of a
// wall's reaction, books that close, bitwise nothing with coefficient 0.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
constexpr double dt = 1e-3, alpha = 0.7;

stepping::Scene scene(StressUpdate update = StressUpdate::MUSL, std::optional<double> coefficient = alpha)
{
    stepping::Scene out;
    out.materials = {scenes::elastic(1e6, 0.3)};
    out.stressUpdate = update;
    out.localDamping = coefficient;
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
} // namespace

TEST_CASE("steady motion is not damped; a fall goes at (1 - alpha) g")
{
    for (const int dim : {2, 3})
        for (const auto update : {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL})
        {
            CAPTURE(dim, int(update));
            const auto moved = treated::run(block({3, -2, 0}, dim), "uGIMP", scene(update), 100, dt);
            for (Index i = 0; i < moved.particles.size(); ++i)
                CHECK(moved.particles.v[0][std::size_t(i)] == Approx(3).epsilon(1e-12));
            CHECK(std::abs(moved.ledger.dampingDissipation) < 1e-12 * moved.ledger.initialKineticEnergy);

            auto fall = scene(update);
            fall.gravity = Vector3{0, -9.8, 0};
            const auto fallen = treated::run(block({}, dim), "uGIMP", fall, 100, dt);
            const double speed = (1 - alpha) * 9.8 * 0.1, mass = stepping::totals(fallen, fall.materials).mass;
            CHECK(fallen.particles.v[1][0] == Approx(-speed).epsilon(1e-12));
            CHECK(fallen.ledger.dampingImpulse[1] == Approx(alpha * 9.8 * 0.1 * mass).epsilon(1e-12));
            // the way fallen takes half a step more: sum over n of (n + 1/2 +- 1/2) dt v dt
            CHECK(fallen.ledger.dampingDissipation ==
                  Approx(alpha / (1 - alpha) * 0.5 * mass * speed * speed).epsilon(1e-9));
            CHECK(treated::residual(fallen, fall) < 1e-12 * fallen.ledger.gravityWork);
        }
}

TEST_CASE("it takes energy at every step of a stirred body, whatever dt, and the books close")
{
    for (const auto update : {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL})
        for (const double share : {0.1, 0.95}) // of the stability limit
        {
            CAPTURE(int(update), share);
            auto s = treated::block();
            treated::stir(s, 1);
            auto sc = scene(update, 0.8);
            sc.walls = {{"base", nodal::WallType::friction, 1, -1, 3, 0.4, true}};
            sc.gravity = Vector3{0, -9.8, 0};
            const auto stepper = cases::makeStepper("uGIMP", s, sc);
            stepping::beginLedger(s, sc.materials);
            const double step = share * (update == StressUpdate::USL ? 0.36 : 1.2) / sc.materials[0].waveSpeed();
            double last = 0;
            for (int n = 0; n < 400; ++n)
            {
                stepper->step(step);
                REQUIRE(s.ledger.dampingDissipation >= last);
                last = s.ledger.dampingDissipation;
            }
            const double supplied = s.ledger.initialKineticEnergy + std::abs(s.ledger.gravityWork);
            CHECK(last > 0.1 * supplied);
            CHECK(treated::residual(s, sc) < 1e-10 * supplied);
            const auto t = stepping::totals(s, sc.materials);
            CHECK(t.kineticEnergy + t.strainEnergy < supplied);
        }
}

TEST_CASE("at rest on a wall nothing is damped: the wall carries the whole weight")
{
    // a column in equilibrium between rollers
    auto s = scenes::seedBlock({.n = {2, 10, 1}, .spacing = 0.5, .h = 1, .cells = {1, 6, 1}});
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.stress[1][i] = -9800 * (5 - p.x[1][i]);
        p.stress[0][i] = p.stress[2][i] = 3.0 / 7 * p.stress[1][i];
    }
    auto sc = scene();
    sc.gravity = Vector3{0, -9.8, 0};
    sc.walls = {{"base", nodal::WallType::friction, 1, -1, 0, 0.5, true},
                {"left", nodal::WallType::roller, 0, -1, 0, 0, false},
                {"right", nodal::WallType::roller, 0, 1, 1, 0, false}};
    const auto stepper = cases::makeStepper("uGIMP", s, sc);
    stepping::beginLedger(s, sc.materials);
    const int steps = 100;
    for (int n = 0; n < steps; ++n)
        stepper->step(dt);
    const double weight = 5 * 1000 * 9.8;
    CHECK(s.ledger.wallImpulse[1] == Approx(weight * steps * dt).epsilon(1e-10));
    CHECK(std::abs(s.ledger.dampingImpulse[1]) < 1e-10 * weight * steps * dt);
    CHECK(stepper->report().unbalancedForce < 1e-10 * weight);
    CHECK(stepper->report().appliedForce > weight);
}

TEST_CASE("coefficient 0 changes no bit")
{
    auto s = treated::block();
    treated::stir(s, 1);
    const auto with = treated::run(s, "uGIMP", scene(StressUpdate::MUSL, 0.0), 60, 5e-3);
    const auto without = treated::run(s, "uGIMP", scene(StressUpdate::MUSL, std::nullopt), 60, 5e-3);
    for (int a = 0; a < 2; ++a)
    {
        CHECK(with.particles.x[a] == without.particles.x[a]);
        CHECK(with.particles.v[a] == without.particles.v[a]);
    }
    CHECK(with.particles.stress[0] == without.particles.stress[0]);
}

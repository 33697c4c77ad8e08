// The monitor: silent over an elastic block in free flight and bouncing, awake when energy, momentum or the yield
// surface are tampered with, and when the step is too large.
#include "stepping/monitor.hpp"

#include "case/makeStepper.hpp"
#include "stepping/timeStep.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace mpm;
using Catch::Contains;

namespace
{
struct Bouncing
{
    state::State state;
    stepping::Scene scene;
    std::unique_ptr<stepping::Stepper> stepper;

    explicit Bouncing(double speed, double height = 0.1)
    {
        state = scenes::seedBlock({.corner = {2, 1 + height, 0},
                                   .n = {8, 8, 1},
                                   .spacing = 0.25,
                                   .h = 0.5,
                                   .cells = {16, 12, 1},
                                   .velocity = {0, -speed, 0}});
        scene.materials = {scenes::elastic(1e6, 0.3)};
        scene.walls = {{"floor", nodal::WallType::roller, 1, -1, 2, 0, true}};
        stepper = cases::makeStepper("uGIMP", state, scene);
        stepping::beginLedger(state, scene.materials);
    }
    stepping::StabilityLimit limit() { return stepping::stabilityLimit(*stepper, state, scene, true); }
};
} // namespace

TEST_CASE("a block that bounces off a floor gives the monitor nothing to say, and its extremes are those of the run")
{
    Bouncing b(0.5);
    stepping::Monitor monitor(b.state, b.scene, {});
    const double dt = 0.5 * b.limit().deltaT;
    double lowest = 1;
    for (int i = 0; i < 200; ++i)
    {
        b.stepper->step(dt);
        REQUIRE(monitor.look(b.state, b.stepper->report(), b.limit()).text.empty());
        lowest = std::min(lowest, b.stepper->report().smallestJacobian);
    }
    REQUIRE(b.state.ledger.wallImpulse[1] > 0); // it has bounced
    const auto& e = monitor.extremes();
    CHECK(e.jacobian == lowest);
    CHECK(e.jacobian < 1);
    CHECK(e.energyFromNowhere < 0.05);
    CHECK(e.limitUse == Approx(0.5).epsilon(0.05));
    CHECK(e.courant < e.limitUse * b.limit().courant);
    CHECK(e.nodalMass > 0);
    CHECK(e.nodalMass < 0.5); // the rim of the block
}

TEST_CASE("a step beyond the limit is found before it has made ten times the energy there was")
{
    Bouncing b(0.5);
    stepping::Monitor monitor(b.state, b.scene, {});
    const double dt = 2 * b.limit().deltaT, before = b.state.ledger.kineticEnergy;
    std::string text;
    double most = 0;
    for (int i = 0; i < 500 && text.empty(); ++i)
    {
        b.stepper->step(dt);
        text = monitor.look(b.state, b.stepper->report(), b.limit()).text;
        most = b.state.ledger.kineticEnergy + b.stepper->report().strainEnergy;
    }
    CHECK_THAT(text, Contains("from nowhere"));
    CHECK(most < 10 * before);
}

TEST_CASE("energy, momentum, stress and numbers that are not what they should be are named")
{
    Bouncing b(0.5, 2); // it does not come to the floor
    for (int i = 0; i < 5; ++i)
        b.stepper->step(0.3 * b.limit().deltaT);
    stepping::Monitor monitor(b.state, b.scene, {.energyTolerance = 0.1});
    auto report = b.stepper->report();
    const auto said = [&](const state::State& state) { return monitor.look(state, report, b.limit()); };
    REQUIRE(said(b.state).text.empty());
    const double there = b.state.ledger.kineticEnergy;

    auto state = b.state;
    state.ledger.kineticEnergy += 0.09 * there;
    CHECK(said(state).text.empty());
    state.ledger.kineticEnergy += 0.03 * there;
    CHECK_THAT(said(state).text, Contains("12 % of the energy"));
    CHECK_FALSE(said(state).fatal);
    state.ledger.gravityWork = 0.12 * there; // given, so it is not from nowhere
    CHECK(said(state).text.empty());
    state.ledger.kineticEnergy = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(said(state).text, Contains("finite"));
    CHECK(said(state).fatal);

    state = b.state;
    state.ledger.wallImpulse[0] += 1e-6 * std::abs(report.momentum[1]);
    CHECK_THAT(said(state).text, Contains("momentum"));

    report.maxYieldViolation = 1e-5;
    CHECK_THAT(said(b.state).text, Contains("yield surface"));
}

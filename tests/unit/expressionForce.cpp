// Body forces and reference positions as a user writes them: values, places, faults that end a run.
#include "case/expressionForce.hpp"
#include "base/error.hpp"
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

using namespace mpm;
using Catch::Matchers::Contains;
using dictionary::Dictionary;

namespace
{
std::shared_ptr<const cases::ExpressionForce> force(const std::string& text, int dim = 2)
{
    const auto d = Dictionary::fromText(text, "constant/bodyForce");
    auto out = cases::readBodyForce(d, dim);
    d.rejectUnread();
    return out;
}

state::State block(Index n = 10)
{
    return scenes::seedBlock({.corner = {1, 1, 0}, .n = {n, n, 1}, .spacing = 0.25, .h = 0.5, .cells = {12, 12, 1}});
}

std::string faultOf(const std::function<void()>& body)
{
    try
    {
        body();
    }
    catch (const StepError& error)
    {
        return error.what();
    }
    return "nothing";
}
} // namespace

TEST_CASE("each particle gets the value at its place, its start and the time")
{
    auto s = block();
    s.particles.enableX();
    for (double& x : s.particles.x[0])
        x += 0.125;
    const auto b = force("value (\"A*sin(pi*X)*t\" \"x - X + y\"); constants { A 0.05; }");
    REQUIRE(b);
    CHECK(b->usesReference()->text() == "A*sin(pi*X)*t");
    CHECK(b->describe() == "(A*sin(pi*X)*t x - X + y 0)");
    double out[3][lanes];
    b->acceleration(s.particles, 64, 36, 2.0, out);
    for (int l = 0; l < lanes; ++l)
    {
        const std::size_t i = std::size_t(64 + std::min(l, 35));
        CHECK(out[0][l] == (l < 36 ? 0.05 * std::sin(std::numbers::pi * s.particles.X[0][i]) * 2.0 : 0));
        CHECK(out[1][l] == (l < 36 ? s.particles.x[0][i] - s.particles.X[0][i] + s.particles.x[1][i] : 0));
        CHECK(out[2][l] == 0);
    }
    CHECK(b->takeFault().empty());
    CHECK_FALSE(force("value (\"x*t\" 0 0);")->usesReference());
    CHECK_FALSE(force("value (0 0 0);"));
    CHECK(force("dimensions [0 1 -2 0 0 0 0]; value (0 0 \"Z\");", 3)->usesReference());
}

TEST_CASE("a constant force by formula moves a body as gravity does, and its work is booked")
{
    for (const auto update : {stepping::StressUpdate::USF, stepping::StressUpdate::USL, stepping::StressUpdate::MUSL})
    {
        auto s = block(4), other = block(4);
        stepping::Scene scene, heavy;
        scene.materials = heavy.materials = {scenes::elastic(1e6, 0.3)};
        scene.stressUpdate = heavy.stressUpdate = update;
        scene.bodyForce = force("value (\"t < 0.005 ? 1 : 1 + 0*x\" -9.8);");
        heavy.gravity = Vector3{1, -9.8, 0};
        auto a = cases::makeStepper("uGIMP", s, scene), b = cases::makeStepper("uGIMP", other, heavy);
        stepping::beginLedger(s, scene.materials);
        for (int i = 0; i < 20; ++i)
        {
            a->step(1e-3);
            b->step(1e-3);
        }
        for (std::size_t i = 0; i < 16; ++i)
        {
            CHECK(s.particles.v[0][i] == Approx(other.particles.v[0][i]).epsilon(1e-11));
            CHECK(s.particles.v[1][i] == Approx(-9.8 * 0.02).epsilon(1e-11));
            CHECK(s.particles.x[1][i] == Approx(other.particles.x[1][i]).epsilon(1e-13));
        }
        CHECK(s.ledger.bodyForceWork == Approx(other.ledger.gravityWork).epsilon(1e-10));
        const auto t = stepping::totals(s, scene.materials);
        CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 1e-11 * s.ledger.bodyForceWork);
    }
}

// The centre of equal masses under b = - k (x - x0) + sin(t) follows the recursion of the step itself, whatever the
// body does inside: any force taken at another place or time than that of its step shows.
TEST_CASE("forces act at the place and time of their step")
{
    for (const auto update : {stepping::StressUpdate::USF, stepping::StressUpdate::USL, stepping::StressUpdate::MUSL})
    {
        auto s = block(4);
        stepping::Scene scene;
        scene.materials = {scenes::elastic(1e6, 0.3)};
        scene.stressUpdate = update;
        scene.bodyForce = force("value (\"sin(100*t) - k*(x - 2.2)\" \"k*(1.4 - y)\"); constants { k 400; }");
        auto stepper = cases::makeStepper("uGIMP", s, scene);
        stepping::beginLedger(s, scene.materials);
        const double dt = 1e-3;
        double x = 1.5, y = 1.5, u = 0, v = 0;
        for (int i = 0; i < 100; ++i)
        {
            u += dt * (std::sin(100 * (i * dt)) - 400 * (x - 2.2));
            v += dt * 400 * (1.4 - y);
            x += dt * u;
            y += dt * v;
            stepper->step(dt);
        }
        double centre[2] = {0, 0};
        for (std::size_t i = 0; i < 16; ++i)
            for (std::size_t a = 0; a < 2; ++a)
                centre[a] += s.particles.x[a][i] / 16;
        CHECK(centre[0] == Approx(x).epsilon(1e-11));
        CHECK(centre[1] == Approx(y).epsilon(1e-11));
        const auto t = stepping::totals(s, scene.materials);
        CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 1e-10 * std::abs(s.ledger.kineticEnergy + 1));
    }
}

TEST_CASE("a value that is not finite ends the run with particle, place and time")
{
    auto s = block();
    stepping::Scene scene;
    scene.materials = {scenes::elastic(1e6, 0.3)};
    scene.bodyForce = force("value (0 \"1/(t - 0.003)\");");
    auto stepper = cases::makeStepper("uGIMP", s, scene);
    const auto message = faultOf([&] {
        for (int i = 0; i < 10; ++i)
            stepper->step(0.0015);
    });
    CHECK_THAT(message, Contains("the body force on particle 0 at (1.125, 1.12") &&
                            Contains("), 0.003 s is inf: constant/bodyForce:1: value: \"1/(t - 0.003)\""));
    scene.bodyForce = force("value (\"sqrt(2.9 - x)\" 0);");
    auto t = block();
    CHECK_THAT(faultOf([&] { cases::makeStepper("linear", t, scene)->step(1e-3); }),
               Contains("the body force on particle 8 at (3.125, 1.125), 0 s is") && Contains("nan"));
}

TEST_CASE("reference positions: given to a state of step 0, demanded of a later one")
{
    const auto control = Dictionary::fromText("fields (referencePosition);", "system/controlDict");
    const auto wanted = cases::readFields(control);
    REQUIRE(wanted);
    control.rejectUnread();
    auto s = block();
    cases::provideReference(s, *wanted);
    REQUIRE(s.particles.hasX());
    CHECK(s.particles.X[1] == s.particles.x[1]);
    s.particles.x[1][0] += 1;
    s.step = 5;
    cases::provideReference(s, *wanted); // it has them: nothing happens
    CHECK(s.particles.X[1][0] != s.particles.x[1][0]);
    auto late = block();
    late.step = 5;
    late.time = 0.25;
    CHECK_THROWS_WITH(
        cases::provideReference(late, *wanted),
        "system/controlDict:1: fields: referencePosition: found a state at time 0.25 s without "
        "/particles/referencePosition, where its particles started; allowed: a run from time 0 (startFrom "
        "firstTime, -overwrite)");
    CHECK_FALSE(late.particles.hasX());
    CHECK_FALSE(cases::readFields(Dictionary::fromText("endTime 1;")));
    CHECK_THROWS_WITH(cases::readFields(Dictionary::fromText("fields (referencPosition);", "system/controlDict")),
                      "system/controlDict:1: fields: found 'referencPosition' (did you mean 'referencePosition'?), "
                      "allowed referencePosition");
}

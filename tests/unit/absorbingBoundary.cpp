// Dashpots that let waves out: pulses leave, an incoming wave comes in as it should, and rates of zero do nothing.
// Gravity that comes on by a ramp.
#include "case/makeStepper.hpp"
#include "case/readBoundaries.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using Catch::Contains;

namespace
{
const double E = 1e6, rho = 1000, h = 0.1;

/// A strip along x, 10 m of 100 cells, periodic along y: waves run in one dimension.
state::State strip()
{
    auto s = scenes::seedBlock(
        {.corner = {1, 0, 0}, .n = {200, 4, 1}, .spacing = h / 2, .h = h, .density = rho, .cells = {140, 2, 1}});
    s.grid.periodic[1] = true;
    return s;
}

stepping::Scene scene()
{
    stepping::Scene sc;
    sc.materials = {scenes::elastic(E, 0, rho)};
    return sc;
}

double energy(const state::State& s, const stepping::Scene& sc)
{
    double kinetic = 0;
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
        for (std::size_t a = 0; a < 2; ++a)
            kinetic += 0.5 * s.particles.mass[i] * s.particles.v[a][i] * s.particles.v[a][i];
    return kinetic + stepping::totals(s, sc.materials).strainEnergy;
}

double residualOf(const state::State& s, const stepping::Scene& sc)
{
    return std::abs(stepping::residual(s.ledger, stepping::totals(s, sc.materials).strainEnergy));
}

void run(state::State& s, const stepping::Scene& sc, Index steps, double dt)
{
    auto stepper = cases::makeStepper("uGIMP", s, sc);
    stepping::beginLedger(s, sc.materials);
    for (Index i = 0; i < steps; ++i)
        stepper->step(dt);
}

/// The speed of waves that move particles along x (0) or y (1).
double waveSpeed(int axis)
{
    return std::sqrt((axis == 0 ? E : E / 2) / rho);
}

/// A pulse that runs to +x: v = f(x - c t), sigma = - rho c v.
void addPulse(state::State& s, int axis)
{
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
    {
        const double x = s.particles.x[0][i] - 6, v = 1e-3 * std::exp(-x * x / (2 * 0.6 * 0.6));
        s.particles.v[std::size_t(axis)][i] = v;
        s.particles.stress[axis == 0 ? 0 : 3][i] = -rho * waveSpeed(axis) * v;
    }
}
} // namespace

TEST_CASE("pressure and shear waves leave: less than 1 % of the energy comes back")
{
    const int axis = GENERATE(0, 1);
    auto s = strip();
    addPulse(s, axis);
    auto sc = scene();
    sc.absorbing = {{"side", 0, 1, 110, 2 * waveSpeed(0) / h, 2 * waveSpeed(1) / h}};
    const double start = energy(s, sc), c = waveSpeed(axis), dt = 0.4 * h / waveSpeed(0);
    run(s, sc, Index(8 / c / dt), dt); // the pulse is at 6 m, the side at 11 m
    CHECK(energy(s, sc) < 0.01 * start);
    // in the nodes' velocities, of which FLIP finds a share 0.2 c dt/h again in those of the particles (transferLoss)
    CHECK(s.ledger.absorbedEnergy + s.ledger.transferLoss == Approx(start).epsilon(0.01));
    CHECK(s.ledger.absorbedEnergy == Approx(start).epsilon(0.1));
    CHECK(residualOf(s, sc) < 1e-12 * start);
    const auto t = stepping::totals(s, sc.materials);
    CHECK(std::abs(t.momentum[std::size_t(axis)] - s.ledger.initialMomentum[std::size_t(axis)] -
                   s.ledger.wallImpulse[std::size_t(axis)]) < 1e-12 * t.mass);

    auto free = strip(), stiff = strip();
    addPulse(free, axis);
    addPulse(stiff, axis);
    const auto closed = scene();
    run(free, closed, Index(8 / c / dt), dt);
    CHECK(energy(free, closed) > 0.98 * start); // it would all be there
    auto strong = sc;                           // ((1 - 10)/(1 + 10))^2; a step of four times the dashpot's time
    strong.absorbing[0].normalRate *= 10;
    strong.absorbing[0].shearRate *= 10;
    run(stiff, strong, Index(8 / c / dt), dt);
    CHECK(energy(stiff, strong) / start == Approx(81.0 / 121).epsilon(0.03));
}

TEST_CASE("half the impedance reflects a third of the amplitude")
{
    auto s = strip();
    addPulse(s, 0);
    auto sc = scene();
    sc.absorbing = {{"side", 0, 1, 110, 0.5 * 2 * waveSpeed(0) / h, 0}};
    const double start = energy(s, sc), c = waveSpeed(0), dt = 0.4 * h / c;
    run(s, sc, Index(8 / c / dt), dt);
    CHECK(energy(s, sc) / start == Approx(1.0 / 9).epsilon(0.03)); // ((1 - 0.5)/(1 + 0.5))^2
}

TEST_CASE("a wave that comes in through the base: v behind its front, twice that after a free end")
{
    auto s = strip();
    auto sc = scene();
    const double v = 1e-3, c = waveSpeed(0), dt = 0.4 * h / c;
    const auto in = std::make_shared<const dictionary::Motion>(
        dictionary::Motion::read(dictionary::Dictionary::fromText("velocity (0.001 0 0);"), 2));
    sc.absorbing = {{"base", 0, -1, 10, 2 * c / h, 2 * waveSpeed(1) / h, in}};
    run(s, sc, Index(6 / c / dt), dt);
    const auto mean = [&](double from, double to, bool stress) {
        double sum = 0;
        int n = 0;
        for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
            if (const double x = s.particles.x[0][i] - 1; x > from && x < to)
            {
                sum += stress ? s.particles.stress[0][i] : s.particles.v[0][i];
                ++n;
            }
        return sum / n;
    };
    CHECK(mean(1, 4, false) == Approx(v).epsilon(0.01));
    CHECK(mean(1, 4, true) == Approx(-rho * c * v).epsilon(0.01));
    CHECK(std::abs(mean(8, 10, false)) < 1e-3 * v);
    CHECK(s.ledger.motionWork ==
          Approx(2 * v * rho * c * v * 0.2 * s.time).epsilon(0.02)); // traction rho c (2 v - v) on 2 v
    run(s, sc, Index(18 / c / dt), dt);                              // reflected, and gone through the base
    CHECK(mean(0, 10, false) == Approx(2 * v).epsilon(0.01));
    CHECK(std::abs(mean(0, 10, true)) < 0.01 * rho * c * v);
    CHECK(residualOf(s, sc) < 1e-12 * s.ledger.motionSupply);
}

TEST_CASE("rates of zero are bitwise no boundary, damping beside it is booked right")
{
    auto a = strip(), b = strip(), d = strip();
    for (auto* s : {&a, &b, &d})
        addPulse(*s, 0);
    auto none = scene(), zero = scene(), damped = scene();
    zero.absorbing = {{"side", 0, 1, 110, 0, 0}};
    run(a, none, 50, 1e-3);
    run(b, zero, 50, 1e-3);
    CHECK(a.particles.v[0] == b.particles.v[0]);
    CHECK(a.particles.x[0] == b.particles.x[0]);
    CHECK(b.ledger.absorbedEnergy == 0);
    damped.absorbing = {{"side", 0, 1, 110, 2 * waveSpeed(0) / h, 0}};
    damped.relaxationTime = 0.1;
    const double start = energy(d, damped);
    run(d, damped, 300, 1e-3);
    CHECK(d.ledger.absorbedEnergy > 0);
    CHECK(d.ledger.dampingDissipation > 0);
    CHECK(residualOf(d, damped) < 1e-12 * start);
}

TEST_CASE("absorbing boundaries are read with the impedance of their material")
{
    const auto state = strip();
    const auto read = [&](const std::string& text) {
        auto sc = scene();
        cases::readBoundaries(dictionary::Dictionary::fromText(text, "boundaryConditions"), state, sc);
        return sc;
    };
    const std::string plane = "plane { normal (1 0 0); position 11; } ";
    const auto sc = read("side { type absorbing; material solid; shear 0.5; " + plane + "}");
    REQUIRE(sc.absorbing.size() == 1);
    CHECK(sc.absorbing[0].plane == 110);
    CHECK(sc.absorbing[0].normalRate == Approx(2 * waveSpeed(0) / h));
    CHECK(sc.absorbing[0].shearRate == Approx(waveSpeed(1) / h));
    CHECK(read("side { type absorbing; material solid; normal 0; shear 0; " + plane + "}").absorbing.empty());
    CHECK_THROWS_WITH(read("side { type absorbing; material rock; " + plane + "}"),
                      Contains("rock") && Contains("solid"));
    CHECK_THROWS_WITH(read("side { type absorbing; material solid; normal -1; " + plane + "}"), Contains("normal"));
    CHECK_THROWS_WITH(read("side { type absorbing; material solid; plane { normal (1 0 0); position 11.03; } }"),
                      Contains("between planes"));
    CHECK_THROWS_WITH(
        read("a { type absorbing; material solid; " + plane + "} b { type absorbing; material solid; " + plane + "}"),
        Contains("second"));
}

TEST_CASE("gravity comes on by a ramp: velocity is its integral, and a ramp of no time is no ramp")
{
    for (const bool smooth : {false, true})
    {
        auto s =
            scenes::seedBlock({.corner = {1, 8, 0}, .n = {4, 4, 1}, .spacing = 0.25, .h = 0.5, .cells = {8, 24, 1}});
        auto sc = scene();
        sc.gravity = Vector3{0, -2, 0};
        sc.gravityRamp = nodal::GravityRamp{0.4, smooth};
        run(s, sc, 30, 0.01); // at 0.3 of 0.4 s
        const double f = 0.75, share = smooth ? 0.4 * f * f * f * (1 - f / 2) : 0.4 * f * f / 2;
        CHECK(s.particles.v[1][0] == Approx(-2 * share).epsilon(1e-12));
        run(s, sc, 70, 0.01); // 1 s in all
        CHECK(s.particles.v[1][0] == Approx(-2 * (0.2 + 0.6)).epsilon(1e-12));
        CHECK(s.ledger.gravityWork == Approx(s.ledger.kineticEnergy).epsilon(1e-12));
        CHECK(residualOf(s, sc) < 1e-12 * s.ledger.gravityWork);
    }
    auto a = strip(), b = strip();
    auto plain = scene(), none = scene();
    plain.gravity = none.gravity = Vector3{-1, 0, 0};
    none.gravityRamp = nodal::GravityRamp{0, true};
    run(a, plain, 20, 1e-3);
    run(b, none, 20, 1e-3);
    CHECK(a.particles.v[0] == b.particles.v[0]);
    CHECK(a.ledger.gravityWork == b.ledger.gravityWork);
}

// Walls in motion: the same scene seen from another frame, impact stress of a bar, what the energy budget says, and
// motions that move nothing.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <omp.h>

using namespace mpm;
using nodal::Wall;
using nodal::WallType;

namespace
{
std::shared_ptr<const dictionary::Motion> motion(const std::string& text, int dim = 2)
{
    return std::make_shared<const dictionary::Motion>(
        dictionary::Motion::read(dictionary::Dictionary::fromText(text), dim));
}

Wall moving(const std::string& name, WallType type, int axis, int side, double position, double mu, bool separation,
            const std::string& text)
{
    return {name, type, axis, side, 0, mu, separation, position, motion(text)};
}

void run(state::State& s, const stepping::Scene& sc, Index steps, double dt, const std::string& shape = "uGIMP")
{
    auto stepper = cases::makeStepper(shape, s, sc);
    stepping::beginLedger(s, sc.materials);
    for (Index i = 0; i < steps; ++i)
        stepper->step(dt);
}

double residualShare(const state::State& s, const stepping::Scene& sc)
{
    return std::abs(stepping::residual(s.ledger, stepping::totals(s, sc.materials).strainEnergy)) /
           (s.ledger.motionSupply + s.ledger.initialKineticEnergy + std::abs(s.ledger.gravityWork));
}

/// 1 m x 0.5 m in a grid of cells of 0.25 m; `u` is added to its swinging motion.
state::State block(double u, double dx)
{
    auto s = scenes::seedBlock(
        {.corner = {1 + dx, 0, 0}, .n = {8, 4, 1}, .spacing = 0.125, .h = 0.25, .cells = {400, 12, 1}});
    for (std::size_t i = 0; i < 32; ++i)
    {
        s.particles.v[0][i] = u + 0.5 * std::sin(3 * (s.particles.x[0][i] - dx)) * s.particles.x[1][i];
        s.particles.v[1][i] = -0.5 * std::cos(2 * (s.particles.x[0][i] - dx));
    }
    return s;
}
} // namespace

TEST_CASE("walls that all move at V see what walls at rest see, to round-off")
{
    // The grid is no part of the physics but of the method: a frame that moves a cell a step finds the same nodes.
    const double h = 0.25, dt = 1e-3, V = h / dt;
    const auto update =
        GENERATE(stepping::StressUpdate::MUSL, stepping::StressUpdate::USL, stepping::StressUpdate::USF);
    const auto base = GENERATE(WallType::fixed, WallType::friction);
    stepping::Scene rest;
    rest.materials = {scenes::elastic(1e6, 0.3)};
    rest.gravity = Vector3{0, -9.8, 0};
    rest.stressUpdate = update;
    auto go = rest;
    const std::string v = "velocity (250 0 0);";
    rest.walls = {{"base", base, 1, -1, 0, 0.4, base == WallType::friction},
                  {"left", WallType::roller, 0, -1, 4, 0, true},
                  {"right", WallType::friction, 0, 1, 8, 0.2, true}};
    go.walls = {moving("base", base, 1, -1, 0, 0.4, base == WallType::friction, v),
                moving("left", WallType::roller, 0, -1, 1, 0, true, v),
                moving("right", WallType::friction, 0, 1, 2, 0.2, true, v)};
    auto a = block(0, 0), b = block(V, 0);
    const Index steps = 200;
    run(a, rest, steps, dt);
    run(b, go, steps, dt);
    double worst = 0, spread = 0;
    std::vector<std::size_t> place(32);
    for (std::size_t i = 0; i < 32; ++i)
        place[std::size_t(b.particles.id[i])] = i;
    for (std::size_t i = 0; i < 32; ++i)
    {
        const std::size_t j = place[std::size_t(a.particles.id[i])];
        worst = std::max(worst, std::abs(a.particles.x[0][i] + V * dt * double(steps) - b.particles.x[0][j]));
        worst = std::max(worst, std::abs(a.particles.x[1][i] - b.particles.x[1][j]));
        worst = std::max(worst, std::abs(a.particles.stress[1][i] - b.particles.stress[1][j]) / 1e6);
        spread = std::max(spread, std::abs(a.particles.v[0][i]));
    }
    CHECK(spread > 0.01); // it is still in motion
    CHECK(worst < 1e-10); // coordinates of 50 m, velocities of 250 m/s
    // a Galilean change of the books: work of the walls is V times their impulse
    CHECK(b.ledger.motionWork == Approx(V * b.ledger.wallImpulse[0]).epsilon(1e-9));
    CHECK(b.ledger.wallImpulse[0] == Approx(a.ledger.wallImpulse[0]).margin(1e-9));
    CHECK(b.ledger.frictionDissipation == Approx(a.ledger.frictionDissipation).margin(1e-7));
    CHECK(b.ledger.wallLoss == Approx(a.ledger.wallLoss).margin(1e-7));
    if (base == WallType::friction)
        CHECK(a.ledger.frictionDissipation > 0.1);
    CHECK(residualShare(b, go) < 1e-12);
}

TEST_CASE("a body that moves with its walls from node to node feels nothing")
{
    stepping::Scene sc;
    sc.materials = {scenes::elastic(1e6, 0.3)};
    sc.walls = {moving("left", WallType::roller, 0, -1, 1.07, 0, false, "velocity (3 0 0);"),
                moving("right", WallType::fixed, 0, 1, 2.07, 0, false, "velocity (3 0 0);")};
    auto s = scenes::seedBlock({.corner = {1.07, 0, 0},
                                .n = {8, 4, 1},
                                .spacing = 0.125,
                                .h = 0.25,
                                .cells = {60, 12, 1},
                                .velocity = {3, 0, 0}});
    run(s, sc, 500, 1e-3);
    for (std::size_t i = 0; i < 32; ++i)
    {
        CHECK(std::abs(s.particles.stress[0][i]) < 1e-6);
        CHECK(s.particles.v[0][i] == Approx(3).epsilon(1e-12));
    }
    CHECK(std::abs(s.ledger.motionWork) < 1e-9 * s.ledger.initialKineticEnergy);
}

TEST_CASE("a wall that starts into a free bar makes the stress rho c v behind the wave")
{
    // 1D: c = sqrt(E/rho) with nu = 0; sigma = - rho c v behind the front, at rest before it
    const double E = 1e6, rho = 1000, v = 0.05, c = std::sqrt(E / rho), h = 0.1;
    for (const char* text :
         {"velocity (0.05 0 0);", "displacement (\"0.05*t\" 0 0);", "velocity table ((0 (0.05 0 0)) (9 (0.05 0 0)));"})
    {
        auto s = scenes::seedBlock(
            {.corner = {1, 0, 0}, .n = {200, 2, 1}, .spacing = 0.05, .h = h, .density = rho, .cells = {140, 1, 1}});
        stepping::Scene sc;
        sc.materials = {scenes::elastic(E, 0, rho)};
        sc.walls = {moving("piston", WallType::roller, 0, -1, 1, 0, true, text)};
        const double dt = 0.5 * h / c;
        const Index steps = Index(6 / c / dt); // the front at 6 m of 10
        run(s, sc, steps, dt);
        double stress = 0, speed = 0, ahead = 0;
        int count = 0;
        for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
            if (const double x = s.particles.x[0][i] - 1; x > 1 && x < 4)
            {
                stress += s.particles.stress[0][i];
                speed += s.particles.v[0][i];
                ++count;
            }
            else if (x > 9)
                ahead = std::max(ahead, std::abs(s.particles.stress[0][i]));
        CHECK(stress / count == Approx(-rho * c * v).epsilon(0.01));
        CHECK(speed / count == Approx(v).epsilon(0.01));
        CHECK(ahead < 1e-3 * rho * c * v);
        // what the wall has done: force rho c v over the time, at speed v, 0.1 m wide; the first half step is an impact
        const double force = rho * c * v * 0.1;
        CHECK(s.ledger.wallImpulse[0] == Approx(force * s.time).epsilon(0.02));
        CHECK(s.ledger.motionWork == Approx(force * v * s.time).epsilon(0.02));
        CHECK(residualShare(s, sc) < 1e-11);
    }
}

TEST_CASE("a wall that crosses nodes compresses what cannot get away")
{
    // Two rollers close in on a bar from 1 m to 0.8 m: strain 0.2 (rate law, sigma = M log), whichever nodes they cross
    auto s =
        scenes::seedBlock({.corner = {1, 0, 0}, .n = {40, 2, 1}, .spacing = 0.025, .h = 0.05, .cells = {40, 1, 1}});
    stepping::Scene sc;
    sc.materials = {scenes::elastic(1e6, 0)};
    sc.relaxationTime = 0.02;
    const std::string in = "velocity ((0 (0.2 0)) (0.5 (0.2 0)) (0.5001 (0 0)));";
    const std::string back = "velocity ((0 (-0.2 0)) (0.5 (-0.2 0)) (0.5001 (0 0)));";
    sc.walls = {moving("left", WallType::roller, 0, -1, 1, 0, true, in),
                moving("right", WallType::roller, 0, 1, 2, 0, true, back),
                {"below", WallType::roller, 1, -1, 0, 0, false},
                {"above", WallType::roller, 1, 1, 1, 0, false}};
    run(s, sc, 1600, 5e-4);
    double mean = 0, low = 9, high = 0;
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
    {
        mean += s.particles.stress[0][i] / double(s.particles.size());
        low = std::min(low, s.particles.x[0][i]);
        high = std::max(high, s.particles.x[0][i]);
    }
    CHECK(high - low == Approx(0.8 * 0.975).epsilon(0.03));
    CHECK(mean == Approx(1e6 * std::log(0.8)).epsilon(0.06)); // a cell at each end is softer while nodes are crossed
    CHECK(residualShare(s, sc) < 1e-11);
    CHECK(s.ledger.motionWork > 0);
}

TEST_CASE("a plane that is dragged rubs with mu N, and its work is friction and motion of the block")
{
    // block on a base that moves at 1 m/s: it is dragged with a = mu g until it goes along
    const double mu = 0.3, g = 9.8;
    auto s =
        scenes::seedBlock({.corner = {1, 0, 0}, .n = {8, 4, 1}, .spacing = 0.125, .h = 0.25, .cells = {60, 12, 1}});
    for (std::size_t i = 0; i < 32; ++i)
        s.particles.stress[1][i] = -1000 * g * (0.5 - s.particles.x[1][i]);
    stepping::Scene sc;
    sc.materials = {scenes::elastic(1e6, 0)};
    sc.gravity = Vector3{0, -g, 0};
    sc.walls = {moving("base", WallType::friction, 1, -1, 0, mu, true, "velocity (1 0 0);")};
    run(s, sc, 200, 1e-3);
    const auto t = stepping::totals(s, sc.materials);
    const double N = 500 * g;
    CHECK(t.momentum[0] == Approx(mu * N * 0.2).epsilon(0.02)); // friction drags along the wall's motion
    CHECK(s.ledger.motionWork == Approx(mu * N * 1 * 0.2).epsilon(0.02));
    // slip at the contact nodes; the block leans, so within a tenth
    CHECK(s.ledger.frictionDissipation == Approx(mu * N * (0.2 - 0.5 * mu * g * 0.04)).epsilon(0.1));
    CHECK(residualShare(s, sc) < 1e-11);
}

TEST_CASE("a piston on a rough floor: corners go with the piston, whatever the order of the walls")
{
    stepping::Scene sc;
    sc.materials = {scenes::elastic(1e6, 0.3)};
    sc.gravity = Vector3{0, -9.8, 0};
    const Wall floor{"floor", WallType::friction, 1, -1, 0, 0.5, true};
    const Wall piston = moving("piston", WallType::fixed, 0, -1, 1, 0, false, "velocity (0.3 0 0);");
    state::State ends[2] = {block(0, 0), block(0, 0)};
    for (int k = 0; k < 2; ++k)
    {
        sc.walls = k == 0 ? std::vector{floor, piston} : std::vector{piston, floor};
        run(ends[k], sc, 400, 1e-3);
        CHECK(residualShare(ends[k], sc) < 1e-11);
        const auto t = stepping::totals(ends[k], sc.materials);
        CHECK(std::abs(t.momentum[0] - ends[k].ledger.initialMomentum[0] - ends[k].ledger.wallImpulse[0]) <
              1e-11 * t.mass);
    }
    for (std::size_t i = 0; i < 32; ++i)
        CHECK(ends[0].particles.x[0][i] == Approx(ends[1].particles.x[0][i]).epsilon(1e-12));
}

TEST_CASE("a motion that moves nothing is bitwise no motion")
{
    const auto type = GENERATE(WallType::fixed, WallType::roller, WallType::friction);
    for (const std::string shape : {"uGIMP", "cpGIMP", "linear"})
    {
        stepping::Scene rest;
        rest.materials = {scenes::elastic(1e6, 0.3)};
        rest.gravity = Vector3{0, -9.8, 0};
        auto zero = rest;
        rest.walls = {{"base", type, 1, -1, 0, 0.4, true}, {"left", WallType::roller, 0, -1, 4, 0, true}};
        zero.walls = {moving("base", type, 1, -1, 0, 0.4, true, "velocity (\"0*t\" 0 0);"),
                      moving("left", WallType::roller, 0, -1, 1, 0, true, "displacement (0 \"0*sin(t)\" 0);")};
        auto a = block(0, 0), b = block(0, 0);
        try
        {
            run(a, rest, 100, 5e-4, shape);
        }
        catch (const InputError&) // a build with fewer shapes
        {
            continue;
        }
        run(b, zero, 100, 5e-4, shape);
        for (int k = 0; k < 2; ++k)
        {
            CHECK(a.particles.x[k] == b.particles.x[k]);
            CHECK(a.particles.v[k] == b.particles.v[k]);
            CHECK(a.particles.stress[k] == b.particles.stress[k]);
        }
        CHECK(a.ledger.wallLoss == b.ledger.wallLoss);
        CHECK(b.ledger.motionWork == 0);
    }
}

TEST_CASE("restart and threads: bitwise")
{
    stepping::Scene sc;
    sc.materials = {scenes::elastic(1e6, 0.3)};
    sc.gravity = Vector3{0, -9.8, 0};
    sc.walls = {moving("base", WallType::friction, 1, -1, 0, 0.4, true, "velocity (\"0.5*sin(30*t)\" 0 0);"),
                moving("left", WallType::roller, 0, -1, 1, 0, true, "acceleration (\"cos(9*t)\" 0 0);")};
    auto whole = block(0, 0), cut = block(0, 0), threads = block(0, 0);
    run(whole, sc, 120, 1e-3);
    run(cut, sc, 57, 1e-3);
    {
        auto again = sc; // read anew
        again.walls[0].motion = motion("velocity (\"0.5*sin(30*t)\" 0 0);");
        again.walls[1].motion = motion("acceleration (\"cos(9*t)\" 0 0);");
        run(cut, again, 63, 1e-3);
    }
    const int before = omp_get_max_threads();
    omp_set_num_threads(before == 1 ? 3 : 1);
    run(threads, sc, 120, 1e-3);
    omp_set_num_threads(before);
    for (const auto* other : {&cut, &threads})
        for (int k = 0; k < 2; ++k)
        {
            CHECK(whole.particles.x[k] == other->particles.x[k]);
            CHECK(whole.particles.v[k] == other->particles.v[k]);
        }
    CHECK(whole.ledger.motionWork == cut.ledger.motionWork);
    CHECK(whole.ledger.motionWork == threads.ledger.motionWork);
}

TEST_CASE("a wall too fast for its step is refused")
{
    stepping::Scene sc;
    sc.materials = {scenes::elastic(1e6, 0.3)};
    sc.walls = {moving("hammer", WallType::roller, 0, -1, 1, 0, true, "velocity (\"t < 0.01 ? 0 : 1e4\" 0 0);")};
    auto s = block(0, 0);
    CHECK_THROWS_WITH(run(s, sc, 20, 1e-3), Catch::Contains("hammer") && Catch::Contains("smaller deltaT"));
}

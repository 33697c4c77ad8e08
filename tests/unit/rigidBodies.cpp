// Rigid bodies against walls and balances: a straight face is a wall, impulse is momentum, the torque about another
// point, the sign of friction, and bodies that touch nothing.
#include "case/makeStepper.hpp"
#include "case/readRigidBodies.hpp"
#include "nodal/rigidBody.hpp"
#include "nodal/vectors.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <omp.h>

using namespace mpm;
using Catch::Contains;
using nodal::WallType;

namespace
{
dictionary::Motion motion(const std::string& text)
{
    return dictionary::Motion::read(dictionary::Dictionary::fromText(text), 2);
}

nodal::Body polygon(const std::string& name, const std::vector<Vector3>& corners, double mu,
                    const nodal::RigidMotion& moves, bool separation = true)
{
    const auto surface =
        std::make_shared<const nodal::RigidSurface>(nodal::RigidSurface::polygon(corners, {"test", 1}));
    return {name, std::make_shared<nodal::RigidBody>(surface, moves.centre), mu, separation,
            std::make_shared<const nodal::RigidMotion>(moves)};
}

std::vector<Vector3> disc(const Vector3& centre, double radius)
{
    std::vector<Vector3> out;
    for (int k = 0; k < 64; ++k)
        out.push_back(
            {centre[0] + radius * std::cos(2 * M_PI * k / 64), centre[1] + radius * std::sin(2 * M_PI * k / 64), 0});
    return out;
}

/// 1 m x 0.5 m, 16 x 8 particles, corner at (1, 0.5); cells of 0.125 m.
state::State block(double u = 0, double v = 0)
{
    return scenes::seedBlock({.corner = {1, 0.5, 0},
                              .n = {16, 8, 1},
                              .spacing = 0.0625,
                              .h = 0.125,
                              .cells = {40, 24, 1},
                              .velocity = {u, v, 0}});
}

stepping::Scene scene()
{
    stepping::Scene out;
    out.materials = {scenes::elastic(1e6, 0.3)};
    return out;
}

/// Runs, and sums what the first actor met: impulse on the soil, moment.
struct Met
{
    Vector3 impulse{}, moment{};
};
Met run(state::State& s, const stepping::Scene& sc, Index steps, double dt)
{
    auto stepper = cases::makeStepper("uGIMP", s, sc);
    stepping::beginLedger(s, sc.materials);
    Met met;
    for (Index i = 0; i < steps; ++i)
    {
        stepper->step(dt);
        if (!stepper->report().actors.empty())
        {
            met.impulse = nodal::plus(met.impulse, nodal::times(-dt, stepper->report().actors[0].force));
            met.moment = nodal::plus(met.moment, nodal::times(-dt, stepper->report().actors[0].torque));
        }
    }
    return met;
}

double residualShare(const state::State& s, const stepping::Scene& sc)
{
    return std::abs(stepping::residual(s.ledger, stepping::totals(s, sc.materials).strainEnergy)) /
           (s.ledger.motionSupply + s.ledger.initialKineticEnergy + std::abs(s.ledger.gravityWork));
}

double largestDifference(const state::State& a, const state::State& b)
{
    double most = 0;
    for (std::size_t i = 0; i < std::size_t(a.particles.size()); ++i)
        for (std::size_t k = 0; k < 2; ++k)
            most = std::max(most, std::abs(a.particles.x[k][i] - b.particles.x[k][i]));
    return most;
}
} // namespace

TEST_CASE("a straight face is a wall: the same motion, to round-off")
{
    const auto update =
        GENERATE(stepping::StressUpdate::MUSL, stepping::StressUpdate::USL, stepping::StressUpdate::USF);
    for (const double mu : {0.0, 0.4})
    {
        auto wall = scene();
        wall.stressUpdate = update;
        wall.gravity = Vector3{0, -1, 0};
        auto body = wall;
        const auto moves = std::make_shared<const dictionary::Motion>(motion("velocity (\"0.3 + sin(40*t)\" 0.2 0);"));
        wall.walls = {{"left", mu > 0 ? WallType::friction : WallType::roller, 0, -1, 0, mu, true, 1, moves}};
        nodal::RigidMotion rigid;
        rigid.translation = *moves;
        body.bodies = {polygon("left", {{-30, -40, 0}, {1, -40, 0}, {1, 40, 0}, {-30, 40, 0}}, mu, rigid)};
        auto a = block(-0.2), b = block(-0.2);
        const auto byWall = run(a, wall, 150, 1e-3), byBody = run(b, body, 150, 1e-3);
        CHECK(largestDifference(a, b) < 1e-13);
        CHECK(byWall.impulse[0] > 1);
        CHECK(byBody.impulse[0] == Approx(byWall.impulse[0]).epsilon(1e-11));
        CHECK(byBody.impulse[1] == Approx(byWall.impulse[1]).margin(1e-9));
        CHECK(b.ledger.motionWork == Approx(a.ledger.motionWork).epsilon(1e-11));
        CHECK(b.ledger.frictionDissipation == Approx(a.ledger.frictionDissipation).margin(1e-11));
        CHECK((mu > 0) == (b.ledger.frictionDissipation > 0));
        CHECK(b.ledger.bodyContacts > 0);
        CHECK(residualShare(b, body) < 1e-11);
    }
}

TEST_CASE("a disc that hits a block: impulse is momentum, the budget closes, the torque moves with its point")
{
    nodal::RigidMotion moves;
    moves.translation = motion("velocity (0.5 0.1 0);");
    const Vector3 centre{0.6, 0.6, 0};
    Met met[2];
    for (int k = 0; k < 2; ++k)
    {
        moves.centre = k == 0 ? centre : Vector3{0.1, 1.4, 0};
        auto sc = scene();
        sc.bodies = {polygon("disc", disc(centre, 0.3), 0.3, moves)};
        auto s = block();
        met[k] = run(s, sc, 400, 1e-3);
        const auto t = stepping::totals(s, sc.materials);
        CHECK(t.momentum[0] > 50); // kg m/s of 500 kg: it has been pushed
        for (std::size_t a = 0; a < 2; ++a)
        {
            CHECK(t.momentum[a] == Approx(met[k].impulse[a]).epsilon(1e-11));
            CHECK(s.ledger.wallImpulse[a] == Approx(met[k].impulse[a]).epsilon(1e-11));
        }
        CHECK(residualShare(s, sc) < 1e-11);
        CHECK(s.ledger.motionWork > 0);
        // pushed off, it flies on at no less than the disc's speed
        CHECK(t.momentum[0] / t.mass > 0.4);
    }
    const auto arm = nodal::minus(centre, Vector3{0.1, 1.4, 0}); // both points move with the disc
    CHECK(met[1].moment[2] == Approx(met[0].moment[2] + nodal::cross(arm, met[0].impulse)[2]).epsilon(1e-10));
    // frictional torque aside, the push of a disc goes through its centre
    CHECK(std::abs(met[0].moment[2]) <= 0.3 * 0.375 * nodal::length(met[0].impulse));
}

TEST_CASE("a disc that turns on a block drags it along, and is braked")
{
    for (const double turn : {4.0, -4.0})
    {
        nodal::RigidMotion moves;
        moves.centre = {1.5, 1.36, 0};
        moves.angle =
            dictionary::readAngle(dictionary::Dictionary::fromText("angularVelocity " + std::to_string(turn) + ";"));
        moves.translation = motion("velocity (0 -0.05 0);");
        auto sc = scene();
        sc.gravity = Vector3{0, -1, 0};
        sc.walls = {{"base", WallType::roller, 1, -1, 4, 0, false}};
        sc.bodies = {polygon("disc", disc(moves.centre, 0.3), 0.5, moves)};
        auto s = block();
        const auto met = run(s, sc, 300, 1e-3);
        const auto t = stepping::totals(s, sc.materials);
        CHECK(met.impulse[1] < -1);      // pressed down
        CHECK(t.momentum[0] * turn > 0); // counter-clockwise: its lowest point goes to +x
        CHECK(met.moment[2] * turn > 0); // on the soil; on the disc against its turning
        CHECK(t.momentum[0] == Approx(met.impulse[0]).epsilon(1e-10));
        CHECK(std::abs(met.impulse[0]) <= 0.5 * std::abs(met.impulse[1]) * 1.05); // Coulomb
        CHECK(s.ledger.frictionDissipation > 0);
        CHECK(residualShare(s, sc) < 1e-11);
    }
}

TEST_CASE("a body that touches nothing is bitwise no body; restart and threads are bitwise too")
{
    nodal::RigidMotion away, moves;
    away.translation = motion("velocity (-0.1 0 0);");
    away.centre = {0.4, 0.4, 0};
    moves.translation = motion("velocity (\"0.5 + 0.3*sin(20*t)\" 0 0);");
    moves.angle = dictionary::readAngle(dictionary::Dictionary::fromText("angularVelocity \"2*cos(9*t)\";"));
    moves.centre = {0.6, 0.6, 0};
    auto none = scene(), far = scene(), near = scene();
    far.bodies = {polygon("far", disc(away.centre, 0.2), 0.3, away)};
    near.bodies = {polygon("near", disc(moves.centre, 0.3), 0.3, moves),
                   polygon("far", disc(away.centre, 0.2), 0.3, away)};
    auto a = block(0.1), b = block(0.1), whole = block(), cut = block(), threads = block();
    run(a, none, 100, 1e-3);
    run(b, far, 100, 1e-3);
    CHECK(largestDifference(a, b) == 0);
    CHECK(b.ledger.bodyContacts == 0);

    run(whole, near, 200, 1e-3);
    run(cut, near, 83, 1e-3);
    run(cut, near, 117, 1e-3);
    const int before = omp_get_max_threads();
    omp_set_num_threads(before == 1 ? 3 : 1);
    run(threads, near, 200, 1e-3);
    omp_set_num_threads(before);
    CHECK(whole.ledger.bodyContacts > 0);
    CHECK(largestDifference(whole, cut) == 0);
    CHECK(largestDifference(whole, threads) == 0);
    CHECK(whole.ledger.motionWork == cut.ledger.motionWork);
    CHECK(whole.ledger.motionWork == threads.ledger.motionWork);
}

TEST_CASE("a block of triangles pushes in 3D")
{
    auto s = scenes::seedBlock(
        {.dim = 3, .corner = {1, 1, 1}, .n = {4, 4, 4}, .spacing = 0.125, .h = 0.25, .cells = {12, 12, 12}});
    std::vector<Vector3> p;
    for (int n = 0; n < 8; ++n)
        p.push_back({n & 1 ? 0.8 : 0.2, n & 2 ? 1.7 : 0.8, n & 4 ? 1.7 : 0.8});
    const auto surface =
        std::make_shared<const nodal::RigidSurface>(3, p, nodal::RigidSurface::boxTriangles(), Location{"test", 1});
    auto moves = std::make_shared<nodal::RigidMotion>();
    moves->centre = surface->centroid();
    moves->translation = dictionary::Motion::read(dictionary::Dictionary::fromText("velocity (0.5 0 0);"), 3);
    stepping::Scene sc = scene();
    sc.bodies = {{"box", std::make_shared<nodal::RigidBody>(surface, moves->centre), 0.2, true, moves}};
    const auto met = run(s, sc, 200, 2e-3);
    const auto t = stepping::totals(s, sc.materials);
    CHECK(t.momentum[0] > 0.3 * t.mass);
    CHECK(t.momentum[0] == Approx(met.impulse[0]).epsilon(1e-11));
    CHECK(std::abs(t.momentum[1]) < 0.05 * t.momentum[0]);
    CHECK(residualShare(s, sc) < 1e-11);
}

TEST_CASE("bodies are read; what cannot be is named")
{
    const auto soil = block();
    const auto read = [&](const std::string& text) {
        stepping::Scene sc = scene();
        cases::readRigidBodies(dictionary::Dictionary::fromText(text, "rigidBodies"), soil, sc);
        return sc;
    };
    const std::string square = "points ((0.2 0.5) (0.8 0.5) (0.8 1) (0.2 1)); ";
    const auto sc = read("blade { " + square + "mu 0.3; motion { velocity (0.1 0 0); rotation { angle \"t\"; } } }");
    REQUIRE(sc.bodies.size() == 1);
    CHECK(sc.bodies[0].motion->pose(2).position[0] == Approx(0.7));
    CHECK(sc.bodies[0].motion->pose(M_PI / 2).rotation[3] == Approx(1));
    CHECK_THROWS_WITH(read("\nblade { }"), Contains("rigidBodies:2") && Contains("points"));
    CHECK_THROWS_WITH(read("blade { " + square + "mu -1; }"), Contains("mu"));
    CHECK_THROWS_WITH(read("history { " + square + "}"), Contains("another name"));
    CHECK_THROWS_WITH(read("blade { points ((9 0) (10 0) (10 1)); }"), Contains("outside the grid"));
    CHECK_THROWS_WITH(read("blade { points ((0.2 0.5) (0.8 0.5) (0.8 0.55) (0.2 0.55)); }"), Contains("thick at most"));
    CHECK_THROWS_WITH(read("blade { points ((0.2 0.5) (1.2 0.5) (1.2 1) (0.2 1)); }"),
                      Contains("particles inside the body") && Contains("cells"));
    CHECK_THROWS_WITH(read("blade { points ((0.2 0.5) (0.8 1.1) (0.8 0.5) (0.2 1)); }"), Contains("cuts itself"));
    CHECK_THROWS_WITH(read("blade { " + square + "motion { } }"), Contains("found no motion"));
    CHECK_THROWS_WITH(read("blade { " + square + "motion { rotation { axis (1 0 0); angle 1; } } }"), Contains("axis"));
    CHECK_THROWS_WITH(read("blade { " + square + "geometry \"a.msh\"; }"), Contains("besides"));
}

TEST_CASE("a body too fast for its step is refused")
{
    nodal::RigidMotion moves;
    moves.centre = {0.6, 0.6, 0};
    moves.translation = motion("velocity (100 0 0);");
    auto sc = scene();
    sc.bodies = {polygon("bullet", disc(moves.centre, 0.3), 0, moves)};
    auto s = block();
    CHECK_THROWS_WITH(run(s, sc, 5, 1e-3), Contains("bullet") && Contains("half a cell") && Contains("smaller deltaT"));
}

// Walls and loads: Coulomb's law on a block, corners, separation, sticking, and the resultant of loads.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using nodal::WallType;

namespace
{
/// A stiff block of 1 m x 0.5 m resting on y = 0.
state::State block(const Vector3& velocity = {})
{
    return scenes::seedBlock(
        {.corner = {1, 0, 0}, .n = {8, 4, 1}, .spacing = 0.125, .h = 0.25, .cells = {60, 12, 1}, .velocity = velocity});
}

stepping::Scene scene(const Vector3& g, const std::vector<nodal::Wall>& walls)
{
    stepping::Scene out;
    out.materials = {scenes::elastic(1e6, 0)};
    if (g != Vector3{})
        out.gravity = g;
    out.walls = walls;
    return out;
}

struct Mean
{
    double x = 0, u = 0, v = 0;
};

Mean mean(const state::Particles& p)
{
    Mean m;
    for (Index i = 0; i < p.size(); ++i)
    {
        m.x += p.x[0][std::size_t(i)] / double(p.size());
        m.u += p.v[0][std::size_t(i)] / double(p.size());
        m.v += p.v[1][std::size_t(i)] / double(p.size());
    }
    return m;
}

void run(state::State& s, const stepping::Scene& sc, double time, double dt)
{
    auto stepper = cases::makeStepper("uGIMP", s, sc);
    stepping::beginLedger(s, sc.materials);
    while (s.time < time - 0.5 * dt)
        stepper->step(dt);
}
} // namespace

TEST_CASE("a block on an incline sticks or slides with a = g (sin - mu cos)")
{
    // REFERENCES: block: stick if tan(th) <= mu, else a = g (sin th - mu cos th)
    const double g = 9.8;
    for (const auto& [degrees, mu] : std::vector<std::pair<double, double>>{{30, 0.2}, {30, 1e6}, {45, 0.3}, {45, 0.0}})
    {
        const double th = degrees * M_PI / 180;
        const bool sticks = std::tan(th) <= mu;
        const double a = sticks ? 0 : g * (std::sin(th) - mu * std::cos(th));
        auto s = block();
        const double x0 = mean(s.particles).x;
        // the normal stress is there from the start; mu = 1e6 is
        // stick
        for (Index i = 0; i < s.particles.size(); ++i)
            s.particles.stress[1][std::size_t(i)] = -1000 * g * std::cos(th) * (0.5 - s.particles.x[1][std::size_t(i)]);
        const auto sc =
            scene({g * std::sin(th), -g * std::cos(th), 0}, {{"base", WallType::friction, 1, -1, 0, mu, true}});
        run(s, sc, 0.5, 2e-3);
        const auto m = mean(s.particles);
        if (sticks) // it leans and swings about its base, but does not go anywhere: sliding would take it 0.6 m
            CHECK(std::abs(m.x - x0) < 4e-3);
        else
        {
            CHECK(m.u == Approx(a * 0.5).epsilon(0.02));
            CHECK(m.x - x0 == Approx(0.5 * a * 0.25).epsilon(0.02));
        }
        if (mu > 0 && !sticks) // mu N times the path
            CHECK(s.ledger.frictionDissipation == Approx(mu * 500 * g * std::cos(th) * 0.5 * a * 0.25).epsilon(0.05));
        if (mu == 0)
            CHECK(s.ledger.frictionDissipation == 0);
    }
}

TEST_CASE("a separating wall lets go, a holding wall does not")
{
    auto free = block({0, 1, 0}), held = block({0, 1, 0});
    run(free, scene({}, {{"base", WallType::roller, 1, -1, 0, 0, true}}), 0.2, 1e-3);
    CHECK(mean(free.particles).v == Approx(1).epsilon(1e-9));
    CHECK(free.ledger.wallImpulse[1] == Approx(0).margin(1e-9));
    run(held, scene({}, {{"base", WallType::roller, 1, -1, 0, 0, false}}), 0.2, 1e-3);
    CHECK(mean(held.particles).v < 0.9);
    CHECK(held.ledger.wallImpulse[1] < -10);
}

TEST_CASE("in a corner nothing moves into either wall; fixed walls hold all of it")
{
    auto s = scenes::seedBlock({.corner = {0, 0, 0},
                                .n = {4, 4, 1},
                                .spacing = 0.125,
                                .h = 0.25,
                                .cells = {8, 8, 1},
                                .velocity = {-1, -1, 0}});
    run(s,
        scene({},
              {{"left", WallType::friction, 0, -1, 0, 0.3, true}, {"base", WallType::friction, 1, -1, 0, 0.3, true}}),
        0.02, 1e-3);
    for (Index i = 0; i < s.particles.size(); ++i)
        for (int a = 0; a < 2; ++a)
            CHECK(s.particles.x[a][std::size_t(i)] > 0);
    // symmetric in x and y
    const auto& p = s.particles;
    double difference = 0;
    for (Index i = 0; i < p.size(); ++i)
        for (Index j = 0; j < p.size(); ++j)
            if (p.id[std::size_t(i)] % 4 == p.id[std::size_t(j)] / 4 &&
                p.id[std::size_t(i)] / 4 == p.id[std::size_t(j)] % 4)
                difference = std::max(difference, std::abs(p.x[0][std::size_t(i)] - p.x[1][std::size_t(j)]));
    CHECK(difference < 1e-12);

    auto fixed = block({0.1, 0, 0});
    run(fixed, scene({}, {{"base", WallType::fixed, 1, -1, 0, 0, false}}), 0.05, 1e-3);
    CHECK(fixed.ledger.wallImpulse[0] < 0);
    CHECK(fixed.ledger.wallLoss > 0);
    CHECK(fixed.ledger.frictionDissipation == 0);
}

namespace
{
/// The top of block(): segments along x at y = 0.5, outward normal up: (e_y, -e_x) with e = (-0.125, 0).
state::SurfacePatch topOf(const state::State&)
{
    state::SurfacePatch top;
    top.name = "top";
    for (int i = 0; i < 8; ++i)
    {
        top.centre[0].push_back(1 + 0.125 * (i + 0.5));
        top.centre[1].push_back(0.5);
        top.edges[0].push_back(-0.125);
        top.edges[1].push_back(0);
    }
    return top;
}
} // namespace

TEST_CASE("loads: momentum is force times time, pressure acts along the inward normal")
{
    for (const std::string shape : {"uGIMP", "linear"})
    {
        auto pulled = block(), pressed = block();
        for (auto* s : {&pulled, &pressed})
            s->patches = {topOf(*s)};
        auto sc = scene({}, {});
        sc.loads = {{.patch = "top", .pressure = false, .traction = {300, -200, 0}}};
        auto stepper = cases::makeStepper(shape, pulled, sc);
        stepping::beginLedger(pulled, sc.materials);
        for (int i = 0; i < 10; ++i)
            stepper->step(1e-4);
        auto t = stepping::totals(pulled, sc.materials);
        // 1 m of surface, 1e-3 s; the area has hardly changed
        CHECK(t.momentum[0] == Approx(0.300).epsilon(1e-3));
        CHECK(t.momentum[1] == Approx(-0.200).epsilon(1e-3));
        for (int a = 0; a < 2; ++a)
            CHECK(t.momentum[a] == Approx(pulled.ledger.tractionImpulse[a]).epsilon(1e-10));
        CHECK(stepping::residual(pulled.ledger, t.strainEnergy) == Approx(0).margin(0.02 * pulled.ledger.tractionWork));

        sc.loads = {{.patch = "top", .pressure = true, .magnitude = 1000}};
        auto press = cases::makeStepper(shape, pressed, sc);
        for (int i = 0; i < 10; ++i)
            press->step(1e-4);
        t = stepping::totals(pressed, sc.materials);
        CHECK(t.momentum[1] == Approx(-1.0).epsilon(1e-3));
        CHECK(std::abs(t.momentum[0]) < 1e-6);
        CHECK(pressed.patches[0].centre[1][4] < 0.5); // the surface follows
    }
}

TEST_CASE("a column under pressure settles to sigma_yy = -p, with rollers at its sides to K0 of it")
{
    auto s = scenes::seedBlock({.corner = {0, 0, 0}, .n = {4, 8, 1}, .spacing = 0.125, .h = 0.25, .cells = {2, 8, 1}});
    state::SurfacePatch top;
    top.name = "top";
    for (int i = 0; i < 4; ++i)
    {
        top.centre[0].push_back(0.125 * (i + 0.5));
        top.centre[1].push_back(1);
        top.edges[0].push_back(-0.125);
        top.edges[1].push_back(0);
    }
    s.patches = {top};
    stepping::Scene sc;
    sc.materials = {scenes::elastic(1e6, 0.3)};
    sc.walls = {{"left", WallType::roller, 0, -1, 0, 0, false},
                {"right", WallType::roller, 0, 1, 2, 0, false},
                {"base", WallType::roller, 1, -1, 0, 0, false}};
    sc.loads = {{.patch = "top", .pressure = true, .magnitude = 1000}};
    auto stepper = cases::makeStepper("uGIMP", s, sc);
    double last = 0;
    for (int i = 0; i < 6000;
         ++i) // kinetic damping: at every peak of the kinetic energy all velocities are set to zero
    {
        stepper->step(1e-3);
        if (s.ledger.kineticEnergy < last)
        {
            for (auto& v : s.particles.v)
                std::fill(v.begin(), v.end(), 0.0);
            s.ledger.kineticEnergy = 0;
            stepper->particlesChanged();
        }
        last = s.ledger.kineticEnergy;
    }
    for (Index i = 0; i < s.particles.size(); ++i)
    {
        CHECK(s.particles.stress[1][std::size_t(i)] == Approx(-1000).epsilon(0.03));
        CHECK(s.particles.stress[0][std::size_t(i)] == Approx(-1000 * 0.3 / 0.7).epsilon(0.03));
    }
}

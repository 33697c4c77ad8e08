// Contact between bodies: momentum, impact, friction, stick, symmetry, reproducibility, and what costs nothing.
#include "support/bodies.hpp"

#include <catch2/catch.hpp>
#include <omp.h>

using namespace mpm;
using namespace bodies;
using stepping::StressUpdate;

namespace
{
struct Difference
{
    double motion = 0; ///< of positions [m], velocities [m/s], deformation
    double stress = 0; ///< [Pa]
};

Difference largestDifference(const state::Particles& one, const state::Particles& other)
{
    Difference most;
    const auto a = byId(one), b = byId(other);
    REQUIRE(a.size() == b.size());
    const std::size_t stress = 2 * std::size_t(one.dim), end = stress + std::size_t(stressComponents(one.dim));
    for (const auto& [id, row] : a)
        for (std::size_t k = 0; k < row.size(); ++k)
        {
            double& largest = k >= stress && k < end ? most.stress : most.motion;
            largest = std::max(largest, std::abs(row[k] - b.at(id)[k]));
        }
    return most;
}

/// Two bars of 1 m x 0.2 m, `gap` apart at x = 2, which meet with 2 v; c = sqrt(E/rho) = 31.6 m/s.
state::State bars(double gap, double v, double h = 0.05, double density = 1000)
{
    const Index n = Index(std::lround(2 / h)), across = Index(std::lround(0.4 / h));
    const std::array<Index, 3> cells{Index(std::lround(4 / h)), Index(std::lround(0.4 / h)), 1};
    return join({{{.corner = {1 - gap / 2, 0.1, 0},
                   .n = {n, across, 1},
                   .spacing = h / 2,
                   .h = h,
                   .cells = cells,
                   .velocity = {v, 0, 0}},
                  0},
                 {{.corner = {2 + gap / 2, 0.1, 0},
                   .n = {n, across, 1},
                   .spacing = h / 2,
                   .h = h,
                   .density = density,
                   .cells = cells,
                   .velocity = {-v, 0, 0}},
                  1}});
}
} // namespace

TEST_CASE("equal bars that meet head-on exchange their velocities, and momentum and the budget are exact")
{
    // 1D theory: they meet at gap/(2 v) and part 2 L/c later with their velocities exchanged. What the grid adds is the
    // impact of its nodes, in proportion to h, and vibrations.
    for (const auto update : updates)
    {
        double lost[2] = {}, impact[2] = {};
        for (const int fine : {0, 1})
        {
            CAPTURE(int(update), fine);
            const double h = fine ? 0.05 : 0.1;
            auto s = bars(0.02, 0.1, h);
            auto scene = sceneOf(2, 0);
            scene.stressUpdate = update;
            const double residual = run(s, scene, int(std::lround(0.2 / (h / 100))), h / 100);
            const auto left = motionOf(s, 0), right = motionOf(s, 1);
            const double start = left.mass * 0.01;
            CHECK(std::abs(left.velocity[0] + right.velocity[0]) < 1e-15);
            CHECK(std::abs(left.velocity[1]) < 1e-15);
            CHECK(std::abs(residual) < 1e-12 * start);
            CHECK(s.ledger.contactFriction == 0);
            lost[fine] = 1 + left.velocity[0] / 0.1;
            impact[fine] = s.ledger.contactLoss / start;
        }
        CHECK(lost[1] < 0.07);
        CHECK(lost[1] < 0.65 * lost[0]);
        CHECK(impact[1] > 0);
        CHECK(impact[1] == Approx(0.5 * impact[0]).epsilon(0.03));
        CHECK(impact[0] < 0.075);
    }
}

TEST_CASE("bodies touch when their domains meet, not when they share a node")
{
    for (const double gap : {0.02, 0.033})
        for (const auto detection : {nodal::ContactDetection::domains, nodal::ContactDetection::nodes})
        {
            CAPTURE(gap, int(detection));
            auto s = bars(gap, 0.1);
            auto scene = sceneOf(2, 0);
            scene.contact->detection = detection;
            auto stepper = cases::makeStepper("uGIMP", s, scene);
            stepping::beginLedger(s, scene.materials);
            while (s.ledger.contactNodes == 0 && s.time < 1)
                stepper->step(5e-4);
            if (detection == nodal::ContactDetection::domains)
                CHECK(s.time == Approx(gap / 0.2).margin(6e-4));
            else
                CHECK(s.time < 0.001);
        }
}

namespace
{
/// A block of 0.8 m x 0.4 m on a slab that lies on the fixed floor y = 0; the surface of the slab is y = 0.25, at no
/// node. `swapped` exchanges the numbers of the bodies, `mirrored` turns x around. The slab begins at x = 0.5 and has
/// `columns` of five particles.
state::State blockOnSlab(double speed, bool swapped = false, bool mirrored = false, Index columns = 50)
{
    const double h = 0.1;
    const std::array<Index, 3> cells{40, 12, 1};
    const Vector3 low{0, -0.2, 0};
    return join({{{.corner = {mirrored ? 4 - 1.8 : 1, 0.25, 0},
                   .n = {16, 8, 1},
                   .spacing = 0.05,
                   .h = h,
                   .low = low,
                   .cells = cells,
                   .velocity = {mirrored ? -speed : speed, 0, 0}},
                  swapped ? 1 : 0},
                 {{.corner = {mirrored ? 4 - 0.5 - 0.05 * double(columns) : 0.5, 0, 0},
                   .n = {columns, 5, 1},
                   .spacing = 0.05,
                   .h = h,
                   .low = low,
                   .cells = cells},
                  swapped ? 0 : 1}});
}

stepping::Scene slabScene(double mu, StressUpdate update = StressUpdate::MUSL)
{
    auto scene = sceneOf(2, mu, 1e6, 0.3);
    scene.stressUpdate = update;
    scene.gravity = Vector3{0, -9.8, 0};
    scene.walls = {{"base", nodal::WallType::fixed, 1, -1, 2, 0, false}};
    return scene;
}
} // namespace

TEST_CASE("a block that slides is held by mu times what presses it, and friction takes what it loses")
{
    for (const double mu : {0.0, 0.1, 0.2})
        for (const auto update : updates)
        {
            CAPTURE(mu, int(update));
            auto s = blockOnSlab(0.5);
            const double residual = run(s, slabScene(mu, update), 400, 5e-4);
            const auto m = motionOf(s, 0);
            const double press = m.mass * (9.8 * s.time + m.velocity[1]);
            CHECK(m.mass * (0.5 - m.velocity[0]) == Approx(mu * press).epsilon(0.01).margin(1e-3 * press));
            CHECK(s.ledger.contactFriction >= 0);
            CHECK(std::abs(residual) < 1e-11 * m.mass * 0.125);
        }
}

TEST_CASE("with much friction nothing slips")
{
    for (const auto update : updates)
    {
        auto s = blockOnSlab(0);
        auto scene = slabScene(1e6, update);
        scene.gravity = Vector3{6, -7.7, 0};
        run(s, scene, 400, 5e-4);
        const auto block = motionOf(s, 0), slab = motionOf(s, 1);
        CHECK(std::abs(s.ledger.contactFriction) < 1e-14 * s.ledger.gravityWork); // no slip where bodies press
        CHECK(s.ledger.contactNodes > 0);
        CHECK(std::abs(block.velocity[0]) < 0.1 * 6 * s.time); // it swings in shear, and does not slide
        CHECK(std::abs(slab.velocity[0]) < 0.1 * 6 * s.time);
    }
}

TEST_CASE("which body is named first, and from which side one looks, does not matter")
{
    const auto scene = slabScene(0.2);
    auto s = blockOnSlab(0.5), swapped = blockOnSlab(0.5, true), mirrored = blockOnSlab(0.5, false, true);
    run(s, scene, 300, 5e-4);
    run(swapped, scene, 300, 5e-4);
    run(mirrored, scene, 300, 5e-4);
    const Difference round = largestDifference(s.particles, swapped.particles);
    CHECK(round.motion < 5e-12);
    CHECK(round.stress < 1e-13 * 1e6); // of Young's modulus
    // Chunks of particles begin at multiples of eight, whatever a particle's body: only that changes sums, by
    // round-off.
    auto eights = blockOnSlab(0.5, false, false, 56), swappedEights = blockOnSlab(0.5, true, false, 56);
    run(eights, scene, 300, 5e-4);
    run(swappedEights, scene, 300, 5e-4);
    CHECK(byId(eights.particles) == byId(swappedEights.particles));
    const auto a = motionOf(s, 0), b = motionOf(mirrored, 0);
    CHECK(std::abs(a.velocity[0] + b.velocity[0]) < 1e-9);
    CHECK(std::abs(a.centre[0] + b.centre[0] - 4) < 1e-9);
}

TEST_CASE("threads and restarts change no bit")
{
    const auto scene = slabScene(0.2);
    const int before = omp_get_max_threads();
    auto one = blockOnSlab(0.5), many = one, again = one;
    omp_set_num_threads(1);
    run(one, scene, 200, 5e-4);
    run(again, scene, 87, 5e-4);
    run(again, scene, 113, 5e-4);
    omp_set_num_threads(3);
    run(many, scene, 200, 5e-4);
    omp_set_num_threads(before);
    CHECK(byId(one.particles) == byId(many.particles));
    CHECK(byId(one.particles) == byId(again.particles));
    CHECK(one.ledger.contactFriction == many.ledger.contactFriction);
    CHECK(one.ledger.contactNodes == again.ledger.contactNodes);
}

TEST_CASE("materials of one body, and bodies that never meet, move as without contact")
{
    auto scene = slabScene(0.2);
    auto plain = blockOnSlab(0.5), one = plain;
    auto without = scene;
    without.contact.reset();
    run(plain, without, 100, 5e-4);
    scene.contact = contactOf(1, 0.2);
    scene.contact->bodyOf = {0, 0};
    run(one, scene, 100, 5e-4);
    CHECK(byId(plain.particles) == byId(one.particles));
    CHECK(one.ledger.contactNodes == 0);

    auto apart =
        join({{{.corner = {0.3, 0.2, 0}, .n = {16, 8, 1}, .spacing = 0.05, .h = 0.1, .cells = {100, 20, 1}}, 0},
              {{.corner = {6.6, 0.2, 0}, .n = {16, 16, 1}, .spacing = 0.05, .h = 0.1, .cells = {100, 20, 1}}, 1}});
    auto free = apart;
    scene = slabScene(0.2);
    scene.walls = {{"base", nodal::WallType::roller, 1, -1, 0, 0, true}};
    without = scene;
    without.contact.reset();
    run(apart, scene, 400, 5e-4);
    run(free, without, 400, 5e-4);
    CHECK(apart.ledger.contactNodes == 0);
    CHECK(apart.particles.v[1][0] != -9.8 * 0.2); // they have met the floor
    CHECK(byId(apart.particles) == byId(free.particles));
}

TEST_CASE("three bodies at a node keep momentum and do not overlap")
{
    // Two blocks side by side fall on a third, the seam over its middle.
    const double h = 0.1;
    const std::array<Index, 3> cells{30, 20, 1};
    for (const double mu : {0.0, 0.5})
    {
        auto s = join({{{.corner = {1.1, 0.5, 0},
                         .n = {8, 8, 1},
                         .spacing = 0.05,
                         .h = h,
                         .cells = cells,
                         .velocity = {0.1, -0.3, 0}},
                        0},
                       {{.corner = {1.5, 0.5, 0},
                         .n = {8, 8, 1},
                         .spacing = 0.05,
                         .h = h,
                         .cells = cells,
                         .velocity = {-0.1, -0.3, 0}},
                        1},
                       {{.corner = {0.9, 0.1, 0},
                         .n = {24, 8, 1},
                         .spacing = 0.05,
                         .h = h,
                         .cells = cells,
                         .velocity = {0, 0.2, 0}},
                        2}});
        const auto scene = sceneOf(3, mu);
        const auto before = stepping::totals(s, scene.materials);
        const double residual = run(s, scene, 300, 5e-4);
        const auto after = stepping::totals(s, scene.materials);
        const double scale = before.mass * 0.3;
        for (int a = 0; a < 2; ++a)
            CHECK(std::abs(after.momentum[a] - before.momentum[a]) < 1e-13 * scale);
        CHECK(std::abs(residual) < 1e-11 * scale);
        CHECK(s.ledger.contactLoss > 0);
        double lowest = 1, highest = 0, left = 0, right = 3;
        for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
        {
            const double x = s.particles.x[0][i], y = s.particles.x[1][i];
            if (s.particles.material[i] == 2)
                highest = std::max(highest, y);
            else
                lowest = std::min(lowest, y);
            if (s.particles.material[i] == 0)
                left = std::max(left, x);
            if (s.particles.material[i] == 1)
                right = std::min(right, x);
        }
        CHECK(lowest - highest > 0.05 - 0.25 * h);
        CHECK(right - left > 0.05 - 0.25 * h);
    }
}

TEST_CASE("a body ten thousand times as light is pushed along, and not through")
{
    auto s = bars(0.004, 0.1, 0.1, 0.1);
    auto scene = sceneOf(2, 0);
    scene.materials[1] = scenes::elastic(1e2, 0, 0.1);
    run(s, scene, 600, 1e-3);
    const auto heavy = motionOf(s, 0), light = motionOf(s, 1);
    const double overlap = [&] {
        double left = 0, right = 4;
        for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
            if (s.particles.material[i] == 0)
                left = std::max(left, s.particles.x[0][i]);
            else
                right = std::min(right, s.particles.x[0][i]);
        return left + 0.05 - right;
    }();
    CHECK(std::abs(heavy.mass * (heavy.velocity[0] - 0.1) + light.mass * (light.velocity[0] + 0.1)) <
          1e-13 * heavy.mass * 0.1);
    CHECK(overlap < 0.5 * 0.1);
}

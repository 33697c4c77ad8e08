// Contact between bodies: momentum, impact, friction, stick, symmetry, reproducibility, and what costs nothing.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <omp.h>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
/// One body of a scene: a block of particles of material `material`.
struct Body
{
    scenes::Block block;
    int material = 0;
};

state::State join(const std::vector<Body>& bodies)
{
    auto all = scenes::seedBlock(bodies.front().block);
    auto& p = all.particles;
    all.materials.clear();
    int materials = 0;
    std::fill_n(p.material.begin(), p.size(), bodies.front().material);
    for (std::size_t b = 1; b < bodies.size(); ++b)
    {
        const auto more = scenes::seedBlock(bodies[b].block);
        for (Index i = 0; i < more.particles.size(); ++i)
        {
            const std::size_t n = std::size_t(p.appendCopy(0)), from = std::size_t(i);
            for (int a = 0; a < p.dim; ++a)
            {
                p.x[a][n] = more.particles.x[a][from];
                p.v[a][n] = more.particles.v[a][from];
                p.length0[a][n] = more.particles.length0[a][from];
            }
            p.mass[n] = more.particles.mass[from];
            p.volume[n] = p.volume0[n] = more.particles.volume[from];
            p.id[n] = all.nextId++;
            p.material[n] = bodies[b].material;
        }
    }
    for (const auto& body : bodies)
        materials = std::max(materials, body.material + 1);
    for (int m = 0; m < materials; ++m)
        all.materials.push_back("body" + std::to_string(m));
    p.padLastChunk();
    return all;
}

nodal::ContactProperties contactOf(int bodies, double mu)
{
    nodal::ContactProperties contact;
    for (int b = 0; b < bodies; ++b)
    {
        contact.bodies.push_back("body" + std::to_string(b));
        contact.bodyOf.push_back(b);
    }
    contact.mu.assign(std::size_t(bodies), std::vector<double>(std::size_t(bodies), mu));
    return contact;
}

stepping::Scene sceneOf(int bodies, double mu, double E = 1e6, double nu = 0)
{
    stepping::Scene scene;
    for (int b = 0; b < bodies; ++b)
        scene.materials.push_back(scenes::elastic(E, nu));
    scene.contact = contactOf(bodies, mu);
    return scene;
}

struct Motion
{
    double mass = 0;
    Vector3 centre{}, velocity{};
};

Motion motionOf(const state::State& s, int material)
{
    Motion m;
    const auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        if (p.material[i] == material)
        {
            m.mass += p.mass[i];
            for (int a = 0; a < p.dim; ++a)
            {
                m.centre[a] += p.mass[i] * p.x[a][i];
                m.velocity[a] += p.mass[i] * p.v[a][i];
            }
        }
    for (int a = 0; a < 3; ++a)
    {
        m.centre[a] /= m.mass;
        m.velocity[a] /= m.mass;
    }
    return m;
}

/// Every number of every particle, by id.
std::map<std::int64_t, std::vector<double>> byId(const state::Particles& p)
{
    std::map<std::int64_t, std::vector<double>> out;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        auto& row = out[p.id[i]];
        for (int a = 0; a < p.dim; ++a)
        {
            row.push_back(p.x[a][i]);
            row.push_back(p.v[a][i]);
        }
        for (int k = 0; k < stressComponents(p.dim); ++k)
            row.push_back(p.stress[k][i]);
        for (int k = 0; k < p.dim * p.dim; ++k)
            row.push_back(p.F[k][i]);
    }
    return out;
}

double largestDifference(const state::Particles& one, const state::Particles& other)
{
    double most = 0;
    const auto a = byId(one), b = byId(other);
    REQUIRE(a.size() == b.size());
    for (const auto& [id, row] : a)
        for (std::size_t k = 0; k < row.size(); ++k)
            most = std::max(most, std::abs(row[k] - b.at(id)[k]));
    return most;
}

double run(state::State& s, const stepping::Scene& scene, int steps, double dt)
{
    auto stepper = cases::makeStepper("uGIMP", s, scene);
    stepping::beginLedger(s, scene.materials);
    for (int i = 0; i < steps; ++i)
        stepper->step(dt);
    return stepping::residual(s.ledger, stepping::totals(s, scene.materials).strainEnergy);
}

const std::vector<StressUpdate> updates = {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL};

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
    // 1D theory: they meet at gap/(2 v) and part 2 L/c later with their velocities exchanged, no energy lost.
    double lost[2] = {};
    for (const auto update : updates)
        for (const double h : {0.1, 0.05})
        {
            CAPTURE(int(update), h);
            auto s = bars(0.02, 0.1, h);
            auto scene = sceneOf(2, 0);
            scene.stressUpdate = update;
            const double residual = run(s, scene, int(0.2 / (h / 100)), h / 100);
            const auto left = motionOf(s, 0), right = motionOf(s, 1);
            const double start = left.mass * 0.01;
            CHECK(std::abs(left.velocity[0] + right.velocity[0]) < 1e-14 * 0.1);
            CHECK(std::abs(left.velocity[1]) < 1e-14);
            CHECK(std::abs(residual) < 1e-12 * start);
            CHECK(s.ledger.contactFriction == 0);
            CHECK(s.ledger.contactLoss >= 0);
            lost[h < 0.075] = 1 + left.velocity[0] / 0.1;
            printf("update %d h %g: v %g loss %g KE %g transfer %g nodes %ld\n", int(update), h, left.velocity[0], s.ledger.contactLoss/start, s.ledger.kineticEnergy/start, s.ledger.transferLoss/start, long(s.ledger.contactNodes));
        }
}

TEST_CASE("bodies touch where their domains meet, not where they share a node")
{
    for (const auto detection : {nodal::ContactDetection::domains, nodal::ContactDetection::nodes})
    {
        auto s = bars(0.02, 0.1);
        auto scene = sceneOf(2, 0);
        scene.contact->detection = detection;
        auto stepper = cases::makeStepper("uGIMP", s, scene);
        stepping::beginLedger(s, scene.materials);
        while (s.ledger.contactNodes == 0 && s.time < 0.2)
            stepper->step(5e-4);
        printf("first contact at %g\n", s.time);
    }
}

TEST_CASE("a block that slides is held by mu times its weight, one that grips stays")
{
    for (const double mu : {0.0, 0.2, 1e6})
        for (const auto update : updates)
        {
            auto s = join({{{.corner = {1, 0.25, 0}, .n = {16, 8, 1}, .spacing = 0.05, .h = 0.1, .low = {0, -0.2, 0},
                             .cells = {40, 12, 1}, .velocity = {0.5, 0, 0}}, 0},
                           {{.corner = {0.5, 0, 0}, .n = {50, 5, 1}, .spacing = 0.05, .h = 0.1, .low = {0, -0.2, 0},
                             .cells = {40, 12, 1}}, 1}});
            auto scene = sceneOf(2, mu);
            scene.stressUpdate = update;
            scene.gravity = Vector3{0, -9.8, 0};
            scene.walls = {{"base", nodal::WallType::fixed, 1, -1, 2, 0, false}};
            const double residual = run(s, scene, 400, 5e-4);
            const auto m = motionOf(s, 0);
            printf("mu %g update %d v %g (%g) y %g friction %g loss %g of %g res %g\n", mu, int(update), m.velocity[0], 0.5 - mu * 9.8 * 0.2, m.centre[1], s.ledger.contactFriction, s.ledger.contactLoss, m.mass*0.125, residual);
        }
}

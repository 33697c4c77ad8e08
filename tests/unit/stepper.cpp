// The explicit step: conservation, exactness where the scheme is exact, equality where it must be bitwise.
#include "base/error.hpp"
#include "case/makeStepper.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/neoHookean.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <omp.h>
#include <random>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
stepping::Scene sceneOf(const constitutive::Material& material, StressUpdate update)
{
    stepping::Scene scene;
    scene.materials = {material};
    scene.stressUpdate = update;
    return scene;
}

constitutive::Material soil()
{
    return {"solid", 1000,
            std::make_shared<constitutive::MohrCoulomb>(constitutive::MohrCoulombParameters{{20e6, 0.42}, 1e3, 42, 0})};
}

/// A small column, 2 m x 4 m, under K0 stress: it yields and collapses at once.
state::State column(int dim = 2, double h = 0.5)
{
    auto s = scenes::seedBlock({.dim = dim,
                                .corner = {0, 0, 0},
                                .n = {Index(2 / (h / 2)), Index(4 / (h / 2)), dim == 3 ? 2 : 1},
                                .spacing = h / 2,
                                .h = h,
                                .low = {-6, 0, 0},
                                .cells = {Index(14 / h), Index(6 / h), 1}});
    for (Index i = 0; i < s.particles.size(); ++i)
    {
        const double depth = 4 - s.particles.x[1][std::size_t(i)];
        s.particles.stress[1][std::size_t(i)] = -9800 * depth;
        s.particles.stress[0][std::size_t(i)] = s.particles.stress[2][std::size_t(i)] = -9800 * depth * 0.42 / 0.58;
    }
    return s;
}

stepping::Scene columnScene(StressUpdate update = StressUpdate::MUSL)
{
    auto scene = sceneOf(soil(), update);
    scene.gravity = Vector3{0, -9.8, 0};
    scene.walls = {{"base", nodal::WallType::friction, 1, -1, 0, 0.6, true}};
    return scene;
}

void run(state::State& s, const stepping::Scene& scene, const std::string& shape, int steps, double dt)
{
    auto stepper = cases::makeStepper(shape, s, scene);
    stepping::beginLedger(s, scene.materials);
    for (int i = 0; i < steps; ++i)
        stepper->step(dt);
}

/// Every number of every particle, by id.
std::map<std::int64_t, std::vector<double>> byId(const state::Particles& p)
{
    std::map<std::int64_t, std::vector<double>> out;
    for (Index i = 0; i < p.size(); ++i)
    {
        auto& row = out[p.id[std::size_t(i)]];
        for (int a = 0; a < p.dim; ++a)
        {
            row.push_back(p.x[a][std::size_t(i)]);
            row.push_back(p.v[a][std::size_t(i)]);
        }
        for (int k = 0; k < stressComponents(p.dim); ++k)
            row.push_back(p.stress[k][std::size_t(i)]);
        for (int k = 0; k < p.dim * p.dim; ++k)
            row.push_back(p.F[k][std::size_t(i)]);
        row.push_back(p.volume[std::size_t(i)]);
    }
    return out;
}

const std::vector<std::string> shapes = {"linear", "uGIMP", "cpGIMP", "CPDI", "cubicBSpline"};
const std::vector<StressUpdate> updates = {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL};
} // namespace

TEST_CASE("a particle in free fall follows the sum of the scheme and does not strain itself")
{
    for (const auto& shape : shapes)
        for (const auto update : updates)
        {
            auto s = scenes::seedBlock(
                {.corner = {1.1, 7.3, 0}, .spacing = 0.25, .h = 0.5, .cells = {8, 20, 1}, .velocity = {0.3, 0, 0}});
            auto scene = sceneOf(scenes::elastic(1e6, 0.3), update);
            scene.gravity = Vector3{0, -9.8, 0};
            const double x0 = s.particles.x[0][0], y0 = s.particles.x[1][0], dt = 1e-3;
            run(s, scene, shape, 1000, dt);
            // v_n = n dt g; y_n = y_0 + dt sum v_k
            CHECK(s.particles.v[1][0] == Approx(-9.8).epsilon(1e-12));
            CHECK(s.particles.x[1][0] == Approx(y0 - 9.8 * dt * dt * 1000 * 1001 / 2).epsilon(1e-12));
            CHECK(s.particles.x[0][0] == Approx(x0 + 0.3).epsilon(1e-12));
            CHECK(std::abs(s.particles.stress[1][0]) < 1e-3); // of 1e6 Pa
            CHECK(s.ledger.gravityWork == Approx(s.particles.mass[0] * 9.8 * 9.8 / 2).epsilon(1e-9));
        }
}

TEST_CASE("momentum changes by the impulses of gravity and walls alone, the budget closes")
{
    for (const auto& shape : shapes)
        for (const auto update : updates)
        {
            CAPTURE(shape, int(update));
            auto s = column();
            const auto scene = columnScene(update);
            run(s, scene, shape, 400, 5e-4);
            const auto t = stepping::totals(s, scene.materials);
            double scale = 0;
            for (Index i = 0; i < s.particles.size(); ++i)
                scale += s.particles.mass[std::size_t(i)] * 9.8 * s.time;
            for (int a = 0; a < 2; ++a)
                CHECK(std::abs(t.momentum[a] - s.ledger.initialMomentum[a] - s.ledger.gravityImpulse[a] -
                               s.ledger.wallImpulse[a]) < 1e-12 * scale);
            CHECK(s.ledger.gravityImpulse[1] == Approx(-scale).epsilon(1e-12));
            CHECK(t.mass == Approx(8000).epsilon(1e-14));
            CHECK(std::abs(stepping::residual(s.ledger, t.strainEnergy)) < 0.02 * s.ledger.gravityWork);
            CHECK(s.ledger.frictionDissipation >= 0);
            // leaving out what friction took makes the mismatch grow by just that
            auto without = s.ledger;
            without.frictionDissipation = 0;
            CHECK(stepping::residual(without, t.strainEnergy) - stepping::residual(s.ledger, t.strainEnergy) ==
                  Approx(s.ledger.frictionDissipation));
        }
}

TEST_CASE("one cell thick in 3D between rollers is plane strain")
{
    for (const auto& shape : shapes)
    {
        auto flat = column(2), solid = column(3);
        auto scene = columnScene();
        run(flat, scene, shape, 200, 5e-4);
        scene.walls.push_back({"front", nodal::WallType::roller, 2, -1, 0, 0, false});
        scene.walls.push_back({"back", nodal::WallType::roller, 2, 1, 1, 0, false});
        run(solid, scene, shape, 200, 5e-4);
        const auto a = byId(flat.particles), b = byId(solid.particles);
        const Index half = solid.particles.size() / 2;
        for (const auto& [id, row] : a)
            for (const std::int64_t twin : {id, id + half})
            {
                const auto& other = b.at(twin);
                CHECK(other[0] == Approx(row[0]).margin(1e-10));
                CHECK(other[2] == Approx(row[2]).margin(1e-10));
                CHECK(other[3] == Approx(row[3]).margin(1e-9));
                CHECK(other[6] == Approx(row[4]).margin(1e-4)); // of 1e5 Pa
                CHECK(other[7] == Approx(row[5]).margin(1e-4));
            }
    }
}

TEST_CASE("results are bitwise the same for any number of threads")
{
    auto scene = columnScene();
    scene.splitting = splitting::Rule{.threshold = 1.003};
    std::map<std::int64_t, std::vector<double>> first;
    double ledger = 0;
    for (const int threads : {1, 2, 3, 7})
    {
        omp_set_num_threads(threads);
        auto s = column();
        run(s, scene, "uGIMP", 130, 5e-4);
        if (threads == 1)
        {
            first = byId(s.particles);
            ledger = s.ledger.transferLoss;
            REQUIRE(s.ledger.splits > 0);
        }
        CHECK(byId(s.particles) == first);
        CHECK(s.ledger.transferLoss == ledger);
    }
    omp_set_num_threads(1);
}

TEST_CASE("a run cut in two, and particles shuffled in between, is bitwise the uncut run")
{
    for (const auto update : updates)
    {
        auto scene = columnScene(update);
        scene.splitting = splitting::Rule{.threshold = 1.003};
        auto whole = column();
        run(whole, scene, "cpGIMP", 113, 5e-4);
        auto first = column();
        run(first, scene, "cpGIMP", 47, 5e-4);
        std::vector<Index> order(std::size_t(first.particles.size()));
        std::iota(order.begin(), order.end(), Index(0));
        std::shuffle(order.begin(), order.end(), std::mt19937(3));
        first.particles.permute(order);
        run(first, scene, "cpGIMP", 66, 5e-4);
        CHECK(byId(first.particles) == byId(whole.particles));
        CHECK(first.ledger.transferLoss == whole.ledger.transferLoss);
        CHECK(first.ledger.plasticDissipation == whole.ledger.plasticDissipation);
        CHECK(first.nextId == whole.nextId);
    }
}

TEST_CASE("a symmetric column stays symmetric")
{
    auto s = column();
    run(s, columnScene(), "uGIMP", 600, 5e-4);
    const auto rows = byId(s.particles);
    for (Index y = 0; y < 16; ++y)
        for (Index x = 0; x < 4; ++x)
        {
            const auto& left = rows.at(y * 8 + x);
            const auto& right = rows.at(y * 8 + 7 - x);
            CHECK(left[0] + right[0] == Approx(2).margin(1e-9));
            CHECK(left[2] == Approx(right[2]).margin(1e-9));
        }
}

TEST_CASE("units do not matter: times by powers of two, results scale bitwise")
{
    auto s = column(), scaled = column();
    auto scene = columnScene();
    run(s, scene, "uGIMP", 150, 5e-4);
    // stress and mass a thousandfold (2^10), all else equal
    for (auto& component : scaled.particles.stress)
        for (double& value : component)
            value *= 1024;
    for (double& m : scaled.particles.mass)
        m *= 1024;
    auto heavy = scene;
    heavy.materials = {{"solid", 1024e3,
                        std::make_shared<constitutive::MohrCoulomb>(
                            constitutive::MohrCoulombParameters{{1024 * 20e6, 0.42}, 1024e3, 42, 0})}};
    run(scaled, heavy, "uGIMP", 150, 5e-4);
    auto a = byId(s.particles), b = byId(scaled.particles);
    for (auto& [id, row] : a)
    {
        for (std::size_t k = 4; k < 8; ++k)
            row[k] *= 1024;
        CHECK(row == b.at(id));
    }
}

TEST_CASE("a mixed chunk gives every particle its own law")
{
    auto s = scenes::seedBlock({.corner = {1, 1, 0}, .n = {8, 8, 1}, .spacing = 0.25, .h = 0.5, .cells = {10, 10, 1}});
    s.materials = {"soft", "stiff"};
    for (Index i = 0; i < s.particles.size(); ++i)
    {
        s.particles.material[std::size_t(i)] = std::int32_t(i % 2);
        s.particles.v[0][std::size_t(i)] = 0.1 * s.particles.x[0][std::size_t(i)];
    }
    stepping::Scene scene;
    scene.materials = {scenes::elastic(1e6, 0), scenes::elastic(3e6, 0)};
    scene.stressUpdate = StressUpdate::USF;
    run(s, scene, "uGIMP", 1, 1e-5);
    const auto& p = s.particles;
    for (Index i = 0; i < p.size(); ++i)
    {
        const double strain = std::log(p.F[0][std::size_t(i)]);
        CHECK(p.stress[0][std::size_t(i)] == Approx((p.material[std::size_t(i)] ? 3e6 : 1e6) * strain).epsilon(1e-9));
    }
}

TEST_CASE("lanes without a particle tell nothing in a mixed chunk")
{
    // Two soils without cohesion that expand: all return to their apex and carry no stress, so none is stiff.
    auto s = scenes::seedBlock({.corner = {1, 1, 0}, .n = {6, 6, 1}, .spacing = 0.25, .h = 0.5, .cells = {10, 10, 1}});
    s.materials = {"one", "other"};
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
    {
        s.particles.material[i] = std::int32_t(i % 2);
        for (int a = 0; a < 2; ++a)
            s.particles.v[a][i] = 10 * s.particles.x[a][i];
    }
    stepping::Scene scene;
    for (const double friction : {42, 35})
        scene.materials.push_back({"soil", 1000,
                                   std::make_shared<constitutive::MohrCoulomb>(
                                       constitutive::MohrCoulombParameters{{20e6, 0.42}, 0, friction, 0})});
    scene.stressUpdate = StressUpdate::USF;
    run(s, scene, "uGIMP", 1, 1e-4);
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
        REQUIRE(s.particles.volume[i] > s.particles.volume0[i]);
    CHECK(s.largestJacobian == 1);
}

TEST_CASE("waves in a hyperelastic body are as fast as its law says, in part chunks, too")
{
    // stretched, neo-Hookean bodies carry slower waves than det F alone would tell
    auto s = scenes::seedBlock({.corner = {1, 1, 0}, .n = {6, 6, 1}, .spacing = 0.25, .h = 0.5, .cells = {10, 10, 1}});
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
        for (int a = 0; a < 2; ++a)
            s.particles.v[a][i] = 10 * s.particles.x[a][i];
    const constitutive::Material rubber{
        "solid", 1000, std::make_shared<constitutive::NeoHookean>(constitutive::ElasticModuli{1e6, 0.3})};
    run(s, sceneOf(rubber, StressUpdate::USF), "uGIMP", 1, 1e-3);
    const auto& p = s.particles;
    alignas(64) constitutive::TensorLanes<2> F;
    for (int k = 0; k < 4; ++k)
        for (int l = 0; l < lanes; ++l)
            F[k][l] = p.F[k][std::size_t(std::min<Index>(l, p.size() - 1))];
    alignas(64) double factor[lanes];
    rubber.law->hyperelastic()->waveFactor(F, factor);
    CHECK(s.particles.volume[20] > 1.01 * s.particles.volume0[20]);
    CHECK(s.largestJacobian == std::max(1.0, *std::max_element(factor, factor + lanes)));
}

TEST_CASE("particles that leave the grid or are no longer finite end the run by name")
{
    auto s =
        scenes::seedBlock({.corner = {1, 1, 0}, .spacing = 0.25, .h = 0.5, .cells = {4, 4, 1}, .velocity = {50, 0, 0}});
    const auto scene = sceneOf(scenes::elastic(1e6, 0.3), StressUpdate::MUSL);
    CHECK_THROWS_WITH(run(s, scene, "uGIMP", 100, 1e-3), Catch::Contains("particle 0") &&
                                                             Catch::Contains("outside the grid") &&
                                                             Catch::Contains("step ") && Catch::Contains("gridDict"));
    auto bad = scenes::seedBlock({.corner = {1, 1, 0}, .n = {2, 2, 1}, .spacing = 0.25, .h = 0.5, .cells = {8, 8, 1}});
    bad.particles.v[0][0] = std::nan("");
    CHECK_THROWS_AS(run(bad, scene, "uGIMP", 2, 1e-4), StepError);
}

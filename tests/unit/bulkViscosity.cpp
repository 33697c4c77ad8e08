// Bulk viscosity: the pressure of a uniform compression, nothing in expansion, books that close, the stability limit,
// a restart between two steps, bitwise nothing where it is absent.
#include "case/makeStepper.hpp"
#include "output/stateFile.hpp"
#include "stepping/timeStep.hpp"
#include "support/scenes.hpp"
#include "support/temporaryFolder.hpp"
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
stepping::Scene scene(std::optional<treatment::BulkViscosity> viscosity, StressUpdate update = StressUpdate::MUSL)
{
    stepping::Scene out;
    out.materials = {scenes::elastic(1e6, 0.3)};
    out.stressUpdate = update;
    out.bulkViscosity = viscosity;
    return out;
}
} // namespace

TEST_CASE("q of a uniform compression, none of an expansion")
{
    const double b1 = 0.3, b2 = 1.4, h = 1, rate = -2;
    for (const double sign : {1.0, -1.0})
    {
        auto s =
            scenes::seedBlock({.corner = {3.1, 3.3}, .n = {16, 16, 1}, .spacing = 0.5, .h = 1, .cells = {14, 14, 1}});
        auto& p = s.particles;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            p.v[0][i] = sign * rate * p.x[0][i];
        p.padLastChunk();
        const auto sc = scene(treatment::BulkViscosity{b1, b2});
        const auto after = treated::run(s, "uGIMP", sc, 1, 1e-6);
        const double c = sc.materials[0].waveSpeed();
        const double q = 1000 * h * (b1 * c * std::abs(rate) + b2 * b2 * h * rate * rate);
        double inside = 0;
        for (std::size_t i = 0; i < std::size_t(after.particles.size()); ++i)
        {
            const auto& of = after.particles;
            if (std::abs(of.x[0][i] - 7.1) < 1 && std::abs(of.x[1][i] - 7.3) < 1) // off the free edges
            {
                CHECK(of.bulkViscousStress[i] == Approx(sign > 0 ? -q : 0).epsilon(1e-4).margin(1e-9));
                inside += 1;
            }
        }
        CHECK(inside > 3);
        // the law saw nothing of it
        CHECK(std::abs(after.particles.stress[0][0]) < 1e-3 * q);
    }
}

TEST_CASE("what it takes is booked, with and without averages of volume change")
{
    for (const auto update : {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL})
        for (const int kind : {0, 1, 2, 3})
        {
            CAPTURE(int(update), kind);
            auto s = treated::block();
            treated::stir(s, 2);
            auto sc = scene(treatment::BulkViscosity{0.2, 1.5}, update);
            if (kind > 0)
                sc.treatment =
                    treated::averaged(treated::AveragingRegion::patch, 2, treated::AveragedPart::total, kind == 2);
            if (kind == 3)
                sc.treatment.averaging->viscosity = 0.1;
            sc.walls = {{"base", nodal::WallType::roller, 1, -1, 3, 0, true}};
            const auto after = treated::run(s, "uGIMP", sc, 200, 2e-3);
            const double whole = after.ledger.initialKineticEnergy;
            CHECK(after.ledger.bulkViscosityLoss > 0.01 * whole);
            CHECK(after.ledger.bulkViscosityLoss < whole);
            CHECK(treated::residual(after, sc) < 1e-10 * whole);
        }
}

TEST_CASE("energy stays bounded at the stability limit, which follows the coefficients")
{
    for (const auto update : {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL})
        for (const auto viscosity : {treatment::BulkViscosity{0.06, 1.2}, treatment::BulkViscosity{1, 0}})
        {
            CAPTURE(int(update), viscosity.linear);
            auto s = treated::block();
            treated::stir(s, 1e-3);
            const auto sc = scene(viscosity, update), plain = scene(std::nullopt, update);
            const auto stepper = cases::makeStepper("uGIMP", s, sc);
            stepping::beginLedger(s, sc.materials);
            const auto limit = stepping::stabilityLimit(*stepper, s, sc, true);
            const double xi =
                viscosity.linear + viscosity.quadratic * viscosity.quadratic * limit.speed / limit.waveSpeed;
            CHECK(limit.deltaT / stepping::stabilityLimit(*stepper, s, plain, true).deltaT ==
                  Approx(std::sqrt(1 + xi * xi) - xi).epsilon(1e-12));
            for (int n = 0; n < 2000; ++n)
                stepper->step(limit.deltaT);
            const auto t = stepping::totals(s, sc.materials);
            CHECK(t.kineticEnergy + t.strainEnergy < s.ledger.initialKineticEnergy);
        }
}

TEST_CASE("a restart from a file goes on bitwise; without the word there is no column")
{
    auto s = treated::block();
    treated::stir(s, 2);
    const auto sc = scene(treatment::BulkViscosity{});
    const auto through = treated::run(s, "uGIMP", sc, 30, 2e-3);
    const auto half = treated::run(s, "uGIMP", sc, 13, 2e-3);
    const tests::TemporaryFolder folder;
    output::writeState(folder.path() / "1", half);
    const auto rest = treated::run(output::readState(folder.path() / "1" / "state.h5"), "uGIMP", sc, 17, 2e-3);
    for (int a = 0; a < 2; ++a)
        CHECK(rest.particles.v[a] == through.particles.v[a]);
    CHECK(rest.ledger.bulkViscosityLoss == through.ledger.bulkViscosityLoss);
    const auto without = treated::run(half, "uGIMP", scene(std::nullopt), 1, 2e-3);
    CHECK(half.particles.has(&state::Particles::bulkViscousStress));
    CHECK_FALSE(without.particles.has(&state::Particles::bulkViscousStress));
}

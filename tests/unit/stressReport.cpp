// What stressQuality says of a state: against another case's field, of energy, in rows and tables.
#include "case/stressReport.hpp"
#include "base/error.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "output/ledgerEntries.hpp"
#include "support/particleLattice.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace mpm;
using namespace mpm::smoothing;
using namespace mpm::test;

TEST_CASE("against another case: a known offset and a known noise come out as they are, for every shape")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapeNames())
        {
            INFO(dim << " " << shape);
            // ours lies well inside the other, which has half the cells' size: there Eq. 11 keeps linear fields
            auto ours = lattice(dim, 3, 0.5, false, {1, 1, 1});
            auto other = lattice(dim, 14, 0.25, false, {0, 0, 0});
            const auto field = [](const state::Particles& p, std::size_t i) {
                return -1e5 + 2e4 * p.x[0][i] + 3e4 * p.x[1][i];
            };
            for (std::size_t i = 0; i < std::size_t(other.particles.size()); ++i)
                other.particles.stress[1][i] = field(other.particles, i);
            const auto raw = valuesOf(
                ours, [&](std::size_t i) { return field(ours.particles, i) + 700 + 2400 * signOfParticle(ours, i); });
            const auto smoothed = valuesOf(ours, [&](std::size_t i) { return field(ours.particles, i) - 300; });
            const auto reference = ReferenceField(other, shape, 1).at(ours.particles);
            for (std::size_t i = 0; i < reference.size(); ++i)
                CHECK(reference[i] == Approx(field(ours.particles, i)).epsilon(1e-10));
            const auto found = compare(ours.particles, raw, smoothed, reference);
            CHECK(found.raw == Approx(2500)); // 700^2 + 2400^2
            CHECK(found.rawByMass == Approx(2500));
            CHECK(found.smoothed == Approx(300));
            CHECK(found.massShare == Approx(1));
            double square = 0;
            for (const double value : reference)
                square += value * value;
            CHECK(found.reference == Approx(std::sqrt(square / double(reference.size()))));
        }
}

TEST_CASE("what the other case has no material for is not compared, and said")
{
    auto ours = lattice(2, 8, 0.5);    // [0, 4] x [0, 4]
    auto other = lattice(2, 16, 0.25); // the same square
    for (const auto* shape : {"linear", "uGIMP", "cubicBSpline"})
    {
        const auto all = ReferenceField(other, shape, 0).at(ours.particles);
        const auto nothing = std::vector<double>(all.size(), 0.0);
        CHECK(compare(ours.particles, nothing, nothing, all).massShare == 1); // right up to its faces and corners
    }
    auto half = lattice(2, 8, 0.25, false, {2, 2, 0}); // a quarter of it
    half.grid.origin = {0, 0, 0};
    half.grid.cells = {16, 16, 1};
    const auto some = ReferenceField(half, "linear", 0).at(ours.particles);
    const auto found = compare(ours.particles, std::vector<double>(256, 2.0), std::vector<double>(256, 3.0), some);
    CHECK(found.massShare == Approx(0.25));
    CHECK(found.raw == Approx(2));
    half.grid.cells = {12, 12, 1}; // and what lies out of its grid neither
    for (std::size_t i = 0; i < std::size_t(half.particles.size()); ++i)
        for (std::size_t a = 0; a < 2; ++a)
            half.particles.x[a][i] -= 1;
    CHECK(compare(ours.particles, std::vector<double>(256, 2.0), std::vector<double>(256, 3.0),
                  ReferenceField(half, "linear", 0).at(ours.particles))
              .massShare == Approx(0.25));
    for (std::size_t i = 0; i < std::size_t(ours.particles.size()); ++i)
        ours.particles.x[0][i] += 100;
    const auto none = ReferenceField(half, "linear", 0).at(ours.particles);
    const auto apart = compare(ours.particles, std::vector<double>(256, 2.0), std::vector<double>(256, 3.0), none);
    CHECK(apart.massShare == 0);
    CHECK(std::isnan(apart.raw));
    CHECK_THROWS_WITH(ReferenceField(half, "linear", 0).at(lattice(3, 2, 1).particles),
                      Catch::Contains("found a case of dimension 2, allowed 3"));
}

TEST_CASE("across a periodic side the other's field goes on")
{
    const auto ours = lattice(2, 6, 1, true);
    auto other = lattice(2, 12, 0.5, true);
    const auto& p = other.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        other.particles.stress[1][i] = std::sin(2 * M_PI * p.x[0][i] / 6);
    for (const auto* shape : {"linear", "uGIMP", "quadraticBSpline", "cubicBSpline"})
    {
        const auto field = ReferenceField(other, shape, 1).at(ours.particles);
        double worst = 0;
        for (std::size_t i = 0; i < field.size(); ++i)
            worst = std::max(worst, std::abs(field[i] - std::sin(2 * M_PI * ours.particles.x[0][i] / 6)));
        CHECK(worst < 0.1); // what smoothing over cells of a twelfth of the wave takes; nan is not less
    }
}

TEST_CASE("energy of remedies over the energy released")
{
    state::Ledger ledger;
    CHECK(cases::remedyLoss(ledger).total == 0);
    ledger.initialStrainEnergy = 300;
    ledger.initialKineticEnergy = 100;
    ledger.transferLoss = 8;
    CHECK(cases::remedyLoss(ledger).released == 400);
    CHECK(cases::remedyLoss(ledger).transfer == Approx(0.02));
    ledger.gravityWork = 700;
    ledger.tractionWork = 200;
    ledger.bodyForceWork = -100;
    const auto loss = cases::remedyLoss(ledger);
    CHECK(loss.released == 800);
    CHECK(loss.transfer == Approx(0.01));
    CHECK(loss.total == 0); // transfer takes energy in the plain scheme too
    // the ledger's entries by their names, as far as it has them
    std::set<std::string> there;
    output::forEachLedgerEntry(ledger, [&](const char* name, auto& value, const char*) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
            if (const std::string word = name;
                word == "relaxationLoss" || word == "averagingLoss" || word == "viscosityLoss" || word == "gapWork")
            {
                value = word == "gapWork" ? -4 : 8;
                there.insert(word);
            }
    });
    const auto taken = cases::remedyLoss(ledger);
    CHECK(taken.relaxation == Approx(there.count("relaxationLoss") * 0.01));
    CHECK(taken.averaging == Approx(there.count("averagingLoss") * 0.01));
    CHECK(taken.viscosity == Approx(there.count("viscosityLoss") * 0.01));
    CHECK(taken.gap == Approx(there.count("gapWork") * -0.005));
    CHECK(taken.total == Approx(taken.relaxation + taken.averaging + taken.viscosity - taken.gap));
}

TEST_CASE("a report of a heap at rest, and its row")
{
    const auto law =
        std::make_shared<constitutive::MohrCoulomb>(constitutive::MohrCoulombParameters{{20e6, 0.42}, 1e3, 42, 0});
    for (const int dim : {2, 3})
    {
        auto state = lattice(dim, 6, 0.5);
        auto& p = state.particles;
        const std::size_t up = dim == 3 ? 2 : 1;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                p.stress[c][i] = (c == up ? 1 : 0.7) * -9800 * (3 - p.x[up][i]);
        Vector3 g{};
        g[up] = -9.8;
        const cases::StressReporting with{"uGIMP", g, {{"soil", 1000, law}}, 0, "uGIMP"};
        const auto report = cases::stressReport(state, with, &state);
        CHECK(report.quality.axis == int(up));
        CHECK(report.quality.noise == Approx(report.quality.noiseFloor));
        CHECK(report.noise.own[up] == report.quality.noise);
        CHECK(report.checkerboard.share < 1e-20);
        CHECK(report.admissibility.yieldViolation == 0);
        REQUIRE(report.against);
        CHECK(report.against->massShare == 1);
        for (const bool against : {false, true})
        {
            const auto names = cases::stressReportColumns(dim, against);
            const auto row = cases::stressReportRow(report, against);
            REQUIRE(names.size() == row.size());
            CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
            CHECK(std::vector<std::string>(names.begin(), names.begin() + 6) ==
                  std::vector<std::string>{"time", "noiseYY", "overburdenCorrelation", "overburdenRmsError",
                                           "volumeError", "remedyEnergyLoss"});
            const auto at = [&](const std::string& name) {
                const auto found = std::find(names.begin(), names.end(), name);
                REQUIRE(found != names.end());
                return row[std::size_t(found - names.begin())];
            };
            CHECK(at("noiseYY") == report.noise.own[1]);
            CHECK(at("noiseVertical") == report.quality.noise);
            CHECK(at("overburdenCorrelation") == Approx(1));
            CHECK(at("overburdenRmsError") < 1e-6);
            CHECK(at("particles") == double(p.size()));
            CHECK(std::vector<std::string>(names.end() - 3, names.end()) ==
                  std::vector<std::string>{"noiseBeyondFilter", "noiseFloorOfField", "viscosityLoss"});
            CHECK(at("noiseBeyondFilter") == report.filtered.beyondFilter);
            CHECK(at("noiseFloorOfField") == report.filtered.floorOfField);
            CHECK(at("noiseBeyondFilter") < 0.8 * at("noiseYY")); // nothing but a linear field: all is floor
            CHECK(at("noiseFloorOfField") == Approx(at("noiseYY")).epsilon(0.5));
            if (against)
                CHECK(at("relativeErrorAgainstRaw") == Approx(at("errorAgainstRaw") / report.against->reference));
        }
        CHECK(cases::stressReportColumns(3, true).size() == cases::stressReportColumns(2, true).size() + 4);
        cases::StressReportTables tables(true);
        tables.row(report, "0.5");
        CHECK_THAT(tables.text(), Catch::Contains(dim == 3 ? "sigma_zz" : "sigma_yy") && Catch::Contains("\n 0.5 "));
    }
}

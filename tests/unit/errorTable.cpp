// The table of accuracyCost as mpmSolve reads it: which rows count, what error a setting will have, what is refused.
#include "case/errorTable.hpp"
#include "base/error.hpp"
#include "case/pickSetting.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

using namespace mpm;
using namespace mpm::cases;
using Catch::Matchers::Contains;

namespace
{
const std::string header = "row,cellSize,particlesPerCell,shape,transfer,order,picRate,stressUpdate,staggeredStart,"
                           "timeIntegration,splitting,courant,deltaT,status,errorMeasure,error,referenceError,"
                           "cpuSeconds,particleSteps,nsPerParticleStep,endTime,machine,version,more\n";

/// One line: cells that matter here, the others those of a plain run.
std::string line(const std::string& name, const std::string& h, const std::string& shape, const std::string& error,
                 const std::string& measure = "runOut", const std::string& status = "done")
{
    return name + "," + h + ",2," + shape + ",FLIP,,0,MUSL,no,symplecticEuler,off,0.5,0.001," + status + "," + measure +
           "," + error + ",1e-6,2,1e6,80,1,here,0.1.0,\n";
}

ErrorTable table(const tests::TemporaryFolder& folder, const std::string& rows, const std::string& measure = {})
{
    std::ofstream(folder / "accuracyCost.csv", std::ios::binary) << header << rows;
    return ErrorTable(folder / "accuracyCost.csv", measure);
}

RunSetting plain(double h, const std::string& shape = "uGIMP")
{
    return {h, 2, shape, "FLIP", "", "0", "MUSL", "no", "symplecticEuler", false, 0.5, 0.001};
}
} // namespace

TEST_CASE("rows that were done, of the measure asked for, or of the first")
{
    const tests::TemporaryFolder folder;
    const std::string rows = line("a", "0.1", "uGIMP", "0.01") + line("a", "0.1", "uGIMP", "0.3", "pressure") +
                             line("b", "0.2", "uGIMP", "", "runOut", "failed") + line("c", "0.2", "linear", "0.04");
    const auto first = table(folder, rows);
    CHECK(first.measure() == "runOut");
    REQUIRE(first.rows().size() == 2);
    CHECK(first.rows()[1].name == "c");
    CHECK(first.rows()[1].setting.shape == "linear");
    const auto second = table(folder, rows, "pressure");
    REQUIRE(second.rows().size() == 1);
    CHECK(second.rows()[0].error == 0.3);
    CHECK_THROWS_WITH(table(folder, rows, "presure"), Contains("did you mean 'pressure'?"));
}

TEST_CASE("the error of a setting: its own row, an order, or the row most like it")
{
    const tests::TemporaryFolder folder;
    std::string rows;
    for (const double h : {0.1, 0.2, 0.4}) // order 1.5 exactly
        rows += line(std::to_string(h), std::to_string(h), "uGIMP", std::to_string(0.3 * std::pow(h, 1.5)));
    rows += line("one", "0.1", "cpGIMP", "0.005");
    const auto t = table(folder, rows);
    const auto own = t.expect(plain(0.2));
    REQUIRE(own);
    CHECK(own->error == Approx(0.3 * std::pow(0.2, 1.5)).epsilon(1e-4));
    CHECK_FALSE(own->order);
    const auto between = t.expect(plain(0.15));
    REQUIRE(between->order);
    CHECK(*between->order == Approx(1.5).epsilon(1e-3));
    CHECK(between->error == Approx(0.3 * std::pow(0.15, 1.5)).epsilon(1e-3));
    CHECK_THAT(between->basis, Contains("interpolated"));
    CHECK_THAT(t.expect(plain(0.05))->basis, Contains("extrapolated"));
    const auto like = t.expect(plain(0.2, "cpGIMP"));
    CHECK(like->error == 0.005);
    CHECK_THAT(like->basis, Contains("too few rows") && Contains("one"));
    CHECK_THAT(t.expect(plain(0.2, "linear"))->basis, Contains("no row has this method"));
    CHECK_FALSE(table(folder, "").expect(plain(0.2)));
}

TEST_CASE("an error below that of its reference is not believed")
{
    AccuracyRow row;
    row.error = 1e-9;
    row.referenceError = 0.02;
    CHECK(row.bound() == 0.04);
    row.error = 0.05;
    CHECK(row.bound() == 0.05);
}

TEST_CASE("words a row changes, and those it need not")
{
    AccuracyRow row;
    row.setting = plain(0.2, "cpGIMP");
    row.setting.transfer = "XPIC";
    row.setting.order = "3";
    row.setting.deltaT = 0.0005;
    PresentCase present;
    present.setting = plain(0.2);
    present.setting.picRate = "2";
    present.setting.splitting = true;
    CHECK(overridesFor(row, present, "-withinTime 60").describe() ==
          "shape cpGIMP, transfer XPIC, order 3, no picRate, no splitting, deltaT 5e-04");
    present.adjustable = true;
    row.setting.courant = 0.25;
    CHECK_THAT(overridesFor(row, present, "").describe(), Contains("maxCo 0.25") && !Contains("deltaT"));
    row.setting = present.setting;
    row.setting.picRate = "2.0";
    CHECK(overridesFor(row, present, "").empty());
}

TEST_CASE("mistakes in a table have their place")
{
    const tests::TemporaryFolder folder;
    CHECK_THROWS_WITH(ErrorTable(folder / "none.csv"), Contains("run accuracyCost in this case first"));
    CHECK_THROWS_WITH(table(folder, line("a", "small", "uGIMP", "0.1")), Contains("accuracyCost.csv:2: cellSize"));
    CHECK_THROWS_WITH(table(folder, line("a", "0", "uGIMP", "0.1")), Contains("a number > 0"));
    CHECK_THROWS_WITH(table(folder, line("a", "0.1", "uGIMP", "-0.1")), Contains("a number >= 0"));
    std::ofstream(folder / "other.csv") << "row,cellSize\na,0.1\n";
    CHECK_THROWS_WITH(ErrorTable(folder / "other.csv"), Contains("found no column shape"));
}

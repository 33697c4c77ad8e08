/// Tables of comma-separated values: quoting, places of mistakes, and passing cells through untouched.
#include "base/csvTable.hpp"
#include "base/error.hpp"
#include "constitutive/trialTable.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <fstream>

using namespace mpm;
using Catch::Matchers::Contains;

namespace
{
CsvTable table(const tests::TemporaryFolder& folder, const std::string& text)
{
    std::ofstream(folder / "table.csv", std::ios::binary) << text;
    return CsvTable::read(folder / "table.csv");
}
} // namespace

TEST_CASE("quoted cells, Windows line ends, comments and empty lines")
{
    const tests::TemporaryFolder folder;
    const auto t = table(
        folder, "# made by hand, with commas\nname, x\r\n\"a, \"\"b\"\"\",1\r\n\n\"two\nlines\", -2.5e3 \nlast,+3");
    REQUIRE(t.columns() == std::vector<std::string>{"name", "x"});
    REQUIRE(t.rows().size() == 3);
    CHECK(t.rows()[0].cells[0] == "a, \"b\"");
    CHECK(t.rows()[0].line == 3);
    CHECK(t.rows()[1].cells[0] == "two\nlines");
    CHECK(t.rows()[2].line == 7);
    CHECK(t.number(t.rows()[1], 1) == -2500);
    CHECK(t.number(t.rows()[2], 1) == 3);

    // what is written reads back to the same cells
    const auto again = table(folder, t.text());
    REQUIRE(again.rows().size() == 3);
    for (int i = 0; i < 3; ++i)
        CHECK(again.rows()[i].cells == t.rows()[i].cells);
}

TEST_CASE("mistakes are named with file and line")
{
    const tests::TemporaryFolder folder;
    CHECK_THROWS_WITH(table(folder, "a,b\n1,2\n1\n"), Contains("table.csv:3") && Contains("1 cells") && Contains("2"));
    CHECK_THROWS_WITH(table(folder, "a,a\n"), Contains("table.csv:1") && Contains("twice"));
    CHECK_THROWS_WITH(table(folder, "a,b\n1,\"2\n"), Contains("table.csv:2") && Contains("quote"));
    CHECK_THROWS_WITH(table(folder, ""), Contains("empty"));
    CHECK_THROWS_WITH(CsvTable::read(folder / "none.csv"), Contains("none.csv"));
    CHECK_THROWS_WITH(CsvTable::read(folder.path()), Contains("readable"));
    const auto t = table(folder, "alpha,beta\n1,nan\n1e999,0x10\n");
    CHECK_THROWS_WITH(t.column("beat"), Contains("beta") && Contains("table.csv"));
    CHECK_THROWS_WITH(t.number(t.rows()[0], 1), Contains("table.csv:2: beta: found 'nan'"));
    CHECK_THROWS_AS(t.number(t.rows()[1], 0), InputError);
    CHECK_THROWS_AS(t.number(t.rows()[1], 1), InputError);
}

TEST_CASE("trial stresses are returned row by row, other columns pass, own columns are replaced")
{
    const tests::TemporaryFolder folder;
    const std::string header = "id,E_Pa,nu,c_Pa,phi_deg,psi_deg,tr_xx,tr_yy,tr_zz,tr_xy,tr_yz,tr_zx";
    auto t = table(folder, header + ",region\n\"a,b\",20e6,0.3,10e3,0,0,-100e3,-180e3,-102e3,0,0,0,old\n");
    constitutive::returnTrials(t);
    const auto& row = t.rows()[0];
    CHECK(row.cells[0] == "a,b");
    CHECK(row.cells[t.column("region")] == "edge s1=s2 (l1)");
    CHECK(t.number(row, t.column("ret_xx")) == Approx(-362e3 / 3).epsilon(1e-14));
    CHECK(t.number(row, t.column("ret_yy")) == Approx(-422e3 / 3).epsilon(1e-14));
    CHECK(t.columns().size() == 12 + 7);

    const auto refused = [&](const std::string& cells) {
        auto bad = table(folder, header + "\n1,20e6,0.3,10e3,30,0,0,0,0,0,0,0\n2," + cells + "\n");
        constitutive::returnTrials(bad);
    };
    CHECK_THROWS_WITH(refused("0,0.3,1,30,0,0,0,0,0,0,0"), Contains("table.csv:3: E_Pa: found '0', allowed is > 0"));
    CHECK_THROWS_WITH(refused("1,0.5,1,30,0,0,0,0,0,0,0"), Contains("nu: found '0.5'") && Contains("(-1, 0.5)"));
    CHECK_THROWS_WITH(refused("1,0.3,-1,30,0,0,0,0,0,0,0"), Contains("c_Pa") && Contains(">= 0"));
    CHECK_THROWS_WITH(refused("1,0.3,1,90,0,0,0,0,0,0,0"), Contains("phi_deg") && Contains("[0, 90)"));
    CHECK_THROWS_WITH(refused("1,0.3,1,30,31,0,0,0,0,0,0"), Contains("psi_deg") && Contains("[0, 30]"));
    CHECK_THROWS_WITH(refused("1,0.3,1,30,0,0,a,0,0,0,0"), Contains("tr_yy: found 'a'"));
    auto missing = table(folder, "E_Pa,nu\n1,0.3\n");
    CHECK_THROWS_WITH(constitutive::returnTrials(missing), Contains("c_Pa"));
}

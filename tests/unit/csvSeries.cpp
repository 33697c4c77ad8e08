#include "output/csvSeries.hpp"
#include "base/error.hpp"
#include "support/fileContents.hpp"
#include "support/fullDisk.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstring>
#include <fstream>

using namespace mpm;
using mpm::output::CsvSeries;
using mpm::tests::contents;
using mpm::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace
{
const std::vector<std::string> columns{"time", "energy"};
} // namespace

TEST_CASE("numbers read back to the same bits")
{
    for (double value : {0.1, 1.0 / 3.0, 1e-300, -0.0, 6.02214076e23, 1800.0, std::nextafter(0.3, 1.0), HUGE_VAL})
    {
        const double back = std::strtod(output::shortest(value).c_str(), nullptr);
        CHECK(std::memcmp(&back, &value, sizeof value) == 0);
    }
    CHECK(output::shortest(1800) == "1800");
    CHECK(output::shortest(0.1) == "0.1");
    CHECK(output::shortest(std::nan("")) == "nan");
}

TEST_CASE("every row is in the file at once")
{
    TemporaryFolder folder;
    const fs::path file = folder / "postProcessing/history.csv";
    CsvSeries series(file, columns);
    CHECK(contents(file) == "time,energy\n");
    CHECK_FALSE(series.lastTime());
    series.write({0, 1.5});
    CHECK(contents(file) == "time,energy\n0,1.5\n");
    series.write({0.1, -2e-20});
    CHECK(contents(file) == "time,energy\n0,1.5\n0.1,-2e-20\n");
    CHECK(series.lastTime() == 0.1);
    CHECK_THROWS_AS(series.write({0.2}), InputError);
}

TEST_CASE("a series continued at a time loses what came later")
{
    TemporaryFolder folder;
    const fs::path file = folder / "history.csv";
    double time = 0;
    {
        CsvSeries series(file, columns);
        for (int i = 0; i < 10; ++i, time += 0.1)
            series.write({time, double(i)});
    }
    const std::string before = contents(file);
    SECTION("a restart at a written time, wherever its last bit stands")
    {
        double restart = 0;
        for (int i = 0; i < 3; ++i)
            restart += 0.1;
        CsvSeries series(file, columns, std::nextafter(restart, 0.0));
        CHECK(contents(file) == "time,energy\n0,0\n0.1,1\n0.2,2\n0.30000000000000004,3\n");
        CHECK(series.lastTime() == restart);
        series.write({0.35, 7});
        CHECK(contents(file) == "time,energy\n0,0\n0.1,1\n0.2,2\n0.30000000000000004,3\n0.35,7\n");
        CHECK_FALSE(fs::exists(folder / "history.csv.partial"));
    }
    SECTION("a restart at zero keeps the first row only")
    {
        CsvSeries series(file, columns, 0.0);
        CHECK(contents(file) == "time,energy\n0,0\n");
    }
    SECTION("beyond the end nothing is lost")
    {
        CsvSeries series(file, columns, 5.0);
        CHECK(contents(file) == before);
    }
    SECTION("an unfinished last line goes")
    {
        std::ofstream(file, std::ios::app) << "1.0,3";
        CsvSeries series(file, columns, 5.0);
        CHECK(contents(file) == before);
    }
    SECTION("anew, everything goes")
    {
        CsvSeries series(file, columns);
        CHECK(contents(file) == "time,energy\n");
    }
    SECTION("another header is refused and the file stays")
    {
        CHECK_THROWS_WITH(CsvSeries(file, {"time", "mass"}, 0.5),
                          Catch::Contains("history.csv:1: other columns") && Catch::Contains("time,mass"));
        CHECK(contents(file) == before);
    }
    SECTION("a spoilt row is named")
    {
        std::ofstream(file, std::ios::app) << "oops,1\n0.95,1\n";
        CHECK_THROWS_WITH(CsvSeries(file, columns, 0.5), Catch::Contains("history.csv:12"));
    }
}

TEST_CASE("a continued series without a file begins one, and a folder in its place is refused")
{
    TemporaryFolder folder;
    CsvSeries series(folder / "a.csv", columns, 0.5);
    CHECK(contents(folder / "a.csv") == "time,energy\n");
    fs::create_directories(folder / "b.csv/c");
    CHECK_THROWS_AS(CsvSeries(folder / "b.csv", columns), InputError);
    CHECK_THROWS_AS(CsvSeries(folder / "a.csv/d.csv", columns), InputError);
}

TEST_CASE("a full disk is an error, not a silent gap")
{
    TemporaryFolder folder;
    const bool refused = tests::refusedOnFullDisk(2000, [&] {
        CsvSeries series(folder / "history.csv", columns);
        for (int i = 0; i < 1000; ++i)
            series.write({double(i), 0.1});
    });
    CHECK(refused);
}

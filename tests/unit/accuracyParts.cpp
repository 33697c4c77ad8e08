// The parts of accuracyCost: changing texts, the matrix, orders, fronts, references, keys.
#include "base/error.hpp"
#include "case/accuracyAnalysis.hpp"
#include "case/accuracyCase.hpp"
#include "case/accuracyFit.hpp"
#include "case/accuracyProcess.hpp"
#include "case/accuracyRun.hpp"
#include "case/accuracyText.hpp"
#include "support/fileContents.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <fstream>
#include <set>

using namespace mpm;
using namespace mpm::cases;
using dictionary::Dictionary;
namespace fs = std::filesystem;

namespace
{
std::vector<MatrixRow> matrix(const std::string& text)
{
    const auto dict = Dictionary::fromText(text, "accuracyCostDict");
    const auto rows = readMatrix(dict);
    dict.rejectUnread();
    return rows;
}

const MatrixRow& rowNamed(const std::vector<MatrixRow>& rows, const std::string& name)
{
    for (const auto& row : rows)
        if (row.name == name)
            return row;
    FAIL("no row " << name);
    return rows.front();
}

/// A copy of the collapsing column.
void copyColumn(const fs::path& to)
{
    for (const char* part : {"constant", "geometry", "system"})
        fs::copy(fs::path(MPM_SOURCE_DIR) / "cases/collapsingSoilColumn" / part, to / part,
                 fs::copy_options::recursive);
}

void change(const fs::path& file, const std::string& word, const std::string& value)
{
    const auto text = replaceEntry(tests::contents(file), word, value);
    std::ofstream(file, std::ios::binary) << text;
}
} // namespace

TEST_CASE("an entry is replaced in the text and all else stays")
{
    const std::string text = "// cellSize 1;\nFoamFile { cellSize 7; }\n"
                             "note \"cellSize 2; {\"; /* cellSize 3; */\n"
                             "cellSize  4;   // [m] of cellSize 5;\nlist (a { cellSize 6; } b);\nlast 1;\n";
    CHECK(entryText(text, "cellSize") == "4");
    const auto changed = replaceEntry(text, "cellSize", "0.25");
    CHECK(changed.find("\ncellSize  0.25;   // [m] of cellSize 5;\n") != std::string::npos);
    CHECK(replaceEntry(changed, "cellSize", "4") == text);
    CHECK_FALSE(entryText(text, "cell"));
    CHECK(replaceEntry("a 1;", "b", "2") == "a 1;\nb 2;\n");
    CHECK(replaceEntry("d { x 1; }\ne 2;\n", "d", "3") == "d 3;\ne 2;\n");
}

TEST_CASE("an entry or a dictionary is removed with its line")
{
    CHECK(removeEntry("a 1;\nsplitting\n{\n  on { x 1; } // }\n}\nb 2;\n", "splitting") == "a 1;\nb 2;\n");
    CHECK(removeEntry("a 1; b 2; c 3;\n", "b") == "a 1;  c 3;\n");
    CHECK(removeEntry("a 1;\n  b 2;\nc 3;\n", "b") == "a 1;\nc 3;\n");
    CHECK(removeEntry("a 1;\n", "b") == "a 1;\n");
    CHECK(removeEntry("a 1;\n", "a").empty());
}

TEST_CASE("axes are multiplied")
{
    const auto rows =
        matrix("axes { cellSize (0.4 0.2); shape (uGIMP linear); courant (0.1 0.2 0.4); stressUpdate MUSL; }");
    REQUIRE(rows.size() == 12);
    std::set<std::string> names;
    for (const auto& row : rows)
    {
        names.insert(row.name);
        CHECK(row.setting.size() == 4);
        CHECK(row.method == row.setting.at("shape")); // what is not swept is in no name, resolution makes no curve
    }
    CHECK(names.size() == 12);
    CHECK(rowNamed(rows, "linear-cellSize_0.2-courant_0.1").setting ==
          Setting{{"cellSize", "0.2"}, {"shape", "linear"}, {"courant", "0.1"}, {"stressUpdate", "MUSL"}});
    CHECK(matrix("").size() == 1);
    CHECK(matrix("").front().name == "as_in_the_case");
}

TEST_CASE("methods are crossed with axes, their own values go first")
{
    const auto rows =
        matrix("axes { cellSize (0.4 0.2); courant (0.2 0.4); }"
               "methods { A { shape linear; deltaT 1e-3; } B { cellSize (0.1); particlesPerCell (2 3); } }");
    REQUIRE(rows.size() == 2 + 4);
    CHECK(rowNamed(rows, "A-cellSize_0.2").setting ==
          Setting{{"cellSize", "0.2"}, {"shape", "linear"}, {"deltaT", "0.001"}});
    const auto& b = rowNamed(rows, "B_particlesPerCell_3-courant_0.4");
    CHECK(b.method == "B particlesPerCell 3");
    CHECK(b.setting == Setting{{"cellSize", "0.1"}, {"particlesPerCell", "3"}, {"courant", "0.4"}});
}

TEST_CASE("what a matrix may not say")
{
    for (const std::string text :
         {"axes { shape (uGIMP uGMIP); }", "axes { cellSize (0.4 0.4); }", "axes { cellSize (0.4 -1); }",
          "axes { particlesPerCell (1.5); }", "axes { courant 0.1; deltaT 1e-3; }", "axes { shape (); }",
          "methods { A { shape linear; } B { shape linear; } }", "axes { sape (linear); }",
          "methods { A { splitting perhaps; } }"})
    {
        INFO(text);
        CHECK_THROWS_AS(matrix(text), InputError);
    }
    CHECK_THROWS_WITH(matrix("axes { shape (uGMIP); }"), Catch::Contains("did you mean 'uGIMP'?"));
}

TEST_CASE("families of rows")
{
    const Setting a{{"cellSize", "1"}, {"courant", "0.1"}, {"shape", "linear"}};
    Setting b{{"cellSize", "1"}, {"courant", "0.4"}, {"shape", "linear"}};
    CHECK(sameButTimeStep(a, b));
    CHECK_FALSE(sameButCellSize(a, b));
    b = {{"cellSize", "2"}, {"courant", "0.1"}, {"shape", "linear"}};
    CHECK(sameButCellSize(a, b));
    CHECK_FALSE(sameButTimeStep(a, b));
}

TEST_CASE("orders are slopes in logarithms")
{
    CHECK(*fitOrder({1, 2, 4}, {3, 12, 48}) == Approx(2));
    CHECK(*fitOrder({0.1, 0.4}, {5, 5}) == Approx(0).margin(1e-12));
    CHECK(*fitOrder({1, 2, 4, 8}, {3, NAN, 0, 3 * 8}) == Approx(1)); // what is no error does not count
    CHECK_FALSE(fitOrder({1}, {1}));
    CHECK_FALSE(fitOrder({2, 2}, {1, 3}));
}

TEST_CASE("the Pareto front")
{
    const std::vector<double> prices{1, 2, 3, 4, 5, 2, 0.5}, errors{10, 5, 5, 1, 2, 7, NAN};
    CHECK(paretoFront(prices, errors) == std::vector<bool>{true, true, false, true, false, false, false});
    CHECK(paretoFront({1, 1}, {2, 2}) == std::vector<bool>{true, true});
    CHECK(*cheapestWithin(prices, errors, 6) == 1);
    CHECK(*cheapestWithin(prices, errors, 1) == 3);
    CHECK_FALSE(cheapestWithin(prices, errors, 0.5));
}

TEST_CASE("Richardson's estimate is exact for C h^p")
{
    for (const double p : {0.7, 1.0, 2.0, 3.3})
    {
        const auto e = [&](double h) { return 0.3 * std::pow(h, p); };
        const auto estimate = richardson(0.1, 0.15, e(0.15) - e(0.1), 0.4, e(0.4) - e(0.1));
        REQUIRE(estimate);
        CHECK(estimate->order == Approx(p).epsilon(1e-6));
        CHECK(estimate->error == Approx(e(0.1)).epsilon(1e-6));
    }
    CHECK(richardson(1, 2, 0.5)->error == Approx(0.5));         // first order, if there is no third run
    CHECK(richardson(1, 2, 0.5, 4, 0.4)->order == Approx(0.5)); // no convergence: the lowest order, the largest error
    CHECK_FALSE(richardson(2, 1, 0.5));
}

TEST_CASE("a field is taken to other particles with second order, a linear one exactly")
{
    const auto lattice = [](int n, auto&& f) {
        Sample s;
        s.spacing = 1.0 / n;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                const Vector3 X{(i + 0.5) / n, (j + 0.5) / n, 0};
                s.X.push_back(X);
                s.values.push_back(f(X));
            }
        return s;
    };
    const auto linear = [](const Vector3& X) { return 3 + 2 * X[0] - X[1]; };
    const auto curved = [](const Vector3& X) { return std::sin(3 * X[0]) * std::cos(2 * X[1]); };
    const auto places = lattice(7, linear).X;
    const auto worst = [&](int n, auto&& f) {
        const auto fitted = fitAt(lattice(n, f), places);
        double error = 0;
        for (std::size_t i = 0; i < places.size(); ++i)
            error = std::max(error, std::abs(fitted[i] - f(places[i])));
        return error;
    };
    CHECK(worst(12, linear) < 1e-9);
    CHECK(worst(24, curved) < 0.02);
    CHECK(worst(12, curved) / worst(48, curved) > 8);
    CHECK_THROWS_AS(fitAt(lattice(4, linear), {{9, 9, 0}}), InputError);
}

TEST_CASE("rows of the column: steps, refusals, families")
{
    const tests::TemporaryFolder folder;
    copyColumn(folder.path());
    const CaseDirectory here(folder.path());
    const AccuracyCase base(here, false);
    const auto facts = [&](const Setting& setting) { return base.facts({"row", "method", setting}); };
    const double c = std::sqrt(51.0563e6 / 1000); // of E 20 MPa, nu 0.42: M = 51.06 MPa
    const auto asIs = facts({});
    CHECK(asIs.steps == 2500);
    CHECK(asIs.deltaT == Approx(1e-3));
    CHECK(asIs.courant == Approx(c * 1e-3 / (4.0 / 15)).epsilon(1e-4));
    CHECK(asIs.cells == 105 * 45);
    const auto fine = facts({{"cellSize", "0.2"}});
    CHECK(fine.courant == Approx(asIs.courant).epsilon(1e-3)); // the case's Courant number is kept
    CHECK(fine.deltaT * double(fine.steps) == Approx(2.5).epsilon(1e-14));
    CHECK(facts({{"courant", "0.5"}, {"cellSize", "0.4"}}).deltaT == Approx(0.5 * 0.4 / c).epsilon(1e-3));
    CHECK(fine.refused.empty());
    CHECK_THAT(facts({{"cellSize", "0.3"}}).refused, Catch::Contains("whole number of cells"));
    CHECK_THAT(facts({{"order", "2"}}).refused, Catch::Contains("transfer FLIP has none"));
    CHECK(facts({{"transfer", "APIC"}}).effective.count("picRate") == 0);
    CHECK(facts({{"transfer", "XPIC"}}).effective.at("order") == "2");
    CHECK(sameButCellSize(asIs.declared, fine.declared));
    CHECK(sameButTimeStep(facts({{"courant", "0.1"}}).declared, facts({{"courant", "0.2"}}).declared));
}

TEST_CASE("the folder of a row is the case with its own values")
{
    const tests::TemporaryFolder folder;
    copyColumn(folder.path());
    const CaseDirectory here(folder.path());
    const AccuracyCase base(here, false);
    const MatrixRow row{
        "fine", "", {{"cellSize", "0.2"}, {"shape", "linear"}, {"splitting", "off"}, {"transfer", "APIC"}}};
    base.make(row);
    const auto made = folder.path() / "accuracyCost/fine";
    const auto text = [&](const char* file) { return tests::contents(made / file); };
    CHECK(entryText(text("system/gridDict"), "cellSize") == "0.2");
    CHECK(entryText(text("system/mpmSchemes"), "shape") == "linear");
    CHECK_FALSE(entryText(text("system/mpmSchemes"), "splitting"));
    CHECK_FALSE(entryText(text("system/mpmSchemes"), "picRate")); // only FLIP has it
    CHECK(entryText(text("system/controlDict"), "writeInterval") == "2.5");
    CHECK_FALSE(entryText(text("system/controlDict"), "recordStrain"));
    CHECK(text("constant/g") == tests::contents(folder.path() / "constant/g"));
    CHECK(text("geometry/column.geo") == tests::contents(folder.path() / "geometry/column.geo"));
    for (const char* file : {"system/gridDict", "system/mpmSchemes", "system/controlDict", "system/seedParticlesDict"})
        CHECK_NOTHROW(Dictionary::readFile(made / file));
}

TEST_CASE("the key of a row changes with what its result depends on, and with nothing else")
{
    const tests::TemporaryFolder folder;
    copyColumn(folder.path());
    const CaseDirectory here(folder.path());
    const MatrixRow row{"row", "", {{"cellSize", "0.2"}}};
    const auto key = [&](bool storedTimes = false) { return AccuracyCase(here, storedTimes).key(row); };
    const auto before = key();
    CHECK(before.size() == 16);
    CHECK(key() == before);
    CHECK(key(true) != before);
    CHECK(AccuracyCase(here, false).key({"row", "", {{"cellSize", "0.4"}}}) != before);
    const auto append = [&](const char* file, const std::string& text) {
        std::ofstream(folder.path() / file, std::ios::app) << text;
    };
    append("system/controlDict", "// a remark\n");
    append("system/accuracyCostDict", "measures { }\n");
    CHECK(key() == before);
    change(folder.path() / "constant/g", "value", "(0 -9.7 0)");
    const auto lighter = key();
    CHECK(lighter != before);
    append("geometry/column.geo", "// 1\n");
    CHECK(key() != lighter);
}

TEST_CASE("a stored result holds for its key only")
{
    const tests::TemporaryFolder folder;
    copyColumn(folder.path());
    const CaseDirectory here(folder.path());
    const AccuracyCase base(here, false);
    const MatrixRow row{"row", "", {}};
    base.make(row);
    CHECK(storedResult(base, row, "k").status.empty());
    std::ofstream(base.rowFolder(row) / "result.csv")
        << "key,status,reason,cpuSeconds,wallSeconds,repeats,sideBySide,particles,steps,particleSteps,endTime,machine\n"
           "k,failed,\"yield, at step 3\",0,0,0,1,0,0,0,0,a machine\n";
    CHECK(storedResult(base, row, "k").status == "failed");
    CHECK(storedResult(base, row, "k").reason == "yield, at step 3");
    CHECK(storedResult(base, row, "other").status.empty());
    std::ofstream(base.rowFolder(row) / "result.csv") << "key,status\nk,do"; // no program leaves that, an editor may
    CHECK(storedResult(base, row, "k").status.empty());
}

TEST_CASE("a child process is waited for, measured, and ended when asked")
{
    const tests::TemporaryFolder folder;
    const auto log = folder / "log";
    const auto shell = [&](const std::string& script, const std::function<bool()>& stopped = {}) {
        return runProcess("/bin/sh", {"-c", script}, log, stopped);
    };
    CHECK(shell("echo $OMP_NUM_THREADS; echo '--> x: error: no'; echo last; exit 2").exitCode == 2);
    CHECK(tests::contents(log) == "1\n--> x: error: no\nlast\n");
    CHECK(errorInLog(log) == "no");
    CHECK(shell("kill -9 $$").exitCode == 128 + 9);
    const auto busy = shell("i=0; while [ $i -lt 100000 ]; do i=$((i + 1)); done");
    CHECK(busy.ended(0));
    CHECK(busy.cpuSeconds > 0);
    CHECK(busy.cpuSeconds < busy.wallSeconds + 0.05);
    CHECK(runProcess(folder / "nothing", {}, log, {}).exitCode == 127);
    CHECK(shell("sleep 30", [] { return true; }).exitCode == 128 + 15);
}

#include "case/caseDirectory.hpp"
#include "base/error.hpp"
#include "output/stateFile.hpp"
#include "support/sampleState.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

using namespace mpm;
using mpm::cases::CaseDirectory;
using mpm::cases::timeName;
using mpm::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace
{
/// A case with states at the given times.
void makeCase(const fs::path& folder, const std::vector<std::string>& times)
{
    fs::create_directories(folder / "system");
    fs::create_directories(folder / "constant");
    fs::create_directories(folder / "geometry");
    std::ofstream(folder / "system/controlDict") << "deltaT 1e-3;\n";
    for (const auto& time : times)
        output::writeState(folder / time, tests::sampleState(2, 3));
}

std::vector<std::string> names(const std::vector<cases::TimeFolder>& times)
{
    std::vector<std::string> out;
    for (const auto& time : times)
        out.push_back(time.name);
    return out;
}

using Names = std::vector<std::string>;
} // namespace

TEST_CASE("time names are the shortest at their precision")
{
    CHECK(timeName(0) == "0");
    CHECK(timeName(-1e-17) == "0");
    CHECK(timeName(0.25) == "0.25");
    CHECK(timeName(0.1 + 0.2) == "0.3");
    CHECK(timeName(2.0) == "2");
    CHECK(timeName(1e-5) == "1e-05");
    CHECK(timeName(123456.7) == "123457");
    CHECK(timeName(1234567) == "1.23457e+06");
    CHECK(timeName(1.0 / 3.0) == "0.333333");
    CHECK(timeName(1.0 / 3.0, 9) == "0.333333333");
}

TEST_CASE("times are the numbered folders with a state, in order of their value")
{
    TemporaryFolder folder;
    makeCase(folder.path(), {"10", "2", "0", "0.25", "1e-05"});
    fs::create_directories(folder / "3"); // no state inside
    fs::create_directories(folder / "nan");
    fs::create_directories(folder / "0x10");
    fs::create_directories(folder / "1.0backup");
    std::ofstream(folder / "7") << "a file";
    const CaseDirectory here(folder.path());
    CHECK(names(here.times()) == Names{"0", "1e-05", "0.25", "2", "10"});
    CHECK(here.firstTime().name == "0");
    CHECK(here.latestTime().name == "10");
    CHECK(here.latestTime().value == 10.0);
    CHECK(here.statePath("0.25") == folder / "0.25/state.h5");

    fs::rename(folder / "10", folder / "2.0");
    CHECK_THROWS_WITH(here.times(), Catch::Contains("same time"));
}

TEST_CASE("ranges select as in OpenFOAM")
{
    TemporaryFolder folder;
    makeCase(folder.path(), {"0", "0.5", "1", "1.5", "2", "2.5"});
    const CaseDirectory here(folder.path());
    CHECK(names(here.selectTimes("0:1")) == Names{"0", "0.5", "1"});
    CHECK(names(here.selectTimes(":0.7")) == Names{"0", "0.5"});
    CHECK(names(here.selectTimes("0.5,1,2:")) == Names{"0.5", "1", "2", "2.5"});
    CHECK(names(here.selectTimes("2: 0.5")) == Names{"0.5", "2", "2.5"});
    CHECK(names(here.selectTimes("1.1")) == Names{"1"});
    CHECK(names(here.selectTimes("2.7")) == Names{"2.5"});
    CHECK(names(here.selectTimes(":")).size() == 6);
    CHECK(here.nearestTime(1.4).name == "1.5");
    CHECK(names(here.selectTimes(std::nullopt, true)) == Names{"2.5"});
    CHECK(names(here.selectTimes(std::string("0"), false)) == Names{"0"});
    CHECK(here.selectTimes(std::nullopt, false).size() == 6);

    CHECK_THROWS_WITH(here.selectTimes("100"),
                      Catch::Contains("no time near 100") && Catch::Contains("0, 0.5, 1, 1.5"));
    CHECK_THROWS_WITH(here.selectTimes("0,3:"), Catch::Contains("no time in 3:") && Catch::Contains("2.5"));
    CHECK_THROWS_WITH(here.selectTimes("0.6:0.9"), Catch::Contains("no time in"));
    for (const char* wrong : {"", ",", "a", "1:b", "2:1", "1:2:3", "0..1"})
        CHECK_THROWS_AS(here.selectTimes(wrong), InputError);
    CHECK_THROWS_AS(here.selectTimes(std::string("0"), true), InputError);
}

TEST_CASE("a case without times says so")
{
    TemporaryFolder folder;
    makeCase(folder.path(), {});
    const CaseDirectory here(folder.path());
    CHECK(here.times().empty());
    CHECK_THROWS_WITH(here.latestTime(), Catch::Contains("no times here") && Catch::Contains("seedParticles"));
    CHECK_THROWS_WITH(here.firstTime(), Catch::Contains("no times here"));
    CHECK_THROWS_WITH(here.selectTimes("0"), Catch::Contains("no times here"));
    CHECK_THROWS_WITH(here.selectTimes(std::nullopt, false), Catch::Contains("no times here"));
}

TEST_CASE("what is missing is named with its place and what a case is made of")
{
    TemporaryFolder folder;
    CHECK_THROWS_WITH(CaseDirectory(folder / "no"),
                      Catch::Contains("/no: no such case folder") && Catch::Contains("controlDict"));
    CHECK_THROWS_WITH(CaseDirectory(folder.path()), Catch::Contains("neither system/ nor constant/"));
    makeCase(folder.path(), {});
    CHECK_THROWS_WITH(CaseDirectory(folder / "system/controlDict"), Catch::Contains("is not a folder"));
    const CaseDirectory here(folder.path());
    CHECK(here.dictionaryPath("system/controlDict") == folder / "system/controlDict");
    CHECK_THROWS_WITH(here.dictionaryPath("system/controlDictt"),
                      Catch::Contains("system/controlDictt: no such file (did you mean controlDict?)"));
    CHECK_THROWS_WITH(here.dictionaryPath("constant/g"), Catch::Contains("constant/g: no such file"));
    CHECK(here.name() == folder.path().filename().string());
    CHECK(here.postProcessing() == folder / "postProcessing");
    CHECK(fs::is_directory(folder / "postProcessing"));

    CHECK_THROWS_WITH(here.geometryPath(), Catch::Contains("no geometry"));
    std::ofstream(folder / "geometry/column.geo") << "//";
    CHECK(here.geometryPath() == folder / "geometry/column.geo");
    std::ofstream(folder / "geometry/block.stl") << "solid";
    CHECK_THROWS_WITH(here.geometryPath(), Catch::Contains("block.stl and column.geo"));
    CHECK(here.geometryPath("geometry/block.stl") == folder / "geometry/block.stl");
}

TEST_CASE("a folder that cannot be written to is refused before anything is done")
{
    TemporaryFolder folder;
    makeCase(folder.path(), {});
    CaseDirectory(folder.path()).requireWritable();
    CHECK_FALSE(fs::exists(folder / ".writable.partial"));

    fs::permissions(folder.path(), fs::perms(0555));
    const pid_t other = ::fork();
    if (other == 0)
    {
        // Permissions do not bind root, so the child becomes nobody.
        if (::geteuid() == 0 && ::setuid(65534) != 0)
            ::_exit(2);
        try
        {
            CaseDirectory(folder.path()).requireWritable();
            ::_exit(3);
        }
        catch (const InputError& error)
        {
            ::_exit(std::string(error.what()).find("cannot be written to") == std::string::npos ? 4 : 0);
        }
    }
    int status = 0;
    ::waitpid(other, &status, 0);
    fs::permissions(folder.path(), fs::perms::owner_all);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("purging keeps the last times and whatever is not ours")
{
    TemporaryFolder folder;
    makeCase(folder.path(), {"0", "1", "2", "3", "4"});
    std::ofstream(folder / "2/notes.txt") << "mine";
    std::ofstream(folder / "1/state.h5.partial") << "left over";
    const CaseDirectory here(folder.path());
    Names written{"1", "2", "3", "4"};
    here.purge(written, 0);
    CHECK(here.times().size() == 5);
    here.purge(written, 2);
    CHECK(written == Names{"3", "4"});
    CHECK(names(here.times()) == Names{"0", "3", "4"}); // 0 was not written by this run
    CHECK_FALSE(fs::exists(folder / "1"));
    CHECK(fs::exists(folder / "2/notes.txt"));
    CHECK_FALSE(fs::exists(folder / "2/state.h5"));
    CHECK_THROWS_AS(here.removeTime("system"), InputError);
    CHECK(fs::exists(folder / "system/controlDict"));
}

TEST_CASE("stored times never share a folder: names get the digits they need and keep their order")
{
    CHECK(cases::distinctTimeName(0.25, 0, 6) == "0.25");
    CHECK(cases::distinctTimeName(0.1 + 0.2, 0.2, 6) == "0.3");
    CHECK(cases::distinctTimeName(1.0000001, 1, 6) == "1.0000001");
    for (int precision : {1, 3, 6})
    {
        double before = 0, beforeName = 0;
        for (int step = 1; step <= 3000; ++step)
        {
            const double time = before + (step % 3 ? 1e-3 : 1e-5);
            const double name = std::stod(cases::distinctTimeName(time, before, precision));
            CHECK(name > beforeName);
            before = time;
            beforeName = name;
        }
    }
}

// Times out of turn go when they have done their duty, and nothing else goes with them.
#include "case/writtenTimes.hpp"
#include "output/stateFile.hpp"
#include "support/sampleState.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using mpm::cases::CaseDirectory;
using mpm::cases::WrittenTimes;
using mpm::tests::TemporaryFolder;
namespace fs = std::filesystem;

namespace
{
using Names = std::vector<std::string>;

struct Case
{
    TemporaryFolder place;
    fs::path path = place.path() / "case";
    CaseDirectory folder;
    state::State state = tests::sampleState(2, 3);

    Case() : folder((fs::create_directories(place.path() / "case/system"), path)) { state.provenance.clear(); }

    void put(const std::string& name, double time)
    {
        state.time = time;
        output::writeState(path / name, state);
    }
    void write(WrittenTimes& written, double time, bool outOfTurn = false)
    {
        state.time = time;
        output::writeState(path / written.next(state, outOfTurn), state);
        written.committed();
    }
    /// As a run does at its start.
    void goOn(WrittenTimes& written)
    {
        const auto start = folder.latestTime().name;
        state = output::readState(folder.statePath(start));
        written.goOnFrom(state, start);
        written.tidy();
    }
    Names names() const
    {
        Names all;
        for (const auto& time : folder.times())
            all.push_back(time.name);
        return all;
    }
};
} // namespace

TEST_CASE("a time out of turn goes with the next, and has no say in names")
{
    Case c;
    c.put("0", 0);
    {
        WrittenTimes written(c.folder, 0, 3);
        c.goOn(written);
        c.write(written, 0.1);
        c.write(written, 0.20004, true);
        CHECK(c.names() == Names{"0", "0.1", "0.2"});
    }
    {
        WrittenTimes written(c.folder, 0, 3);
        c.goOn(written);
        c.write(written, 0.20007, true); // interrupted again
        CHECK(c.names() == Names{"0", "0.1", "0.2"});
    }
    WrittenTimes written(c.folder, 0, 3);
    c.goOn(written);
    CHECK(c.state.provenance.empty());
    c.write(written, 0.2001); // beside 0.20007 this would need more digits
    CHECK(c.names() == Names{"0", "0.1", "0.2"});
    CHECK(output::readState(c.folder.statePath("0.2")).provenance.empty());
    c.write(written, 0.3);
    CHECK(c.names() == Names{"0", "0.1", "0.2", "0.3"});
}

TEST_CASE("what a killed run did not come to remove goes at the next start")
{
    Case c;
    c.put("0", 0);
    {
        WrittenTimes written(c.folder, 0, 6);
        c.goOn(written);
        c.state.time = 0.1;
        output::writeState(c.path / written.next(c.state, true), c.state);
        c.state.time = 0.2;
        output::writeState(c.path / written.next(c.state, false), c.state); // killed before committed()
    }
    CHECK(c.names() == Names{"0", "0.1", "0.2"});
    WrittenTimes written(c.folder, 0, 6);
    c.goOn(written);
    CHECK(c.names() == Names{"0", "0.2"});
}

TEST_CASE("a time out of turn stays alone in another case")
{
    Case c;
    c.put("0", 0);
    WrittenTimes first(c.folder, 0, 6);
    c.goOn(first);
    c.write(first, 0.1, true);
    fs::remove_all(c.path / "0");
    WrittenTimes written(c.folder, 0, 6);
    c.goOn(written);
    c.write(written, 0.2);
    CHECK(c.names() == Names{"0.1", "0.2"});
}

TEST_CASE("purgeWrite counts the times in turn, over interruptions, and no others")
{
    Case c;
    c.put("0", 0);
    c.put("0.05", 0.05); // of an earlier run that kept all
    for (const double start : {0.0, 3.0, 6.0})
    {
        WrittenTimes written(c.folder, 2, 6);
        c.goOn(written);
        for (const double time : {1, 2, 3})
            c.write(written, start + time);
        c.write(written, start + 3.5, true);
    }
    CHECK(c.names() == Names{"0", "0.05", "8", "9", "9.5"});
    WrittenTimes written(c.folder, 0, 6); // all are kept from now on
    c.goOn(written);
    c.write(written, 10);
    c.write(written, 11);
    CHECK(c.names() == Names{"0", "0.05", "8", "9", "10", "11"});
}

TEST_CASE("a run that goes back removes what it wrote since, and nothing older")
{
    Case c;
    c.put("0", 0);
    WrittenTimes written(c.folder, 3, 6);
    c.goOn(written);
    for (const double time : {1, 2, 3, 4})
        c.write(written, time);
    CHECK(written.goBack(2.5) == "2");
    CHECK(c.names() == Names{"0", "2"});
    c.write(written, 2.6);
    c.write(written, 3.1);
    CHECK(c.names() == Names{"0", "2", "2.6", "3.1"});
    CHECK(written.goBack(-1) == "0"); // the state it started from stays
    CHECK(c.names() == Names{"0"});

    fs::remove_all(c.path / "0");
    WrittenTimes last(c.folder, 1, 6);
    c.write(last, 1);
    c.write(last, 2);
    CHECK(last.goBack(0.5) == "2"); // the only one there is
}

TEST_CASE("marks of a hostile state reach nothing outside, and nonsense is no mark")
{
    for (const std::string mark : {"../victim 0", "0 nan", "0 1e300", "0", "0 0 0", "/ 0", ". 0"})
    {
        Case c;
        c.put("0", 0);
        output::writeState(c.place.path() / "victim", c.state);
        c.state.provenance = {{"outOfTurn", mark}, {"purgeWrite", "../victim . .. / system 0"}};
        c.put("1", 1);
        WrittenTimes written(c.folder, 1, 6);
        c.goOn(written);
        c.write(written, 2);
        c.write(written, 3);
        CHECK(fs::exists(c.place.path() / "victim/state.h5"));
        CHECK(fs::exists(c.path / "system"));
        CHECK(c.names().back() == "3");
    }
}

TEST_CASE("a state that becomes another loses its marks")
{
    Case c;
    c.state.provenance = {{"outOfTurn", "0 0"}, {"purgeWrite", "0"}, {"version", "1"}};
    cases::forgetTurn(c.state);
    CHECK(c.state.provenance == std::map<std::string, std::string>{{"version", "1"}});
}

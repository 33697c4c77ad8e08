// Which instruction sets a state names, and when a user is told.
#include "case/provenance.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using Catch::Contains;

namespace
{
const std::string& entry(const state::State& state)
{
    return state.provenance.at("instructionSet");
}
} // namespace

TEST_CASE("a run with one instruction set names it once, however often it is continued")
{
    state::State state(2);
    CHECK(cases::instructionSetNote(state, "x86-64-v3").empty());
    for (const Index step : {0, 100, 200})
    {
        state.step = step;
        CHECK(cases::instructionSetNote(state, "x86-64-v3").empty());
        cases::recordInstructionSet(state, "x86-64-v3");
        CHECK(entry(state) == "x86-64-v3");
    }
}

TEST_CASE("another instruction set is recorded with its first step, and told")
{
    state::State state(2);
    cases::recordInstructionSet(state, "x86-64-v3");
    state.step = 250;
    CHECK_THAT(cases::instructionSetNote(state, "native (znver3, avx512)"),
               Contains("computed with x86-64-v3, this is native (znver3, avx512)") && Contains("no longer bitwise"));
    cases::recordInstructionSet(state, "native (znver3, avx512)");
    CHECK(entry(state) == "x86-64-v3; native (znver3, avx512) from step 250");

    // going on with the second adds nothing; the first may come back
    state.step = 300;
    CHECK_THAT(cases::instructionSetNote(state, "native (znver3, avx512)"), Contains("more than one instruction set"));
    cases::recordInstructionSet(state, "native (znver3, avx512)");
    CHECK(entry(state) == "x86-64-v3; native (znver3, avx512) from step 250");
    cases::recordInstructionSet(state, "x86-64-v3");
    CHECK(entry(state) == "x86-64-v3; native (znver3, avx512) from step 250; x86-64-v3 from step 300");
}

TEST_CASE("another storage of columns is recorded with its first step, and told; doubles alone need no word")
{
    state::State state(2);
    cases::recordStorage(state, "double");
    state.step = 250;
    CHECK(cases::storageNote(state, "double").empty());
    cases::recordStorage(state, "double");
    CHECK(state.provenance.count("storage") == 0);

    CHECK_THAT(cases::storageNote(state, "float"),
               Contains("computed with storage double, this is float") && Contains("no longer bitwise"));
    cases::recordStorage(state, "float");
    CHECK(state.provenance.at("storage") == "double; float from step 250");
    CHECK_THAT(cases::storageNote(state, "float"), Contains("more than one storage"));
    state.step = 300;
    cases::recordStorage(state, "float");
    CHECK(state.provenance.at("storage") == "double; float from step 250");
    cases::recordStorage(state, "double");
    CHECK(state.provenance.at("storage") == "double; float from step 250; double from step 300");

    state.step = 0; // nothing was computed yet
    CHECK(cases::storageNote(state, "float").empty());
    cases::recordStorage(state, "float");
    CHECK(state.provenance.at("storage") == "float");
    state.step = 10;
    CHECK(cases::storageNote(state, "float").empty());
}

TEST_CASE("nothing was computed before the first step")
{
    state::State state(2);
    state.provenance["instructionSet"] = "x86-64-v2"; // the utility that made the state
    CHECK(cases::instructionSetNote(state, "x86-64-v4").empty());
    cases::recordInstructionSet(state, "x86-64-v4");
    CHECK(entry(state) == "x86-64-v4");
}

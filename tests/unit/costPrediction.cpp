// What a run will cost: counts are those of the run, sums add up, parts of states are states.
#include "case/costPrediction.hpp"
#include "output/csvSeries.hpp"
#include "output/memoryFile.hpp"
#include "output/stateFile.hpp"
#include "support/sampleState.hpp"
#include "support/scenes.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <fstream>

using namespace mpm;
using namespace mpm::cases;

namespace
{
RunTime runTime(const std::string& words)
{
    return RunTime(dictionary::Dictionary::fromText(words, "controlDict"));
}
} // namespace

TEST_CASE("a fixed step is counted as the run will take it")
{
    const auto run = runTime("endTime 2.5; deltaT 1e-3; writeInterval 0.25; historyInterval 7;");
    const auto count = countRun(run, 0, 0, 1, 1);
    CHECK(count.exact);
    CHECK(count.steps == 2500);
    CHECK(count.states == 10);
    CHECK(count.rows == 2500 / 7 + 1); // and one at the end
    const auto rest = countRun(run, 2.2, 2200, 1, 1);
    CHECK(rest.steps == 300);
    CHECK(rest.states == 2); // 2.25 and 2.5
    const auto none = countRun(run, 2.5, 2500, 1, 1);
    CHECK(none.steps == 0);
    CHECK(none.states == 0);
    CHECK(none.rows == 0);
}

TEST_CASE("writeControl timeStep writes the last state too")
{
    const auto count =
        countRun(runTime("endTime 1; deltaT 0.01; writeControl timeStep; writeInterval 30;"), 0, 0, 1, 1);
    CHECK(count.steps == 100);
    CHECK(count.states == 4);
}

TEST_CASE("steps shortened to land on write times are counted, not divided")
{
    // 0.1/0.03 is no whole number: four steps of 0.025 between states.
    const auto count =
        countRun(runTime("endTime 1; deltaT 0.03; writeControl adjustableRunTime; writeInterval 0.1;"), 0, 0, 1, 1);
    CHECK(count.exact);
    CHECK(count.steps == 40);
    CHECK(count.states == 10);
}

TEST_CASE("a changing step is an estimate from the step allowed now")
{
    const auto run = runTime("endTime 1; deltaT 1e-3; adjustTimeStep yes; writeInterval 0.5;");
    const auto count = countRun(run, 0, 0, 1e-3, 5e-3);
    CHECK_FALSE(count.exact);
    CHECK(count.steps == 1 + 200);
    CHECK(countRun(run, 0, 7, 1e-3, 5e-3).steps == 200); // the first step is the first of all
}

TEST_CASE("more steps than can be counted are estimated; steps that lead nowhere are infinitely many")
{
    const auto many = countRun(runTime("endTime 1; deltaT 1e-8; writeInterval 0.1;"), 0, 0, 1, 1);
    CHECK_FALSE(many.exact);
    CHECK(many.steps == Approx(1e8).epsilon(1e-6));
    CHECK(std::isinf(countRun(runTime("endTime 1.1e10; deltaT 1e-7; writeInterval 1e9;"), 1e10, 1, 1, 1).steps));
}

TEST_CASE("seconds add up: start, particle-steps, rows, states")
{
    state::State state = scenes::seedBlock({.n = {6, 4, 1}, .spacing = 0.5, .h = 1, .cells = {5, 5, 1}});
    CostPrediction p;
    p.count = {100, 4, 10, true};
    auto& r = p.rehearsal;
    r.start = {1, 2};
    r.particleStep.median = {1e-3, 2e-3};
    r.row = {0.1, 0.2};
    r.state = {0.5, 0.25};
    r.batches = 5;
    splitting::Rule rule;
    rule.maxGeneration = 3;
    rule.maxParticles = 1000;
    describeState(p, state, rule);
    addUp(p);
    CHECK(p.particles == 24);
    CHECK(p.cellsWithMaterial == 6);
    CHECK(p.stepping.cpu == Approx(2.4));
    CHECK(p.output.cpu == Approx(1 + 2));
    CHECK(p.total.cpu == Approx(1 + 2.4 + 3));
    CHECK(p.total.wall == Approx(2 + 4.8 + 2 + 1));
    REQUIRE(p.splitOnce);
    CHECK(p.splitOnce->particles == 96);
    CHECK(p.splitOnce->total.cpu == Approx(1 + 4 * (2.4 + 3)));
    CHECK(p.least.cpu == p.most.cpu);
    CHECK(p.splitCap->particles == 1000); // 24 4^3 are more than maxParticles
    rule.maxParticles = 1000000;
    describeState(p, state, rule);
    CHECK(p.splitCap->particles == 24 * 64);
    for (auto& generation : state.particles.generation)
        generation = 3;
    describeState(p, state, rule);
    CHECK(p.splitOnce->particles == 24);
    CHECK(p.splitCap->particles == 24);
}

TEST_CASE("what may get dearer makes a range, and the prediction is its middle")
{
    const auto state = scenes::seedBlock({.n = {6, 4, 1}, .spacing = 0.5, .h = 1, .cells = {5, 5, 1}});
    CostPrediction p;
    p.count = {100, 0, 10, false};
    p.rehearsal.particleStep.median = {1e-3, 1e-3};
    p.rehearsal.row = {0.1, 0.1};
    describeState(p, state, std::nullopt);
    p.rehearsal.wideParticleStep = Spread{{2e-3, 0.5e-3}, {}, {}};
    addUp(p);
    CHECK(p.least.cpu == Approx(2.4 + 1));
    CHECK(p.most.cpu == Approx(4.8 + 1));
    CHECK(p.total.cpu == Approx(3.6 + 1));
    CHECK(p.most.wall == Approx(2.4 + 1)); // never less than as it is
    p.mostSteps = 150;
    addUp(p);
    CHECK(p.most.cpu == Approx(1.5 * (4.8 + 1))); // rows come with steps
    p.rehearsal.wideParticleStep.reset();
    addUp(p);
    CHECK(p.total.cpu == Approx(1.25 * (2.4 + 1)));
}

TEST_CASE("a body falls through its own height along gravity")
{
    const auto state = scenes::seedBlock({.n = {2, 9, 1}, .spacing = 0.5, .h = 1, .cells = {5, 5, 1}});
    CHECK(fallSpeed(state, std::nullopt) == 0);
    CHECK(fallSpeed(state, Vector3{0, -9.8, 0}) == Approx(std::sqrt(2 * 9.8 * 4)));
}

TEST_CASE("medians and extremes")
{
    const auto s = spreadOf({{3, 30}, {1, 50}, {2, 10}, {10, 20}});
    CHECK(s.median.cpu == 2.5);
    CHECK(s.median.wall == 25);
    CHECK(s.least.cpu == 1);
    CHECK(s.most.wall == 50);
    CHECK(spreadOf({}).median.cpu == 0);
}

TEST_CASE("a part of a state is a state of its first particles")
{
    for (const int dim : {2, 3})
    {
        const auto state = tests::sampleState(dim, 300);
        const auto part = firstParticles(state, 70);
        CHECK(part.particles.size() == 70);
        CHECK(part.particles.F[3][69] == state.particles.F[3][69]);
        CHECK(part.particles.id[69] == state.particles.id[69]);
        CHECK(part.particles.mass[70] == 0); // padding
        output::requireValid(part, "part");
        CHECK(firstParticles(state, 1000).particles.size() == 300);
    }
}

TEST_CASE("a rehearsed state has the bytes of its file and makes none")
{
    const tests::TemporaryFolder folder;
    for (const Index n : {1, 1000, 20000})
    {
        const auto state = tests::sampleState(2, n);
        const double rehearsed = output::rehearseState(state);
        output::writeState(folder / "1", state);
        const double bytes = double(std::filesystem::file_size(folder / "1" / "state.h5"));
        CHECK(rehearsed == Approx(bytes).epsilon(0.02).margin(2048)); // HDF5 rounds its own room up
    }
    auto broken = tests::sampleState(2, 10);
    broken.particles.mass[3] = -1;
    CHECK_THROWS_AS(output::rehearseState(broken), InputError);
}

TEST_CASE("rows in memory are those of a series")
{
    const output::MemoryFile file;
    auto series = output::CsvSeries::rehearsal(file.path(), {"time", "value"});
    series.write({0.5, 1});
    series.write({0.75, -2.25});
    std::ifstream in(file.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    CHECK(text == "0.5,1\n0.75,-2.25\n");
    CHECK(file.bytes() == double(text.size()));
    CHECK_THROWS_AS(series.write({1.0}), InputError);
}

// Times of a run: every write time is met once, whatever the steps; steps land where they should; the run ends.
#include "case/runTime.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace mpm;

namespace
{
cases::RunTime runTime(const std::string& words)
{
    return cases::RunTime(dictionary::Dictionary::fromText(words, "controlDict"));
}

/// Times at which a run writes when it takes the step `limit(step)` allows.
template <class Limit>
std::vector<double> written(const cases::RunTime& run, Limit&& limit, Index most = 1000000)
{
    std::vector<double> times;
    double time = 0;
    for (Index step = 0; !run.done(time) && step < most; ++step)
    {
        const double before = time;
        time += run.nextStep(time, limit(step));
        if (run.writeNow(before, time, step + 1))
            times.push_back(time);
    }
    CHECK(run.done(time));
    return times;
}
} // namespace

TEST_CASE("steps of changing size write once for every writeInterval, at the first step past it")
{
    const auto run = runTime("endTime 20; deltaT 0.01; adjustTimeStep yes; writeControl runTime; writeInterval 0.5;");
    std::mt19937 random(1);
    std::uniform_real_distribution<double> size(0.01, 0.3); // neighbours differ up to thirtyfold
    const auto times = written(run, [&](Index) { return size(random); });
    REQUIRE(times.size() == 40);
    for (std::size_t k = 0; k < times.size(); ++k)
    {
        CHECK(times[k] > 0.5 * double(k + 1) - 1e-8);
        CHECK(times[k] < 0.5 * double(k + 1) + 0.3);
    }
}

TEST_CASE("adjustableRunTime lands on every write time and ends with the step that reaches endTime")
{
    for (const std::string adjust : {"yes", "no"})
    {
        const auto run = runTime("endTime 1.0004; deltaT 1e-3; adjustTimeStep " + adjust +
                                 "; writeControl adjustableRunTime; writeInterval 0.1;");
        const auto times = written(run, [](Index step) { return step % 2 ? 7.3e-4 : 1.1e-4; });
        REQUIRE(times.size() == 11);
        for (std::size_t k = 0; k < 10; ++k)
            CHECK(times[k] == Approx(0.1 * double(k + 1)).epsilon(1e-12));
        CHECK(times.back() >= 1.0004);
        CHECK(times.back() < 1.0004 + 1e-3);
        const auto onTime = runTime("endTime 1; deltaT 1e-3; adjustTimeStep " + adjust +
                                    "; writeControl adjustableRunTime; writeInterval 0.1;");
        const auto landed = written(onTime, [](Index step) { return step % 2 ? 7.3e-4 : 1.1e-4; });
        REQUIRE(landed.size() == 10);
        CHECK(landed.back() == Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("a fixed step writes at the nearest step and ends after a whole number of steps")
{
    const auto run = runTime("endTime 2.5; deltaT 1e-3; writeControl runTime; writeInterval 0.25;");
    const auto times = written(run, [](Index) { return 1.0; });
    REQUIRE(times.size() == 10);
    for (std::size_t k = 0; k < times.size(); ++k)
        CHECK(times[k] == Approx(0.25 * double(k + 1)).epsilon(1e-11));
    CHECK(run.nextStep(2.5, 1) == 1e-3);
}

TEST_CASE("the sequence of steps does not depend on endTime")
{
    // a limit that follows the time reached, as it follows from a state
    const auto limit = [](double time) { return 1e-3 * (1.2 + std::sin(40 * time)); };
    for (const std::string control : {"timeStep", "runTime", "adjustableRunTime"})
        for (const std::string adjust : {"yes", "no"})
        {
            INFO(control << ", adjustTimeStep " << adjust);
            const auto run = [&](const std::string& endTime) {
                return runTime("endTime " + endTime + "; deltaT 1e-3; adjustTimeStep " + adjust + "; writeControl " +
                               control + "; writeInterval " + (control == "timeStep" ? "7" : "0.1") + ";");
            };
            std::vector<double> whole, cut;
            double time = 0;
            for (const auto all = run("1"); !all.done(time);)
                whole.push_back(time += all.nextStep(time, limit(time)));
            time = 0;
            for (const std::string endTime : {"0.1", "0.2337", "0.7", "1"})
                for (const auto part = run(endTime); !part.done(time);)
                    cut.push_back(time += part.nextStep(time, limit(time)));
            CHECK(cut == whole);
            CHECK(whole.back() < 1 + (adjust == "yes" ? 2.2e-3 : 1e-3));
        }
}

TEST_CASE("a run past its end still names a step that is positive")
{
    const auto run = runTime("endTime 1; deltaT 1e-3; adjustTimeStep yes; writeControl runTime; writeInterval 1;");
    CHECK(run.done(2));
    CHECK(run.nextStep(2, 5e-4) == 5e-4);
}

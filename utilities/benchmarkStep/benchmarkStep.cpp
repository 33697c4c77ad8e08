// How long a time step takes on a collapsing soil column, beside what the machine can do and what a naive step takes.
#include "base/version.hpp"
#include "benchmark/rowTable.hpp"
#include "output/replaceFile.hpp"

#include <fmt/format.h>

using namespace mpm;

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"benchmarkStep", "time of a step per particle, against the machine's limits"};
    info.usesCase = false;
    info.options = benchmark::settingOptions();
    info.details =
        "Needs no case: the column of cases/collapsingSoilColumn runs to 0.5 s coarsely and is refined to the numbers "
        "of\n"
        "particles asked for. Lists are separated by commas; every combination is a row.\n"
        "\n"
        "ns          per particle and step: median of blocks, fastest and slowest; the energy budget of every 100th "
        "step\n"
        "            is in it\n"
        "naive       an array of structures and plain loops over particle-node pairs, one thread\n"
        "speedup     against the row with one thread\n"
        "GB/s, GF/s  bytes and flops of a fixed list (libmpm/benchmark/roofline.hpp) over the time\n"
        "triad, fma  what this machine reaches with these threads: a = b + s c in memory [GB/s], multiply-adds [GF/s]\n"
        "roofline    max(bytes/triad, flops/fma) over the time\n"
        "B/particle  resident memory of the run; columns: that of the state alone\n"
        "yielding    particles on the yield surface";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const auto settings = benchmark::readSettings(options);
        const auto json = options.value("json");
        if (!json.empty())
            output::replaceText(json, "[]\n"); // told before the work if it cannot be written
        fmt::print("benchmarkStep, libmpm {} ({}, {})\n\n", projectVersion(), gitRevision(), instructionSet());
        benchmark::Bench bench;
        std::vector<benchmark::Row> rows;
        for (const auto& setting : settings)
            rows.push_back(bench.measure(setting));
        fmt::print("{}", benchmark::tableOf(rows));
        if (!json.empty())
            output::replaceText(json, benchmark::jsonOf(rows));
        return 0;
    });
}

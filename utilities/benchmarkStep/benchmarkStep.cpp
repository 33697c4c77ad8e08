// How long a time step takes on a collapsing soil column, beside what the machine can do and what a naive step takes.
#include "base/error.hpp"
#include "base/version.hpp"
#include "benchmark/rowTable.hpp"
#include "output/replaceFile.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>

using namespace mpm;

namespace
{
/// Said before minutes of work are lost.
void requireWritable(const std::string& file)
{
    const auto trial = output::temporaryName(file);
    if (!std::ofstream(trial))
        throw InputError("-json: found '" + file + "', which cannot be written, allowed a file in a folder of yours");
    std::filesystem::remove(trial);
}
} // namespace

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
        "naive       an array of structures and plain loops over particle-node pairs, one thread (not for splines)\n"
        "speedup     against the row with one thread\n"
        "GB/s, GF/s  bytes and flops of a fixed list (libmpm/benchmark/roofline.hpp) over the time\n"
        "triad, fma  what this machine reaches with these threads: a = b + s c in memory [GB/s], multiply-adds [GF/s]\n"
        "roofline    max(bytes/triad, flops/fma) over the time\n"
        "B/particle  resident memory of the run; columns: that of the state alone\n"
        "yielding    particles on the yield surface\n"
        "\n"
        "Threads spin for some microseconds where they wait, then sleep; OMP_WAIT_POLICY in the environment decides "
        "instead.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const auto settings = benchmark::readSettings(options);
        const auto json = options.value("json");
        if (!json.empty())
            requireWritable(json);
        fmt::print("benchmarkStep, libmpm {} ({}, {})\n", projectVersion(), gitRevision(), kernelText());
        benchmark::Bench bench;
        std::vector<benchmark::Row> rows;
        for (const auto& setting : settings)
        {
            rows.push_back(bench.measure(setting));
            fmt::print("{} of {}: {}D {} {} particles, {:.1f} ns\n", rows.size(), settings.size(), setting.dimension,
                       setting.shape, rows.back().particles, 1e9 * rows.back().ours.median);
            std::fflush(stdout);
            if (!json.empty())
                output::replaceText(json, benchmark::jsonOf(rows));
        }
        fmt::print("\n{}", benchmark::tableOf(rows));
        return 0;
    });
}

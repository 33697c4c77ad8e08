// How far the stresses of stored times can be trusted: noise, overburden, checkerboard, law, volume, energy, and how
// far they are from those of another case.
#include "base/terminal.hpp"
#include "case/application.hpp"
#include "case/caseLock.hpp"
#include "case/otherCase.hpp"
#include "case/readScene.hpp"
#include "case/smoothingInput.hpp"
#include "case/stressReport.hpp"
#include "output/csvSeries.hpp"
#include "output/stateFile.hpp"

#include <cmath>
#include <fmt/format.h>

using namespace mpm;

namespace
{
/// What reports need of the dictionaries, and of the state at step 0 if it is there.
cases::StressReporting readInput(const cases::CaseDirectory& here)
{
    const auto first = output::readState(here.statePath(here.firstTime().name));
    const auto properties = dictionary::Dictionary::readFile(here.dictionaryPath("constant/materialProperties"));
    cases::StressReporting with{cases::readSmoothingShape(here), cases::readSmoothingGravity(here),
                                cases::matchMaterials(properties, first)};
    properties.rejectUnread();
    with.elasticVolumeAtStart = first.step == 0 ? smoothing::elasticVolume(first, with.materials) : std::nan("");
    return with;
}

void explain(int axis, const std::optional<cases::OtherCase>& other, std::size_t times)
{
    const char* stress = stressNames[std::size_t(axis)];
    fmt::print("sigma_{}: N = RMS(raw - smoothed)/RMS(smoothed); corr, error [kPa]: raw against overburden\n", stress);
    fmt::print("volume: made by returns to the apex, seen: inelastic change of all particles; of the initial volume\n");
    fmt::print("remedies, transfer: energy they took, of the energy released\n");
    if (other)
        fmt::print("against {} ({} of {} times): RMS of raw and smoothed sigma_{} - its nodal stress [kPa], where it "
                   "has material\n",
                   other->name(), other->commonTimes(), times, stress);
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"stressQuality", "how far the stresses of stored times can be trusted"};
    info.usesTime = info.usesDryRun = true;
    info.options = {{"against", "DIR",
                     "another case, usually at twice the resolution: RMS error of our stresses against its nodal "
                     "stress at every time both have; a relative path starts at the case folder"}};
    info.details =
        "Writes postProcessing/stressQuality.csv and prints, for each time: noise N of every stress component, "
        "correlation\nand RMS error against overburden, checkerboard of the pressure, violation of yield surface and "
        "tension limit, spurious\nvolume, and the energy remedies took, of the energy released. Columns: "
        "libmpm/case/stressReport.hpp.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory here(options.caseFolder);
        const cases::CaseLock lock(options, "stressQuality");
        const auto times = here.selectTimes(options.time, options.latestTime);
        auto with = readInput(here);
        std::optional<cases::OtherCase> other;
        if (options.has("against"))
        {
            other.emplace(here, options.value("against"), times);
            with.otherShape = other->shape();
        }
        fmt::print("stressQuality of {}: {} times, shape {}\n", here.name(), times.size(), with.shape);
        if (options.dryRun)
            return 0;
        here.requireWritable();
        std::vector<cases::StressReport> reports; // a broken state is found before anything is written
        for (const auto& time : times)
        {
            const auto state = output::readState(here.statePath(time.name));
            std::optional<state::State> fine;
            if (const auto file = other ? other->stateOf(time) : std::filesystem::path(); !file.empty())
                fine = output::readState(file);
            reports.push_back(cases::stressReport(state, with, fine ? &*fine : nullptr));
        }
        const bool against = other.has_value();
        const int dim = int(reports.front().noise.own.size()) == 6 ? 3 : 2;
        output::CsvSeries csv(here.postProcessing() / "stressQuality.csv", cases::stressReportColumns(dim, against));
        Table table(cases::stressReportHeads(against));
        for (std::size_t i = 0; i < reports.size(); ++i)
        {
            csv.write(cases::stressReportRow(reports[i], against));
            table.row(cases::stressReportCells(reports[i], times[i].name, against));
        }
        explain(reports.front().quality.axis, other, times.size());
        fmt::print("{}wrote postProcessing/stressQuality.csv\n", table.text());
        return 0;
    });
}

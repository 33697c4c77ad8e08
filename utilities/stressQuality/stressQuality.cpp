// How far the stresses of stored times can be trusted: noise, overburden, checkerboard, law, volume, energy, and how
// far they are from those of another case.
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
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"stressQuality", "how far the stresses of stored times can be trusted"};
    info.usesTime = info.usesDryRun = true;
    info.options = {
        {"against", "DIR", "RMS error against the stresses of another case; relative: as seen from the case folder"}};
    info.details =
        "Writes postProcessing/stressQuality.csv and prints, for each time: noise N of every stress component, "
        "correlation\nand RMS error against overburden, checkerboard of the pressure, violation of yield surface and "
        "tension limit, spurious\nvolume, and the energy remedies took, of the energy released. With -against, at "
        "times both cases have, RMS error of\nour raw and smoothed stresses against the nodal stress of the other, "
        "usually one of twice the resolution, where it has\nmaterial. Columns: libmpm/case/stressReport.hpp.";
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
        output::CsvSeries csv(here.postProcessing() / "stressQuality.csv",
                              cases::stressReportColumns(reports.front().dim, against));
        cases::StressReportTables tables(against);
        for (std::size_t i = 0; i < reports.size(); ++i)
        {
            csv.write(cases::stressReportRow(reports[i], against));
            tables.row(reports[i], times[i].name);
        }
        if (against)
            fmt::print("against {}: {} of {} times\n", other->name(), other->commonTimes(), times.size());
        fmt::print("{}wrote postProcessing/stressQuality.csv\n", tables.text());
        return 0;
    });
}

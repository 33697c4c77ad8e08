// Nodal and smoothed stress of stored states (Andersen & Andersen 2009, Eqs. 11 and 12), with their quality.
#include "base/terminal.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/caseLock.hpp"
#include "case/smoothingInput.hpp"
#include "output/csvSeries.hpp"
#include "output/derivedFields.hpp"
#include "output/paraviewSeries.hpp"
#include "output/stateFile.hpp"
#include "smoothing/stressQuality.hpp"

#include <fmt/format.h>

using namespace mpm;

namespace
{
void store(const std::filesystem::path& file, const state::State& state, const smoothing::SmoothedStress& stress,
           const std::vector<double>& overburden, int axis)
{
    const int dim = state.particles.dim;
    const std::vector<std::string> names(stressNames.begin(), stressNames.begin() + stressComponents(dim));
    std::vector<output::DerivedField> fields{{"smoothedStress", "Pa", names, stress.smoothed}};
    if (!overburden.empty())
        fields.push_back({"overburden", "Pa", {names[std::size_t(axis)]}, {overburden}});
    output::writeDerived(
        file, state, fields,
        {stress.nodePosition,
         {{"stress", "Pa", names, stress.nodal}, {"mass", dim == 2 ? "kg/m" : "kg", {"mass"}, {stress.nodeMass}}}});
}

const std::vector<std::string> columns{"time",
                                       "particles",
                                       "minNodal",
                                       "minRaw",
                                       "minSmoothed",
                                       "errorNodal",
                                       "errorRaw",
                                       "errorSmoothed",
                                       "correlationNodal",
                                       "correlationRaw",
                                       "correlationSmoothed",
                                       "noise",
                                       "noiseByMass",
                                       "noiseFloor",
                                       "worstX",
                                       "worstY",
                                       "worstZ",
                                       "worstError"};

std::vector<std::string> tableRow(const std::string& name, Index particles, const smoothing::StressQuality& q)
{
    std::vector<std::string> row{name, std::to_string(particles)};
    for (double value : {q.nodal.min, q.raw.min, q.smoothed.min, q.nodal.error, q.raw.error, q.smoothed.error})
        row.push_back(fmt::format("{:.1f}", 1e-3 * value));
    for (double value :
         {q.nodal.correlation, q.raw.correlation, q.smoothed.correlation, q.noise, q.noiseByMass, q.noiseFloor})
        row.push_back(fmt::format("{:.3f}", value));
    return row;
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"smoothStress", "nodal and smoothed stress of stored times (Eqs. 11 and 12)"};
    info.usesTime = info.usesDryRun = true;
    info.details =
        "Adds smoothedStress and overburden (one row a particle) and the nodal stress to each state.h5, writes\n"
        "postProcessing/smoothStress.csv and prints, for the normal stress along gravity, minimum, RMS error and\n"
        "correlation against overburden, and N = RMS(raw - smoothed)/RMS(smoothed).";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory here(options.caseFolder);
        const cases::CaseLock lock(options, "smoothStress");
        const std::string shape = cases::readSmoothingShape(here);
        const Vector3 gravity = cases::readSmoothingGravity(here);
        const auto times = here.selectTimes(options.time, options.latestTime);
        fmt::print("smoothStress of {}: {} times, shape {}\n", here.name(), times.size(), shape);
        if (options.dryRun)
            return 0;
        here.requireWritable();
        for (std::size_t i = 1; i < times.size(); ++i) // a broken state is found before anything is written
            output::readState(here.statePath(times[i].name));
        auto state = output::readState(here.statePath(times[0].name));
        output::CsvSeries csv(here.postProcessing() / "smoothStress.csv", columns);
        Table table({"time", "particles", "min nodal", "min raw", "min smoothed", "error nodal", "error raw",
                     "error smoothed", "corr nodal", "corr raw", "corr smoothed", "N", "N by mass", "N floor"});
        int axis = 1;
        for (const auto& time : times)
        {
            if (&time != &times[0])
                state = output::readState(here.statePath(time.name));
            const auto weights = smoothing::weightTable(state, shape);
            const auto stress = smoothing::smoothStress(state.particles, weights);
            std::vector<double> overburden;
            const auto q = smoothing::stressQuality(state, weights, stress, gravity, &overburden);
            const auto& at = q.worstPlace;
            axis = q.axis;
            store(here.statePath(time.name), state, stress, overburden, axis);
            csv.write({state.time, double(state.particles.size()), q.nodal.min, q.raw.min, q.smoothed.min,
                       q.nodal.error, q.raw.error, q.smoothed.error, q.nodal.correlation, q.raw.correlation,
                       q.smoothed.correlation, q.noise, q.noiseByMass, q.noiseFloor, at[0], at[1], at[2],
                       q.worstError});
            table.row(tableRow(time.name, state.particles.size(), q));
        }
        std::vector<std::string> all;
        for (const auto& time : here.times())
            all.push_back(time.name);
        output::writeParaviewSeries(here.folder(), here.name(), all);
        fmt::print("sigma_{} [kPa]: minimum, RMS error and correlation against overburden; N = RMS(raw - smoothed)/"
                   "RMS(smoothed)\n",
                   stressNames[std::size_t(axis)]);
        fmt::print("{}wrote postProcessing/smoothStress.csv and derived fields in {} state files\n", table.text(),
                   times.size());
        return 0;
    });
}

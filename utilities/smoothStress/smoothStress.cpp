// Nodal and smoothed stress of stored states (Andersen & Andersen 2009, Eqs. 11 and 12), with their quality.
#include "base/terminal.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "dictionary/dictionary.hpp"
#include "output/csvSeries.hpp"
#include "output/derivedFields.hpp"
#include "output/paraviewSeries.hpp"
#include "output/stateFile.hpp"
#include "smoothing/stressQuality.hpp"

#include <fmt/format.h>

using namespace mpm;

namespace {
std::string readShape(const cases::CaseDirectory& here)
{
    std::vector<dictionary::Choice> shapes;
    for (const auto& name : smoothing::shapeNames())
        shapes.push_back({name, ""});
    return dictionary::Dictionary::readFile(here.dictionaryPath("system/mpmSchemes"))
        .choose("shape", "shape functions", shapes, "uGIMP");
}

Vector3 readGravity(const cases::CaseDirectory& here)
{
    if (!here.hasFile("constant/g"))
        return {0, 0, 0};
    return dictionary::Dictionary::readFile(here.dictionaryPath("constant/g"))
        .get<Vector3>({"value", "gravity", dictionary::unit::acceleration});
}

void store(const std::filesystem::path& file, const state::State& state, const smoothing::SmoothedStress& stress,
           const std::vector<double>& overburden)
{
    const std::vector<std::string> names(stressNames.begin(),
                                         stressNames.begin() + stressComponents(state.particles.dim));
    output::writeDerived(file, state,
                         {{"smoothedStress", "Pa", names, stress.smoothed}, {"overburden", "Pa", {"yy"}, {overburden}}},
                         {stress.nodePosition,
                          {{"stress", "Pa", names, stress.nodal},
                           {"mass", state.particles.dim == 2 ? "kg/m" : "kg", {"mass"}, {stress.nodeMass}}}});
}

const std::vector<std::string> columns{
    "time",       "particles",     "minNodal",         "minRaw",         "minSmoothed",         "errorNodal",
    "errorRaw",   "errorSmoothed", "correlationNodal", "correlationRaw", "correlationSmoothed", "noise",
    "noiseFloor", "worstX",        "worstY",           "worstZ",         "worstError"};
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
        const std::string shape = readShape(here);
        const Vector3 gravity = readGravity(here);
        const auto times = here.selectTimes(options.time, options.latestTime);
        fmt::print("smoothStress of {}: {} times, shape {}\n", here.name(), times.size(), shape);
        if (options.dryRun)
            return 0;
        here.requireWritable();
        output::CsvSeries csv(here.postProcessing() / "smoothStress.csv", columns);
        Table table({"time [s]", "particles", "min nodal", "raw", "smoothed [kPa]", "error nodal", "raw",
                     "smoothed [kPa]", "corr. nodal", "raw", "smoothed", "N", "N floor"});
        for (const auto& time : times) {
            const auto state = output::readState(here.statePath(time.name));
            const auto weights = smoothing::weightTable(state, shape);
            const auto stress = smoothing::smoothStress(state.particles, weights);
            std::vector<double> overburden;
            const auto q = smoothing::stressQuality(state, weights, stress, gravity, &overburden);
            store(here.statePath(time.name), state, stress, overburden);
            const auto& [n, r, s] = std::tie(q.nodal, q.raw, q.smoothed);
            const auto& at = q.worstPlace;
            csv.write({state.time, double(state.particles.size()), n.min, r.min, s.min, n.error, r.error, s.error,
                       n.correlation, r.correlation, s.correlation, q.noise, q.noiseFloor, at[0], at[1], at[2],
                       q.worstError});
            std::vector<std::string> row{time.name, std::to_string(state.particles.size())};
            for (double value : {n.min, r.min, s.min, n.error, r.error, s.error})
                row.push_back(fmt::format("{:.1f}", 1e-3 * value));
            for (double value : {n.correlation, r.correlation, s.correlation, q.noise, q.noiseFloor})
                row.push_back(fmt::format("{:.3f}", value));
            table.row(row);
        }
        std::vector<std::string> all;
        for (const auto& time : here.times())
            all.push_back(time.name);
        output::writeParaviewSeries(here.folder(), here.name(), all);
        fmt::print("{}wrote postProcessing/smoothStress.csv and derived fields in {} state files\n", table.text(),
                   times.size());
        return 0;
    });
}

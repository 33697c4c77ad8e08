#include "case/stressReport.hpp"

#include "output/ledgerEntries.hpp"

#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <type_traits>

namespace mpm::cases
{
namespace
{
/// An entry that is a number; 0 if the ledger has none of that name.
double entry(const state::Ledger& ledger, const std::string& wanted)
{
    double found = 0;
    output::forEachLedgerEntry(ledger, [&](const char* name, const auto& value, const char*) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
            if (name == wanted)
                found = value;
    });
    return found;
}

/// "noiseXY"
std::string noiseName(int component)
{
    std::string name = stressNames[std::size_t(component)];
    for (char& letter : name)
        letter = char(std::toupper(letter));
    return "noise" + name;
}

struct Value
{
    std::string name;
    double value;
};

void appendNoise(std::vector<Value>& out, const StressReport& r)
{
    const auto own = [&](int c) { return r.noise.own.empty() ? 0.0 : r.noise.own[std::size_t(c)]; };
    const auto ofMean = [&](int c) { return r.noise.ofMean.empty() ? 0.0 : r.noise.ofMean[std::size_t(c)]; };
    for (int c = 0; c < stressComponents(r.dim); ++c)
        if (c != 1)
            out.push_back({noiseName(c), own(c)});
    for (int c = 3; c < stressComponents(r.dim); ++c)
        out.push_back({noiseName(c) + "OfMean", ofMean(c)});
    out.push_back({"noiseMean", r.noise.mean});
    out.push_back({"noiseVertical", r.quality.noise});
    out.push_back({"noiseByMass", r.quality.noiseByMass});
    out.push_back({"noiseFloor", r.quality.noiseFloor});
    out.push_back({"meanStress", r.noise.scale});
}

void appendComparison(std::vector<Value>& out, const std::optional<smoothing::Comparison>& against)
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const auto c = against.value_or(smoothing::Comparison{none, none, none, none, none});
    out.push_back({"errorAgainstRaw", c.raw});
    out.push_back({"errorAgainstSmoothed", c.smoothed});
    out.push_back({"errorAgainstRawByMass", c.rawByMass});
    out.push_back({"relativeErrorAgainstRaw", c.raw / c.reference});
    out.push_back({"relativeErrorAgainstSmoothed", c.smoothed / c.reference});
    out.push_back({"massCompared", c.massShare});
}

/// Names and values side by side, so that they cannot come apart.
std::vector<Value> values(const StressReport& r, bool against)
{
    std::vector<Value> out{{"time", r.time},
                           {"noiseYY", r.noise.own.empty() ? 0 : r.noise.own[1]},
                           {"overburdenCorrelation", r.quality.raw.correlation},
                           {"overburdenRmsError", r.quality.raw.error},
                           {"volumeError", r.volume.dropped},
                           {"remedyEnergyLoss", r.loss.total},
                           {"particles", double(r.particles)}};
    appendNoise(out, r);
    const std::vector<Value> more{{"checkerboard", r.checkerboard.share},
                                  {"checkerboardAmplitude", r.checkerboard.amplitude},
                                  {"checkerboardCells", double(r.checkerboard.cells)},
                                  {"yieldViolation", r.admissibility.yieldViolation},
                                  {"tensionViolation", r.admissibility.tensionViolation},
                                  {"massInTension", r.admissibility.massInTension},
                                  {"volumeChange", r.volume.change},
                                  {"elasticVolumeChange", r.volume.elastic},
                                  {"inelasticVolumeChange", r.volume.inelastic},
                                  {"releasedEnergy", r.loss.released},
                                  {"relaxationLoss", r.loss.relaxation},
                                  {"averagingLoss", r.loss.averaging},
                                  {"gapWork", r.loss.gap},
                                  {"transferLoss", r.loss.transfer}};
    out.insert(out.end(), more.begin(), more.end());
    if (against)
        appendComparison(out, r.against);
    out.push_back({"noiseBeyondFilter", r.filtered.beyondFilter}); // behind all others: columns keep their places
    out.push_back({"noiseFloorOfField", r.filtered.floorOfField});
    out.push_back({"viscosityLoss", r.loss.viscosity});
    return out;
}

smoothing::Comparison comparison(const state::State& state, const smoothing::SmoothedStress& smoothed, std::size_t axis,
                                 const state::State& other, const std::string& otherShape)
{
    const auto& stress = state.particles.stress[axis];
    const std::vector<double> raw(stress.begin(), stress.begin() + state.particles.size());
    const smoothing::ReferenceField field(other, otherShape, axis);
    return smoothing::compare(state.particles, raw, smoothed.smoothed[axis], field.at(state.particles));
}
} // namespace

RemedyLoss remedyLoss(const state::Ledger& ledger)
{
    RemedyLoss out;
    out.released = ledger.gravityWork + ledger.tractionWork + ledger.bodyForceWork + ledger.motionWork;
    if (out.released == 0)
        out.released = ledger.initialKineticEnergy + ledger.initialStrainEnergy;
    const auto share = [&](const char* name) {
        const double value = entry(ledger, name);
        return value == 0 ? 0 : out.released > 0 ? value / out.released : std::nan("");
    };
    out.relaxation = share("relaxationLoss");
    out.averaging = share("averagingLoss");
    out.viscosity = share("viscosityLoss");
    out.gap = share("gapWork");
    out.transfer = share("transferLoss");
    out.total = std::abs(out.relaxation) + std::abs(out.averaging) + std::abs(out.viscosity) + std::abs(out.gap);
    return out;
}

StressReport stressReport(const state::State& state, const StressReporting& with, const state::State* other)
{
    const auto table = smoothing::weightTable(state, with.shape);
    const auto smoothed = smoothing::smoothStress(state.particles, table);
    StressReport out;
    out.dim = state.particles.dim;
    out.time = state.time;
    out.particles = state.particles.size();
    out.quality = smoothing::stressQuality(state, table, smoothed, with.gravity);
    out.noise = smoothing::componentNoise(state.particles, smoothed);
    out.filtered = smoothing::filteredNoise(state.particles, table, smoothed);
    out.checkerboard = smoothing::checkerboard(state);
    out.admissibility = smoothing::admissibility(state, with.materials, out.noise.scale);
    out.volume = smoothing::volumeBudget(state, with.materials, with.elasticVolumeAtStart);
    out.loss = remedyLoss(state.ledger);
    if (other)
        out.against = comparison(state, smoothed, std::size_t(out.quality.axis), *other, with.otherShape);
    return out;
}

std::vector<std::string> stressReportColumns(int dim, bool against)
{
    StressReport report;
    report.dim = dim;
    std::vector<std::string> names;
    for (const auto& value : values(report, against))
        names.push_back(value.name);
    return names;
}

std::vector<double> stressReportRow(const StressReport& report, bool against)
{
    std::vector<double> row;
    for (const auto& value : values(report, against))
        row.push_back(std::isnan(value.value) ? std::numeric_limits<double>::quiet_NaN() : value.value); // no "-nan"
    return row;
}

namespace
{
std::vector<std::string> stressHeads(bool against)
{
    std::vector<std::string> heads{"time",   "N",           "N floor", "N by mass",
                                   "N mean", "correlation", "error",   "checkerboard"};
    if (against)
        heads.insert(heads.end(), {"raw - other", "smoothed - other", "compared"});
    return heads;
}
} // namespace

StressReportTables::StressReportTables(bool against)
    : against_(against), stress_(stressHeads(against)),
      body_({"time", "beyond yield", "beyond apex", "in tension", "volume error", "seen", "remedies", "transfer"})
{}

void StressReportTables::row(const StressReport& r, const std::string& time)
{
    const auto text = [](const char* form, double value) { // empty where there is no number
        return std::isnan(value) ? std::string() : fmt::format(fmt::runtime(form), value);
    };
    const auto share = [&](double value) { return text("{:.4f}", value); };
    const auto small = [&](double value) { return text("{:.1e}", value); };
    const auto kilo = [&](double value) { return text("{:.2f}", 1e-3 * value); };
    axis_ = r.quality.axis;
    std::vector<std::string> cells{time,
                                   share(r.quality.noise),
                                   share(r.quality.noiseFloor),
                                   share(r.quality.noiseByMass),
                                   share(r.noise.mean),
                                   share(r.quality.raw.correlation),
                                   kilo(r.quality.raw.error),
                                   share(r.checkerboard.share)};
    if (against_)
    {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        cells.push_back(kilo(r.against ? r.against->raw : none));
        cells.push_back(kilo(r.against ? r.against->smoothed : none));
        cells.push_back(share(r.against ? r.against->massShare : none));
    }
    stress_.row(std::move(cells));
    body_.row({time, small(r.admissibility.yieldViolation), small(r.admissibility.tensionViolation),
               share(r.admissibility.massInTension), share(r.volume.dropped), share(r.volume.inelastic),
               share(r.loss.total), share(r.loss.transfer)});
}

std::string StressReportTables::text() const
{
    const char* stress = stressNames[std::size_t(axis_)];
    std::string out =
        fmt::format("sigma_{0}: N = RMS(raw - smoothed)/RMS(smoothed); correlation and RMS error [kPa] of "
                    "raw against overburden;\ncheckerboard: share of the pressure's variance",
                    stress);
    if (against_)
        out += "; - other: RMS difference from the other's nodal stress [kPa],\ncompared: share of our mass";
    return out +
           fmt::format("\n{}volume error: what returns to the apex made, seen: inelastic change of all particles, "
                       "of the initial volume;\nremedies, transfer: energy they took, of the energy released\n{}",
                       stress_.text(), body_.text());
}
} // namespace mpm::cases

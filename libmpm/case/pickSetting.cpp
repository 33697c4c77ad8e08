#include "case/pickSetting.hpp"

#include "base/csvTable.hpp"
#include "base/error.hpp"
#include "base/terminal.hpp"
#include "base/version.hpp"
#include "case/solverRun.hpp"
#include "output/csvSeries.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
constexpr const char *schemesFile = "system/mpmSchemes", *controlFile = "system/controlDict";
constexpr double hopeless = 1.1;    ///< a scaled time this far over the limit needs no rehearsal of its own
constexpr double fasterMachine = 4; ///< before the first rehearsal: the table's machine may have been so much slower

double positiveNumber(const Options& options, const std::string& name)
{
    const double value = options.number(name, 0);
    if (!(value > 0))
        throw InputError(fmt::format("-{}: found '{}', allowed a number > 0", name, options.value(name)));
    return value;
}

std::string versionOf(const std::string& text)
{
    return text.substr(0, text.find_first_of(" (,"));
}

std::string seedingLines(const AccuracyRow& row)
{
    return fmt::format("system/gridDict cellSize {}; system/seedParticlesDict particlesPerCell {}; then seedParticles "
                       "-overwrite",
                       output::shortest(row.setting.cellSize), row.setting.particlesPerCell);
}

std::string rowText(const AccuracyRow& row)
{
    return fmt::format("row {}: {}", row.name, row.setting.describe());
}
} // namespace

PresentCase presentCase(const CaseDirectory& folder, const state::State& state, double waveSpeed,
                        const Overrides& overrides)
{
    PresentCase out;
    auto control = dictionary::Dictionary::readFile(folder.dictionaryPath(controlFile));
    auto schemes = dictionary::Dictionary::readFile(folder.dictionaryPath(schemesFile));
    overrides.apply(controlFile, control);
    overrides.apply(schemesFile, schemes);
    const RunTime time(control);
    const auto word = [&](const char* name, const char* fallback) {
        return schemes.found(name) ? schemes.get<std::string>({name, ""}) : std::string(fallback);
    };
    const auto number = [&](const char* name, double fallback) {
        return output::shortest(schemes.found(name) ? schemes.get<double>({name, ""}) : fallback);
    };
    auto& s = out.setting;
    s.shape = word("shape", "uGIMP");
    s.transfer = word("transfer", "FLIP");
    s.order = s.transfer == "XPIC" || s.transfer == "FMPM" ? number("order", 2) : "";
    s.picRate = number("picRate", 0);
    s.stressUpdate = word("stressUpdate", "MUSL");
    s.staggeredStart = schemes.found("staggeredStart") && schemes.get<bool>({"staggeredStart", ""}) ? "yes" : "no";
    s.timeIntegration = word("timeIntegration", "symplecticEuler");
    s.splitting = schemes.found("splitting");
    s.cellSize = state.grid.h;
    s.particlesPerCell = std::max(1L, std::lround(state.grid.h / state.seedSpacing[0]));
    s.deltaT = time.deltaT();
    s.courant = time.adjustable() ? time.maxCo() : waveSpeed * s.deltaT / s.cellSize;
    out.adjustable = time.adjustable();
    out.endTime = time.endTime();
    out.step = state.step;
    return out;
}

Overrides overridesFor(const AccuracyRow& row, const PresentCase& present, const std::string& reason)
{
    Overrides out(reason);
    const auto &now = present.setting, &then = row.setting;
    const auto word = [&](const char* name, const std::string& from, const std::string& to) {
        const auto x = parseNumber(from), y = parseNumber(to);
        if (from != to && !(x && y && *x == *y))
            out.set(schemesFile, name, to);
    };
    word("shape", now.shape, then.shape);
    word("transfer", now.transfer, then.transfer);
    word("order", now.order, then.order);
    if (then.transfer == "FLIP")
        word("picRate", now.picRate, then.picRate);
    else if (now.transfer == "FLIP" && now.picRate != "0")
        out.set(schemesFile, "picRate", ""); // a word of FLIP alone
    word("stressUpdate", now.stressUpdate, then.stressUpdate);
    word("staggeredStart", now.staggeredStart, then.staggeredStart);
    word("timeIntegration", now.timeIntegration, then.timeIntegration);
    if (now.splitting && !then.splitting)
        out.set(schemesFile, "splitting", "");
    if (present.adjustable && now.courant != then.courant)
        out.set(controlFile, "maxCo", output::shortest(then.courant));
    else if (!present.adjustable && std::abs(now.deltaT - then.deltaT) > 1e-9 * then.deltaT)
        out.set(controlFile, "deltaT", output::shortest(then.deltaT));
    return out;
}

std::filesystem::path accuracyTablePath(const CaseDirectory& folder)
{
    return (folder.folder() / "postProcessing" / "accuracyCost.csv").lexically_normal();
}

void requireSameCase(const ErrorTable& table, const CaseDirectory& folder, const PresentCase& present)
{
    const auto refuse = [&](const std::string& found) {
        throw InputError(
            {table.file().string()},
            fmt::format("found {}; allowed: the table of this case and version. Run accuracyCost again", found));
    };
    for (const auto& row : table.rows())
    {
        if (versionOf(row.version) != projectVersion())
            refuse(fmt::format("row {} of libmpm {}, this is {}", row.name, versionOf(row.version), projectVersion()));
        if (std::abs(row.endTime - present.endTime) > 2 * row.setting.deltaT) // a run ends within a step of endTime
            refuse(fmt::format("row {} of a run to {:g} s, endTime is {:g} s", row.name, row.endTime, present.endTime));
        if (row.setting.splitting && !present.setting.splitting)
            refuse(fmt::format("row {} with splitting, which system/mpmSchemes does not have", row.name));
        for (const std::string file : {"materialProperties", "boundaryConditions", "g", "bodyForce"})
        {
            const auto copy = folder.folder() / "accuracyCost" / row.name / "constant" / file;
            const auto own = "constant/" + file;
            if (std::filesystem::exists(copy) &&
                (!folder.hasFile(own) || dictionary::Dictionary::readFile(copy).text() !=
                                             dictionary::Dictionary::readFile(folder.dictionaryPath(own)).text()))
                refuse(fmt::format("row {} with another {} (accuracyCost/{})", row.name, own, row.name));
        }
    }
}

Lines expectedErrorLines(const CaseDirectory& folder, const Options& options, const PresentCase& present)
{
    if (!std::filesystem::exists(accuracyTablePath(folder)))
    {
        if (options.has("errorMeasure"))
            throw InputError("-errorMeasure: found no postProcessing/accuracyCost.csv; run accuracyCost first");
        return {};
    }
    const ErrorTable table(accuracyTablePath(folder), options.value("errorMeasure"));
    try
    {
        requireSameCase(table, folder, present);
    }
    catch (const InputError& error)
    {
        return {{"error", fmt::format("not known: {}", error.what())}};
    }
    const auto expected = table.expect(present.setting);
    if (!expected)
        return {{"error", fmt::format("not known: no row of {} was done", table.file().filename().string())}};
    return {{"error", fmt::format("{} about {:.2g}: {}", table.measure(), expected->error, expected->basis)}};
}

bool wantsPick(const Options& options)
{
    if (options.has("withinTime") && options.has("withinError"))
        throw InputError("found both '-withinTime' and '-withinError', allowed one of them");
    for (const std::string name : {"withinTime", "withinError"})
        if (options.has(name))
            positiveNumber(options, name);
    return options.has("withinTime") || options.has("withinError");
}

namespace
{
/// A row that was looked at, and what it will take here.
struct Candidate
{
    const AccuracyRow* row;
    Overrides overrides;
    std::optional<Seconds> predicted; ///< after a rehearsal
};

/// Looks for the row; knows how fast this machine is once a row was rehearsed.
class Picker
{
  public:
    Picker(const CaseDirectory& folder, const Options& options)
        : folder_(folder), options_(options), table_(accuracyTablePath(folder), options.value("errorMeasure")),
          byTime_(options.has("withinTime")), limit_(options.number(byTime_ ? "withinTime" : "withinError", 0)),
          reason_(fmt::format("-{} {}", byTime_ ? "withinTime" : "withinError", output::shortest(limit_)))
    {
        present_ = SolverRun(folder, options).presentCase();
        if (present_.step > 0)
            throw InputError(
                fmt::format("{}: found a run that has done {} steps; allowed before the first step: startFrom "
                            "firstTime in system/controlDict and -overwrite, or mpmSolve without the "
                            "option to go on",
                            reason_, present_.step));
        requireSameCase(table_, folder, present_);
        for (const auto& row : table_.rows())
            if (row.setting.sameSeeding(present_.setting))
                candidates_.push_back({&row, overridesFor(row, present_, reason_), std::nullopt});
    }

    Overrides pick()
    {
        if (candidates_.empty())
            failSeeding();
        const Candidate& best = byTime_ ? mostAccurate() : cheapest();
        print(best);
        return best.overrides;
    }

  private:
    /// Seconds a candidate will take, from its own steps; the table knows how many particles splitting made.
    void rehearse(Candidate& c)
    {
        SolverRun run(folder_, options_, c.overrides);
        const auto p = run.rehearse();
        if (!p.rehearsal.fault.empty())
        {
            c.predicted = Seconds{HUGE_VAL, HUGE_VAL};
            return;
        }
        const double particleSteps = double(p.particles) * p.count.steps;
        const Seconds stepping = (c.row->setting.splitting ? c.row->particleSteps / particleSteps : 1.0) * p.stepping;
        factor_ = stepping.wall / c.row->cpuSeconds;
        Seconds seconds = p.rehearsal.start;
        seconds += stepping;
        seconds += p.output;
        c.predicted = seconds;
    }

    /// "in about 12 s", where this machine's speed is known.
    std::string timeText(const AccuracyRow& row) const
    {
        return factor_ ? "in about " + formatDuration(*factor_ * row.cpuSeconds)
                       : fmt::format("in {} where the table was made", formatDuration(row.cpuSeconds));
    }

    /// What a row is likely to take, here.
    double scaled(const AccuracyRow& row) const { return factor_.value_or(1 / fasterMachine) * row.cpuSeconds; }

    Candidate& mostAccurate()
    {
        std::stable_sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
            return std::pair(a.row->bound(), a.row->cpuSeconds) < std::pair(b.row->bound(), b.row->cpuSeconds);
        });
        for (auto& c : candidates_)
        {
            if (scaled(*c.row) > hopeless * limit_)
                continue;
            rehearse(c);
            if (c.predicted->wall <= limit_)
                return c;
        }
        auto& least = *std::min_element(candidates_.begin(), candidates_.end(), [](const auto& a, const auto& b) {
            return a.row->cpuSeconds < b.row->cpuSeconds;
        });
        if (!least.predicted)
            rehearse(least);
        throw InputError(
            fmt::format("{}: found no setting that fast in {} with this seeding ({} rows); the cheapest is "
                        "predicted to take {}, {}{}",
                        reason_, table_.file().string(), candidates_.size(), formatDuration(least.predicted->wall),
                        rowText(*least.row), otherSeeding(nullptr)));
    }

    Candidate& cheapest()
    {
        std::stable_sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
            return std::pair(a.row->cpuSeconds, a.row->bound()) < std::pair(b.row->cpuSeconds, b.row->bound());
        });
        for (auto& c : candidates_)
            if (c.row->bound() <= limit_)
            {
                rehearse(c);
                return c;
            }
        const auto& least = *std::min_element(candidates_.begin(), candidates_.end(), [](const auto& a, const auto& b) {
            return a.row->bound() < b.row->bound();
        });
        throw InputError(fmt::format("{}: found no setting that accurate in {} with this seeding ({} rows); the most "
                                     "accurate has {} {:.3g}, {}{}",
                                     reason_, table_.file().string(), candidates_.size(), table_.measure(),
                                     least.row->bound(), rowText(*least.row), otherSeeding(nullptr)));
    }

    /// Rows of other seedings that keep the limit and do better than the pick (or than nothing).
    const AccuracyRow* betterElsewhere(const AccuracyRow* pick) const
    {
        const AccuracyRow* best = nullptr;
        const auto key = [&](const AccuracyRow& row) { return byTime_ ? row.bound() : row.cpuSeconds; };
        for (const auto& row : table_.rows())
        {
            const bool fits = byTime_ ? factor_.value_or(1) * row.cpuSeconds <= limit_ : row.bound() <= limit_;
            if (fits && !row.setting.sameSeeding(present_.setting) && (!pick || key(row) < key(*pick)) &&
                (!best || key(row) < key(*best)))
                best = &row;
        }
        return best;
    }

    std::string otherSeeding(const AccuracyRow* pick) const
    {
        const auto* row = betterElsewhere(pick);
        if (!row)
            return "";
        return fmt::format("\n    another seeding does: {} {:.3g} {}, {}\n    it needs {}", table_.measure(),
                           row->bound(), timeText(*row), rowText(*row), seedingLines(*row));
    }

    [[noreturn]] void failSeeding() const
    {
        const auto* near = table_.nearest(present_.setting);
        const auto& s = present_.setting;
        throw InputError(fmt::format(
            "{}: found a state with cells of {:g} m and {} particles per cell and axis, allowed one that {} has rows "
            "for{}",
            reason_, s.cellSize, s.particlesPerCell, table_.file().string(),
            near ? fmt::format("; the nearest is {}, which needs {}", rowText(*near), seedingLines(*near))
                 : std::string(" (it has none that was done)")));
    }

    void print(const Candidate& best) const
    {
        const auto line = [](const char* what, const std::string& text) { fmt::print("  {:<14} {}\n", what, text); };
        fmt::print("mpmSolve {}\n", reason_);
        line("picked", rowText(*best.row));
        line("why", fmt::format("{} of {} rows with this seeding{}: {} {:.3g}, predicted {} on this machine",
                                byTime_ ? "the most accurate" : "the cheapest", candidates_.size(),
                                byTime_ ? fmt::format(" predicted to take at most {:g} s", limit_)
                                        : fmt::format(" with an error of at most {:g}", limit_),
                                table_.measure(), best.row->bound(), formatDuration(best.predicted->wall)));
        line("dictionaries", best.overrides.empty() ? "say so already"
                                                    : "stay as they are; this run takes " + best.overrides.describe());
        if (const auto* other = betterElsewhere(best.row))
        {
            line("better still",
                 fmt::format("{} {:.3g} {}: {}", table_.measure(), other->bound(), timeText(*other), rowText(*other)));
            line("", "it needs " + seedingLines(*other));
        }
        fmt::print("\n");
    }

    const CaseDirectory& folder_;
    const Options& options_;
    ErrorTable table_;
    bool byTime_;
    double limit_;
    std::string reason_;
    PresentCase present_;
    std::vector<Candidate> candidates_;
    std::optional<double> factor_; ///< wall seconds here over processor seconds of the table
};
} // namespace

Overrides pickSetting(const CaseDirectory& folder, const Options& options)
{
    return Picker(folder, options).pick();
}
} // namespace mpm::cases

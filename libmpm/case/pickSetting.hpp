#pragma once
/// mpmSolve -withinTime SECONDS, -withinError ERROR: which setting to run with, from the table of accuracyCost.
///
/// -withinError picks the cheapest row whose error is at most ERROR; -withinTime the most accurate one that is
/// predicted to take at most SECONDS of wall time on this machine: the rows that could fit are rehearsed
/// (costPrediction.hpp), the most accurate first, and the first one's seconds over those of the table scale the others,
/// so that few rehearsals do. Error means AccuracyRow::bound(): not less than twice that of the reference.
///
/// What can be picked is what mpmSolve itself reads (mpmSchemes, deltaT and maxCo), so only rows with the cell size and
/// particles per cell of the seeded state are looked at; a row with another seeding that would do better is named with
/// the lines to change. The dictionaries stay as they are: the run takes the picked words as overrides (overrides.hpp).
///
/// Errors: both options; a number that is not > 0; a run that has begun; no table; a table of another case (endTime,
/// constant/) or version; nothing that fits, with what comes nearest.
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/costPrediction.hpp"
#include "case/errorTable.hpp"
#include "case/overrides.hpp"

namespace mpm::cases
{
/// The setting of a case with overrides: its dictionaries and, for the seeding, its state.
struct PresentCase
{
    RunSetting setting;
    bool adjustable = false;
    double endTime = 0; ///< [s]
    Index step = 0;     ///< steps done
};
PresentCase presentCase(const CaseDirectory& folder, const state::State& state, double waveSpeed,
                        const Overrides& overrides);

/// The words that make the present setting that of a row.
Overrides overridesFor(const AccuracyRow& row, const PresentCase& present, const std::string& reason);

/// Where accuracyCost leaves its table.
std::filesystem::path accuracyTablePath(const CaseDirectory& folder);
/// InputError unless the table is of this case and version.
void requireSameCase(const ErrorTable& table, const CaseDirectory& folder, const PresentCase& present);

/// Lines (what, text).
using Lines = std::vector<std::pair<std::string, std::string>>;

/// What the table says about the present setting, where there is one: the line -dry-run adds.
Lines expectedErrorLines(const CaseDirectory& folder, const Options& options, const PresentCase& present);

/// Is one of the options there? InputError: both, numbers that are none.
bool wantsPick(const Options& options);
/// Picks, prints why, returns the words to run with (none: the dictionaries have them).
Overrides pickSetting(const CaseDirectory& folder, const Options& options);
} // namespace mpm::cases

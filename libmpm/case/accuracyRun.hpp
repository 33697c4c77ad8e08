#pragma once
/// Runs the rows of the matrix: seedParticles and mpmSolve in each row's own case folder, with one thread.
///
/// A row that was run is known by <row>/result.csv, which is written last and whole; its key (accuracyCase.hpp) tells
/// whether it still holds. Whatever a killed program left of a row is removed and the row run again.
///
/// The price of a row is the processor time of mpmSolve's steps (row `processor` of its profile.csv: all threads, from
/// the first step on, without history rows and state files), the smallest of several repeats: processor time is what a
/// busy machine disturbs least, and what disturbs it can only add.
#include "case/accuracyCase.hpp"

#include <functional>

namespace mpm::cases
{
struct RowResult
{
    std::string key;
    std::string status; ///< done | refused | failed; empty: not run
    std::string reason;
    double cpuSeconds = 0, wallSeconds = 0;
    Index repeats = 0, sideBySide = 1;
    Index particles = 0, steps = 0;
    double particleSteps = 0, endTime = 0;
    std::string machine;
    bool done() const { return status == "done"; }
};

struct RunOptions
{
    Index repeats = 0; ///< 0: three where a run takes less than a second, one otherwise
    int sideBySide = 1;
    bool again = false; ///< do not take over rows that were run before
    std::function<bool()> stopped;
};

/// Results in the order of the rows; where `stopped` came true, rows without status are left.
std::vector<RowResult> runRows(const AccuracyCase& base, const std::vector<MatrixRow>& rows, const RunOptions& options);

/// What is stored of a row, if it was run with this key.
RowResult storedResult(const AccuracyCase& base, const MatrixRow& row, const std::string& key);

/// The processor's name, or "unknown".
std::string machineName();
} // namespace mpm::cases

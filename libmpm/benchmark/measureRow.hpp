#pragma once
/// One row of the benchmark: the time of a step on the refined column (column.hpp), as mpmSolve takes it.
///
/// After 20 steps that are not counted (the first sorts), blocks of steps are timed, each of a whole number of sort
/// intervals; a block is charged the energy budget and the history row that a run writes every 100 steps (its own
/// measured cost, steps/100 times). Of the blocks the median counts; the fastest and slowest are shown. Blocks stay
/// between 0.5 and 0.75 s of the collapse: small columns go back to 0.5 s in between, which is not timed.
///
/// Memory: resident set (/proc/self/statm) after the blocks less that before the column was made, over particles; free
/// memory is given back to the system before both (malloc_trim, trimAligned). It holds state, stepper and their
/// temporary copies that stay allocated, not those of a sort.
///
/// The naive step is timed on the same column with one thread; its blocks are three, of at least three steps.
#include "benchmark/column.hpp"
#include "benchmark/roofline.hpp"
#include "benchmark/settings.hpp"

#include <map>
#include <optional>

namespace mpm::benchmark
{
/// Seconds a particle and step.
struct Timing
{
    double median = 0, fastest = 0, slowest = 0;
};

struct Row
{
    Setting setting;
    Index particles = 0; ///< measured, at the start
    Timing ours;
    std::optional<Timing> naive;
    std::vector<std::pair<std::string, double>> passes; ///< share of the time a pass takes; "other" is the rest
    double residentBytes = 0;                           ///< a particle
    double columnBytes = 0;                             ///< a particle, of the columns of the state
    double yielding = 0;           ///< share of particles on the yield surface, mean of the blocks' ends
    double triad = 0, fmaPeak = 0; ///< [B/s], [flop/s]
    Work work;

    /// Achieved rates [B/s], [flop/s] by the counts of roofline.hpp, and the share of the roofline.
    double bandwidth() const { return work.bytes / ours.median; }
    double flopRate() const { return work.flops / ours.median; }
    double rooflineShare() const { return rooflineSeconds(work, triad, fmaPeak) / ours.median; }
};

/// Measures rows; keeps columns, peaks and naive times for the rows of one process.
class Bench
{
  public:
    Row measure(const Setting& setting);

  private:
    struct Peaks
    {
        double triad, fma;
    };
    const Peaks& peaks(int threads);
    const Timing& naive(const Setting& setting, const ColumnSize& size);

    ColumnCache columns_;
    std::map<int, Peaks> peaks_;
    std::map<std::string, Timing> naive_;
};
} // namespace mpm::benchmark

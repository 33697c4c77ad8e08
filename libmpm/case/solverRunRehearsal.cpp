// How a run of the solver is rehearsed: its own steps on its own state, which is of no use afterwards. Nothing is
// written; what would go into files goes into memory.
#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/memory.hpp"
#include "case/costPrediction.hpp"
#include "case/makeStepper.hpp"
#include "case/solverRun.hpp"
#include "case/strainRecorder.hpp"
#include "output/memoryFile.hpp"
#include "output/stateFile.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
constexpr double leastSeconds = 0.2, mostSeconds = 2, share = 0.05; ///< of the rehearsal; of the run it predicts
constexpr double widened = 1.5;                                     ///< [cells] domains that reach a fourth node
constexpr Index leastSteps = 6, fewestBatches = 5, mostBatches = 400;
constexpr Index wholeState = 100000; ///< particles above which a part of the state stands for it

template <class Body>
Seconds secondsOf(const Body& body)
{
    const Seconds begin = processSeconds();
    body();
    return processSeconds() - begin;
}

/// The median of a few runs of something short.
template <class Body>
Seconds shortSeconds(const Body& body, int times)
{
    std::vector<Seconds> all;
    for (int i = 0; i < times; ++i)
        all.push_back(secondsOf(body));
    return spreadOf(all).median;
}

double secondsAllowed(const Seconds& predicted)
{
    return std::clamp(share * predicted.wall, leastSeconds, mostSeconds);
}
} // namespace

/// One step as step() takes it. False: it failed, and what is left is of no use.
bool SolverRun::rehearseStep(std::string& fault)
{
    monitor_->remember(state_);
    if (recorder_)
        recorder_->before(state_);
    try
    {
        fault = tryStep();
    }
    catch (const StepError& error)
    {
        fault = error.what();
    }
    if (fault.empty() && recorder_)
        recorder_->after(state_);
    return fault.empty();
}

/// Batches of whole sort intervals; where not even a few of them fit, single steps, and the sort apart.
/// Batches of whole sort intervals for `allowed` seconds; where not even a few of them fit, single steps, and the sort
/// apart. `guess`: wall seconds of a step. What lies beyond the end of the run is not rehearsed, unless `beyond` says
/// so.
Spread SolverRun::rehearseBatches(Rehearsal& r, double guess, double allowed, bool beyond)
{
    const Index interval = scene_.scene.sortInterval;
    std::vector<Seconds> batches;
    Seconds sorted;
    const double begin = now();
    const auto ready = [&] { return r.fault.empty() && (beyond || !done()); };
    const auto step = [&] { return ready() && rehearseStep(r.fault) && (++r.steps, true); };
    const auto wanted = [&](Index fewest) {
        return ready() && Index(batches.size()) < mostBatches &&
               (Index(batches.size()) < fewest || now() - begin < allowed);
    };
    const auto add = [&](Seconds seconds, Index steps) {
        if (r.fault.empty() && steps > 0)
            batches.push_back(1 / (double(steps) * double(state_.particles.size())) * seconds);
    };
    const bool whole = double(fewestBatches * interval) * guess <= allowed;
    while (whole && wanted(fewestBatches))
    {
        Index taken = 0;
        const Seconds seconds = secondsOf([&] {
            while (taken < interval && step())
                ++taken;
        });
        add(seconds, taken);
    }
    while (!whole && wanted(leastSteps))
        if (state_.step % interval == 0)
            sorted = 1 / double(state_.particles.size()) * secondsOf(step);
        else
            add(secondsOf(step), 1);
    const Seconds more = sorted - spreadOf(batches).median;
    for (auto& seconds : batches)
        seconds += (whole ? 0 : 1 / double(interval)) * Seconds{std::max(0.0, more.cpu), std::max(0.0, more.wall)};
    r.batches += Index(batches.size());
    return spreadOf(batches);
}

void SolverRun::rehearseSteps(Rehearsal& r, double steps, double start)
{
    const double begin = now();
    // Warm-up: what the first step allocates and sorts, and on to the next sort if that takes no longer than a batch.
    Seconds last;
    const auto step = [&] { last = secondsOf([&] { r.steps += rehearseStep(r.fault); }); };
    step();
    for (Index i = 1; r.fault.empty() && !done() && i < scene_.scene.sortInterval && now() - begin < 0.2 * leastSeconds;
         ++i)
        step();
    const bool widens = widensWithStretch(scene_.shape);
    const double allowed = secondsAllowed({0, start + steps * last.wall}) / (widens ? 2 : 1);
    r.particleStep = rehearseBatches(r, last.wall, allowed, false);
    if (r.batches == 0 && r.fault.empty()) // the run is over with the warm-up
    {
        r.particleStep = spreadOf({1 / double(state_.particles.size()) * last});
        r.batches = 1;
    }
    if (!widens || !r.fault.empty())
        return;
    // The same with domains wider than a cell along the first axis. What stress does with them does not matter here.
    auto& p = state_.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        p.length0[0][i] = state::Stored(widened * state_.grid.h / std::max(0.1, std::abs(double(p.F[0][i]))));
    stepper_->particlesChanged();
    Rehearsal wide;
    rehearseStep(wide.fault);
    const Spread spread = rehearseBatches(wide, last.wall, allowed, true);
    r.steps += wide.steps;
    if (wide.batches > 0)
        r.wideParticleStep = spread;
}

void SolverRun::rehearseOutput(Rehearsal& r)
{
    const output::MemoryFile rows;
    history_ =
        std::make_unique<output::CsvSeries>(output::CsvSeries::rehearsal(rows.path(), stepping::historyColumns()));
    budget_ = std::make_unique<output::CsvSeries>(output::CsvSeries::rehearsal(rows.path(), stepping::budgetColumns()));
    constexpr int times = 5;
    r.row = shortSeconds([&] { writeRow(); }, times);
    r.rowBytes = rows.bytes() / times;
    history_.reset();
    budget_.reset();
    state_.provenance["dictionaries"] = scene_.dictionaries;
    if (recorder_)
        recorder_->remember(state_);
    const Index count = state_.particles.size();
    if (count <= wholeState)
    {
        r.state = shortSeconds([&] { r.stateBytes = output::rehearseState(state_); }, 3);
        return;
    }
    const auto large = firstParticles(state_, wholeState), small = firstParticles(state_, wholeState / 2);
    double largeBytes = 0, smallBytes = 0;
    const Seconds more = secondsOf([&] { largeBytes = output::rehearseState(large); }),
                  less = secondsOf([&] { smallBytes = output::rehearseState(small); });
    const double factor = double(count - wholeState) / double(wholeState - wholeState / 2);
    r.stateBytes = largeBytes + factor * (largeBytes - smallBytes);
    r.state = more;
    r.state += factor * Seconds{std::max(0.0, more.cpu - less.cpu), std::max(0.0, more.wall - less.wall)};
}

PresentCase SolverRun::presentCase() const
{
    return cases::presentCase(folder_, state_, stepping::fastestWave(state_, scene_.scene.materials), overrides_);
}

CostPrediction SolverRun::rehearse()
{
    CostPrediction p;
    Rehearsal& r = p.rehearsal;
    const Seconds begin = processSeconds();
    r.start = {begin.cpu, profile_.elapsed()};
    const double allowed = allowedStep(limit_),
                 first = state_.step == 0 ? std::min(allowed, runTime_->deltaT()) : allowed;
    p.count = countRun(*runTime_, state_.time, state_.step, first, allowed);
    if (runTime_->adjustable())
    {
        const double loosened = std::sqrt(2.0); // of the wave speed, in twice the volume
        const auto later = stepping::movedLimit(limit_, loosened * restWaveSpeed_, state_,
                                                limit_.speed + fallSpeed(state_, scene_.scene.gravity));
        const double slow = std::min(allowed, allowedStep(later));
        p.mostSteps = countRun(*runTime_, state_.time, state_.step, std::min(first, slow), slow).steps;
    }
    if (state_.step == 0 && !done())
        ++p.count.rows; // of the state it starts from
    p.deltaT = runTime_->nextStep(state_.time, allowed);
    p.purge = double(runTime_->purgeWrite());
    describeState(p, state_, scene_.scene.splitting);
    r.peakBytes = peakMemory();
    if (done())
        return p;
    const output::MemoryFile strains;
    if (recorder_)
        recorder_->rehearse(strains.path());
    rehearseSteps(r, p.count.steps, r.start.wall);
    r.stepBytes = r.steps > 0 ? strains.bytes() / double(r.steps) : 0;
    r.peakBytes = peakMemory();
    if (r.fault.empty())
    {
        rehearseOutput(r);
        const double inMemory = std::min(r.stateBytes, r.stateBytes / double(p.particles) * double(wholeState));
        r.peakBytes = std::max(r.peakBytes, peakMemory() - inMemory); // of the file, which the run has on a disk
    }
    r.seconds = processSeconds().wall - begin.wall;
    addUp(p);
    return p;
}
} // namespace mpm::cases

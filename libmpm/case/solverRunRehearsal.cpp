// How a run of the solver is rehearsed: its own steps on its own state, which is of no use afterwards. Nothing is
// written; what would go into files goes into memory.
#include "base/error.hpp"
#include "base/memory.hpp"
#include "case/costPrediction.hpp"
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
void SolverRun::rehearseSteps(Rehearsal& r, double steps, double start)
{
    const Index interval = scene_.scene.sortInterval;
    const double particles = double(state_.particles.size());
    std::vector<Seconds> batches, plain;
    const Seconds begin = processSeconds();
    const auto elapsed = [&] { return processSeconds().wall - begin.wall; };
    const auto step = [&] { return rehearseStep(r.fault) && (++r.steps, true); };

    // Warm-up: what the first step allocates and sorts, and on to the next sort if that takes no more than a batch.
    Seconds first = secondsOf(step);
    double guess = first.wall;
    for (Index i = 1; r.fault.empty() && i < interval && elapsed() < 0.2 * leastSeconds; ++i)
        guess = secondsOf(step).wall;
    const double allowed = secondsAllowed({0, start + steps * guess});
    if (double(fewestBatches * interval) * guess > allowed)
    {
        while (r.fault.empty() && (Index(plain.size()) < leastSteps || elapsed() < allowed))
            if (const bool sorts = state_.step % interval == 0; sorts)
                first = secondsOf(step);
            else
                plain.push_back(secondsOf(step));
        if (!r.fault.empty() && !plain.empty())
            plain.pop_back();
        const Seconds usual = spreadOf(plain).median, more = first - usual;
        for (auto& seconds : plain)
            seconds += 1 / double(interval) * Seconds{std::max(0.0, more.cpu), std::max(0.0, more.wall)};
        batches = std::move(plain);
    }
    else
        while (r.fault.empty() && Index(batches.size()) < mostBatches &&
               (Index(batches.size()) < fewestBatches || elapsed() < allowed))
        {
            const Seconds all = secondsOf([&] {
                for (Index i = 0; i < interval && step(); ++i)
                {}
            });
            if (r.fault.empty())
                batches.push_back(1 / double(interval) * all);
        }
    for (auto& seconds : batches)
        seconds = 1 / particles * seconds;
    r.batches = Index(batches.size());
    r.particleStep = spreadOf(batches);
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
    const double now = allowedStep(limit_), first = state_.step == 0 ? std::min(now, runTime_->deltaT()) : now;
    p.count = countRun(*runTime_, state_.time, state_.step, first, now);
    if (runTime_->adjustable())
    {
        const auto falling = stepping::movedLimit(limit_, restWaveSpeed_, state_,
                                                  limit_.speed + fallSpeed(state_, scene_.scene.gravity));
        const double slow = allowedStep(falling);
        p.fallSteps = countRun(*runTime_, state_.time, state_.step, std::min(first, slow), slow).steps;
    }
    if (state_.step == 0 && !done())
        ++p.count.rows; // of the state it starts from
    p.deltaT = runTime_->nextStep(state_.time, now);
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
    if (r.fault.empty())
        rehearseOutput(r);
    r.peakBytes = peakMemory();
    r.seconds = processSeconds().wall - begin.wall;
    addUp(p);
    return p;
}
} // namespace mpm::cases

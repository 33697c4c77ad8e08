#include "case/solverRun.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/processorClock.hpp"
#include "case/expressionForce.hpp"
#include "case/makeStepper.hpp"
#include "case/provenance.hpp"
#include "case/strainRecorder.hpp"
#include "output/stateFile.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{

SolverRun::SolverRun(const CaseDirectory& folder, const Options& options, const Overrides& overrides)
    : folder_(folder), options_(options), overrides_(overrides), series_(folder.folder(), folder.name())
{
    const std::string controlFile = "system/controlDict";
    auto control = dictionary::Dictionary::readFile(folder.dictionaryPath(controlFile));
    runTime_.emplace(control);
    auto record = StrainRecorder::wanted(control);
    monitor_.emplace(control, runTime_->adjustable(), !record.empty());
    const auto fields = readFields(control);
    control.rejectUnread();
    const TimeFolder start = startFolder();
    lastStored_ = start.name;
    laterTimes_ = laterTimes(start);
    state_ = output::readState(folder.statePath(start.name));
    if (state_.step > 0)
        overrides_ = Overrides::recall(state_);
    overrides_.apply(controlFile, control);
    runTime_.emplace(control);
    if (state_.particles.size() == 0)
        throw InputError(folder.statePath(start.name).string() + ": found no particles; run seedParticles");
    scene_ = readScene(folder, state_, overrides_);
    if (fields)
        provideReference(state_, *fields);
    scene_.dictionaries += "// system/controlDict\n" + control.text();
    stepper_ = makeStepper(scene_.shape, state_, scene_.scene);
    stepping::beginLedger(state_, scene_.scene.materials);
    monitor_->begin(state_, scene_.scene);
    restWaveSpeed_ = stepping::fastestWave(state_, scene_.scene.materials);
    limit_ = stabilityLimit();
    if (runTime_->adjustable() && scene_.scene.rest && scene_.scene.rest->follow)
        throw InputError(
            control.where("adjustTimeStep"),
            "adjustTimeStep: found yes beside rest { follow yes; }; allowed: no, as what sleeps takes long "
            "steps of a fixed time");
    const bool goesOn = state_.step > 0 && state_.deltaT == runTime_->deltaT(); // an uninterrupted run would, too
    if (!runTime_->adjustable() && runTime_->deltaT() > limit_.deltaT && !goesOn)
        throw InputError(
            control.where("deltaT"),
            fmt::format(
                "deltaT: found {:g} s; allowed: at most {:.4g} s for {} with {} at c_p = {:.1f} m/s, |v| = {:.3g} m/s "
                "and h = {:g} m, or adjustTimeStep yes",
                runTime_->deltaT(), limit_.deltaT, stepping::methodText(scene_.scene), scene_.shape, limit_.waveSpeed,
                limit_.speed, state_.grid.h));
    const auto strains = StrainRecorder::recall(state_);
    if (!record.empty())
    {
        recorder_ = std::make_unique<StrainRecorder>(std::move(record), state_, control.where("recordStrain"));
        recorder_->resume(strains);
    }
    written_.emplace(folder, runTime_->purgeWrite(), runTime_->timePrecision());
    written_->goOnFrom(state_, lastStored_);
    peakTime_ = firstTime_ = state_.time;
    peakKinetic_ = state_.ledger.kineticEnergy;
    firstLedger_ = state_.ledger;
    firstStep_ = writtenStep_ = limitStep_ = state_.step;
}

SolverRun::~SolverRun() = default;

TimeFolder SolverRun::startFolder() const
{
    if (folder_.times().empty())
        throw InputError(folder_.folder().string() + ": found no time folder with a state.h5; run seedParticles first");
    switch (runTime_->start())
    {
    case RunTime::Start::first:
        return folder_.firstTime();
    case RunTime::Start::given:
        return folder_.nearestTime(runTime_->startTime());
    case RunTime::Start::latest:
        return folder_.latestTime();
    }
    return folder_.latestTime();
}

/// Going on from an earlier time would mix two runs: later times must be given up on purpose.
std::vector<std::string> SolverRun::laterTimes(const TimeFolder& start) const
{
    std::vector<std::string> later;
    for (const auto& time : folder_.times())
        if (time.value > start.value)
            later.push_back(time.name);
    if (!later.empty() && !options_.overwrite)
        throw InputError(
            fmt::format("{}: found stored times after the start at {}: {}; allowed: startFrom latestTime to go "
                        "on from the last, or -overwrite to remove them",
                        folder_.folder().string(), start.name, joinWords(later, " and ")));
    return later;
}

void SolverRun::openSeries(std::optional<double> continueAt)
{
    const auto out = folder_.postProcessing();
    history_ = std::make_unique<output::CsvSeries>(out / "history.csv", stepping::historyColumns(), continueAt);
    budget_ = std::make_unique<output::CsvSeries>(out / "energyBudget.csv", stepping::budgetColumns(), continueAt);
    if (std::any_of(scene_.scene.walls.begin(), scene_.scene.walls.end(), [](const auto& w) { return w.motion; }) ||
        !scene_.scene.bodies.empty())
    {
        actors_ = std::make_unique<ActorSeries>(scene_.scene);
        actors_->open(out, continueAt);
    }
}

void SolverRun::openOutput()
{
    folder_.requireWritable();
    folder_.removeLeftovers();
    written_->tidy();
    for (const auto& time : folder_.times()) // damaged ones are told now, not when the first state is written
        output::readSummary(folder_.statePath(time.name));
    const bool fresh = state_.step == 0;
    // A run that ended here wrote its last row out of turn; the uninterrupted run has none.
    const bool outOfTurn = state_.step % runTime_->historyInterval() != 0 && !done();
    const auto continueAt = fresh ? std::nullopt : std::optional(state_.time - (outOfTurn ? 0.5 * state_.deltaT : 0.0));
    openSeries(continueAt);
    if (recorder_)
        recorder_->open(folder_.postProcessing() / "strainPaths.csv", state_,
                        fresh ? std::nullopt : std::optional(state_.time));
    for (const auto& name : laterTimes_)
        folder_.removeTime(name);
    if (!history_->lastTime()) // a new series begins with the state it starts from
        writeRow();
    recordRun(state_, scene_.dictionaries);
    overrides_.remember(state_);
    if (done())
        writeSeries(); // a run killed at its very end may lack it
    progress_ = std::make_unique<Progress>("mpmSolve", state_.time, runTime_->endTime());
    profile_.beginSteps(stepper_->times());
}

stepping::StabilityLimit SolverRun::stabilityLimit() const
{
    return stepping::stabilityLimit(*stepper_, state_, scene_.scene, limitIgnoresMass(scene_.shape));
}

/// maxCo bounds the Courant number with the particles' own speed; the stability limit is kept with a margin.
double SolverRun::allowedStep(const stepping::StabilityLimit& limit) const
{
    return state_.stepFactor * runTime_->boundedStep(limit, state_.grid.h);
}

double SolverRun::stepSize() const
{
    if (!runTime_->adjustable())
        return runTime_->nextStep(state_.time, 0);
    const double wanted = allowedStep(limit_);
    return runTime_->nextStep(state_.time, state_.step == 0 ? std::min(wanted, runTime_->deltaT()) : wanted);
}

/// Follows stiffness (nodal masses, expansion) and speed where the step adapts to them.
double SolverRun::nextStep()
{
    const Clock clock(profile_.timeStep);
    if (runTime_->adjustable())
    {
        if (stepping::limitFollowsMass(scene_.scene, limitIgnoresMass(scene_.shape)))
            limit_ = stabilityLimit();
        else if (state_.step != limitStep_) // the report is of a step that was kept
            limit_ = stepping::movedLimit(limit_, restWaveSpeed_, state_, stepper_->report().largestSpeed);
    }
    return stepSize();
}

/// Takes a step; says what is wrong with it, or nothing.
std::string SolverRun::tryStep()
{
    timeBefore_ = state_.time;
    try
    {
        stepper_->step(nextStep());
    }
    catch (const OutsideGrid& error)
    {
        giveUp(error.what());
    }
    catch (const StepError& error)
    {
        return error.what();
    }
    const Clock clock(profile_.monitor);
    const auto limit = stepping::movedLimit(limit_, restWaveSpeed_, state_, stepper_->report().largestSpeed);
    const auto found = monitor_->look(state_, stepper_->report(), limit);
    return found.empty() ? found : fmt::format("step {} at time {:.9g} s: {}", state_.step, state_.time, found);
}

void SolverRun::goBack(const std::string& why)
{
    if (monitor_->goBack(state_))
    {
        finishWriting(); // it uses the series
        stepper_->particlesChanged();
        limit_ = stabilityLimit();
        limitStep_ = state_.step;
        openSeries(state_.time);
        lastStored_ = written_->goBack(state_.time); // states of the way given up
        writtenStep_ = -1;
        writeSeries();
        return;
    }
    giveUp(why +
           (monitor_->adapts() ? fmt::format(" (so it is with {:g} times the time step)", state_.stepFactor) : ""));
}

void SolverRun::giveUp(const std::string& why)
{
    progress_.reset();
    std::string alsoFailed;
    try
    {
        finishWriting();
    }
    catch (const InputError& error)
    {
        alsoFailed = fmt::format("\n    and {}", error.what());
    }
    throw StepError(
        fmt::format("{}{}\n    the last stored time is {}; nothing after it was kept", why, alsoFailed, lastStored_));
}

void SolverRun::step()
{
    const Clock clock(stepSeconds_);
    {
        const Clock watching(profile_.monitor);
        monitor_->remember(state_);
    }
    if (recorder_)
        recorder_->before(state_);
    for (auto fault = tryStep(); !fault.empty(); fault = tryStep())
        goBack(fault);
    smallestStep_ = smallestStep_ > 0 ? std::min(smallestStep_, state_.deltaT) : state_.deltaT;
    largestStep_ = std::max(largestStep_, state_.deltaT);
    profile_.countStep(state_.particles.size());
    if (state_.ledger.kineticEnergy > peakKinetic_)
    {
        peakKinetic_ = state_.ledger.kineticEnergy;
        peakTime_ = state_.time;
    }
}

void SolverRun::writeIfDue()
try
{
    if (writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        finishWriting(); // a failure is told at once
    if (recorder_)
        recorder_->after(state_);
    const bool last = done();
    if (state_.step % runTime_->historyInterval() == 0 || last)
        writeRow();
    if (runTime_->writeNow(timeBefore_, state_.time, state_.step))
        writeState();
    if (progress_->due(state_.time))
        progress_->update(state_.time, fmt::format("t {:.4g} s  dt {:.3g} s  {} particles", state_.time, state_.deltaT,
                                                   state_.particles.size()));
}
catch (const InputError& error)
{
    failWriting(error);
}

void SolverRun::writeRow()
{
    const Clock clock(profile_.history);
    const ProcessorClock processor(profile_.apartProcessor);
    const auto totals = stepping::totals(state_, scene_.scene.materials);
    history_->write(stepping::historyRow(state_, totals, stepper_->report()));
    budget_->write(stepping::budgetRow(state_, totals));
    if (actors_)
        actors_->writeRow(state_.time, stepper_->report());
}

void SolverRun::writeState(bool outOfTurn)
{
    const Clock clock(profile_.output);
    const ProcessorClock processor(profile_.apartProcessor);
    finishWriting();
    writingName_ = written_->next(state_, outOfTurn);
    writtenStep_ = state_.step;
    if (recorder_)
        recorder_->remember(state_);
    const auto pending = std::make_shared<output::PendingState>(folder_.timePath(writingName_), state_);
    writing_ = std::async(std::launch::async, [this, pending] {
        history_->synchronise(); // a state on disk has its rows there
        budget_->synchronise();
        if (actors_)
            actors_->synchronise();
        if (recorder_)
            recorder_->synchronise();
        pending->commit();
        lastStored_ = writingName_; // read after finishWriting only
        written_->committed();
        writeSeries();
    });
}

void SolverRun::writeSeries()
{
    std::vector<std::string> names;
    std::vector<std::pair<std::string, double>> times;
    for (const auto& time : folder_.times())
    {
        names.push_back(time.name);
        times.emplace_back(time.name, time.value);
    }
    series_.write(names);
    if (actors_)
        actors_->writeSurfaces(folder_.postProcessing(), times);
}

/// Throws what went wrong meanwhile.
void SolverRun::finishWriting()
{
    if (!writing_.valid())
        return;
    writing_.get();
}

} // namespace mpm::cases

#include "coupling/soil.hpp"

#include "base/error.hpp"
#include "case/expressionForce.hpp"
#include "case/makeStepper.hpp"
#include "case/provenance.hpp"
#include "case/strainRecorder.hpp"
#include "output/stateFile.hpp"

#include <fmt/format.h>

namespace mpm::coupling
{
using namespace mpm::cases;

namespace
{
constexpr const char* controlFile = "system/controlDict";

TimeFolder startOf(const CaseDirectory& folder, const RunTime& runTime)
{
    if (folder.times().empty())
        throw InputError(folder.folder().string() + ": found no time folder with a state.h5; run seedParticles first");
    const auto start = runTime.start() == RunTime::Start::first   ? folder.firstTime()
                       : runTime.start() == RunTime::Start::given ? folder.nearestTime(runTime.startTime())
                                                                  : folder.latestTime();
    for (const auto& time : folder.times())
        if (time.value > start.value)
            throw InputError(fmt::format("{}: found the stored time {} after the start at {}; allowed: startFrom "
                                         "latestTime, or a copy of the case without it",
                                         folder.folder().string(), time.name, start.name));
    return start;
}
} // namespace

Soil::Soil(const std::filesystem::path& caseFolder, const Overrides& overrides)
    : folder_(caseFolder), overrides_(overrides), series_(folder_.folder(), folder_.name())
{
    auto control = dictionary::Dictionary::readFile(folder_.dictionaryPath(controlFile));
    overrides_.apply(controlFile, control);
    runTime_.emplace(control);
    if (const auto record = StrainRecorder::wanted(control); !record.empty())
        throw InputError(control.where("recordStrain"),
                         "recordStrain: found it in a case that is coupled; allowed with mpmSolve alone: leave it "
                         "out, or have a setting take it away");
    monitor_.emplace(control, runTime_->adjustable(), true);
    const auto fields = readFields(control);
    control.rejectUnread();
    deltaTAt_ = control.where("deltaT");
    startName_ = startOf(folder_, *runTime_).name;
    state_ = output::readState(folder_.statePath(startName_));
    if (state_.particles.size() == 0)
        throw InputError(folder_.statePath(startName_).string() + ": found no particles; run seedParticles");
    StrainRecorder::recall(state_);
    scene_ = readScene(folder_, state_, overrides_);
    if (fields)
        provideReference(state_, *fields);
    scene_.dictionaries += "// system/controlDict\n" + control.text();
    storedTime_ = acceptedTime_ = state_.time;
}

stepping::StabilityLimit Soil::limitNow() const
{
    return stepping::stabilityLimit(*stepper_, state_, scene_.scene, limitIgnoresMass(scene_.shape));
}

void Soil::begin()
{
    folder_.requireWritable();
    stepper_ = makeStepper(scene_.shape, state_, scene_.scene);
    restWaveSpeed_ = stepping::fastestWave(state_, scene_.scene.materials);
    limit_ = limitNow();
    if (!runTime_->adjustable() && runTime_->deltaT() > limit_.deltaT)
        throw InputError(*deltaTAt_, fmt::format("deltaT: found {:g} s; allowed: at most {:.4g} s for {} with {}, or "
                                                 "adjustTimeStep yes",
                                                 runTime_->deltaT(), limit_.deltaT, stepping::methodText(scene_.scene),
                                                 scene_.shape));
    lock_ = std::make_unique<CaseLock>(folder_.folder(), "a coupled simulation");
    stepping::beginLedger(state_, scene_.scene.materials);
    monitor_->begin(state_, scene_.scene);
    written_.emplace(folder_, runTime_->purgeWrite(), runTime_->timePrecision());
    written_->goOnFrom(state_, startName_);
    recordRun(state_, scene_.dictionaries);
    overrides_.remember(state_);
    startStep_ = state_.step;
    if (startStep_ == 0) // a new series begins with the state it starts from
        addRow();
}

double Soil::largestStep() const
{
    if (!runTime_->adjustable())
        return runTime_->deltaT();
    const double allowed = runTime_->boundedStep(limit_, state_.grid.h);
    return state_.step == 0 ? std::min(allowed, runTime_->deltaT()) : allowed;
}

void Soil::step(double dt)
{
    const double before = state_.time;
    stepper_->step(dt);
    const bool anew = stepping::limitFollowsMass(scene_.scene, limitIgnoresMass(scene_.shape));
    limit_ = anew ? limitNow() : stepping::movedLimit(limit_, restWaveSpeed_, state_, report().largestSpeed);
    if (const auto found = monitor_->look(state_, report(), limit_); !found.empty())
        throw StepError(fmt::format("step {} at time {:.9g} s: {}", state_.step, state_.time, found));
    due_ = due_ || runTime_->inTurn(before, state_.time, state_.step);
    if (state_.step % runTime_->historyInterval() == 0)
        addRow();
}

void Soil::addRow()
{
    const auto now = totals();
    rows_.push_back({state_.time, stepping::historyRow(state_, now, report()), stepping::budgetRow(state_, now), {}});
    rows_.back().report.actors = report().actors;
}

/// The stepper is made anew, as in a run that starts from this state: what it keeps between steps follows from it.
void Soil::goBack(const state::State& state)
{
    state_ = state;
    stepper_ = makeStepper(scene_.shape, state_, scene_.scene);
    limit_ = limitNow();
    std::erase_if(rows_, [&](const Row& row) { return row.time > state_.time; });
    due_ = runTime_->inTurn(storedTime_, state_.time, state_.step);
    if (state_.time >= acceptedTime_)
        return;
    acceptedTime_ = state_.time;
    if (!outputBegun())
        return;
    openSeries(state_.time);
    written_->goBack(state_.time);
    storedTime_ = std::min(storedTime_, state_.time);
}

void Soil::openSeries(std::optional<double> continueAt)
{
    const auto out = folder_.postProcessing();
    history_ = std::make_unique<output::CsvSeries>(out / "history.csv", stepping::historyColumns(), continueAt);
    budget_ = std::make_unique<output::CsvSeries>(out / "energyBudget.csv", stepping::budgetColumns(), continueAt);
    if (!scene_.scene.bodies.empty() || std::any_of(scene_.scene.walls.begin(), scene_.scene.walls.end(),
                                                    [](const auto& wall) { return bool(wall.motion); }))
    {
        actors_ = std::make_unique<ActorSeries>(scene_.scene);
        actors_->open(out, continueAt);
    }
}

void Soil::accept()
{
    if (!outputBegun())
    {
        folder_.removeLeftovers();
        written_->tidy();
        openSeries(startStep_ == 0 ? std::nullopt : std::optional(acceptedTime_));
    }
    for (const auto& row : rows_)
    {
        history_->write(row.history);
        budget_->write(row.budget);
        if (actors_)
            actors_->writeRow(row.time, row.report);
    }
    rows_.clear();
    acceptedTime_ = state_.time;
    if (due_)
        writeState(state_, false);
    due_ = false;
}

void Soil::store(const state::State& state)
{
    if (state.time == storedTime_)
        return;
    state::State copy = state;
    writeState(copy, true);
}

void Soil::writeState(state::State& state, bool outOfTurn)
{
    const auto name = written_->next(state, outOfTurn);
    output::PendingState pending(folder_.timePath(name), state);
    history_->synchronise();
    budget_->synchronise();
    pending.commit();
    written_->committed();
    storedTime_ = state.time;
    storedName_ = name;
    std::vector<std::string> names;
    for (const auto& time : folder_.times())
        names.push_back(time.name);
    series_.write(names);
}

void Soil::end()
{
    history_.reset();
    budget_.reset();
    actors_.reset();
    lock_.reset();
}

stepping::Totals Soil::totals() const
{
    return stepping::totals(state_, scene_.scene.materials);
}
} // namespace mpm::coupling

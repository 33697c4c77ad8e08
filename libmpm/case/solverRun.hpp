#pragma once
/// A run of the solver in a case folder: what mpmSolve does between its banner and its summary.
///
/// `fields (referencePosition);` of system/controlDict: states hold /particles/referencePosition, where each particle
/// started; so they do where a formula uses X, Y or Z (case/expressionForce.hpp).
///
/// Nothing is written before everything was read and checked. A state is written whole or not at all; when a step
/// fails, the last stored time is named and untouched.
#include "base/terminal.hpp"
#include "case/actorSeries.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/costPrediction.hpp"
#include "case/effectPrices.hpp"
#include "case/overrides.hpp"
#include "case/pickSetting.hpp"
#include "case/readScene.hpp"
#include "case/runMonitor.hpp"
#include "case/runProfile.hpp"
#include "case/runTime.hpp"
#include "case/writtenTimes.hpp"
#include "output/csvSeries.hpp"
#include "output/paraviewSeries.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/timeStep.hpp"

#include <future>
#include <optional>

namespace mpm::cases
{
class StrainRecorder;

/// Is it option -effects? Throws InputError for options that make no sense beside it.
bool wantsEffects(const Options& options);

class SolverRun
{
  public:
    /// Reads the dictionaries and the state, builds the stepper, refuses an unstable deltaT. A run that goes on takes
    /// the overrides of its state.
    SolverRun(const CaseDirectory& folder, const Options& options, const Overrides& overrides = {});
    ~SolverRun();

    /// What was chosen, one line a fact.
    void banner() const;
    /// Setting, end and steps done.
    PresentCase presentCase() const;
    /// What the run will cost, from steps that are thrown away: the run itself is of no use afterwards. Writes nothing.
    CostPrediction rehearse();
    /// The same on the screen.
    void printPrediction(const CostPrediction& prediction) const;
    /// Option -effects: what the effects of the scene, and all others, cost at this state (case/effectPrices.hpp), as a
    /// table on the screen, or with -markdown the page docs/effects.md. Writes nothing.
    void printEffects() const;
    /// Begins postProcessing/history.csv and energyBudget.csv, or continues them.
    void openOutput();
    bool done() const { return runTime_->done(state_.time); }
    /// One step that the monitor finds good. With `action adapt` the run may go back before it, and its rows in
    /// postProcessing with it.
    void step();
    /// History rows, states, the ParaView series and progress, as far as they are due. A state is copied to its file
    /// here; that the file has reached the disk and takes its place is waited for at the next one, or at the end.
    void writeIfDue();
    /// After a signal: the state is written out of turn (writtenTimes.hpp), one message on stderr says where the run
    /// stopped and how to go on. Returns the exit code.
    int stop(int signal);
    /// What happened, what it cost, what should be looked at. Option -profile: postProcessing/profile.csv.
    void summary();

  private:
    TimeFolder startFolder() const;
    std::vector<std::string> laterTimes(const TimeFolder& start) const;
    stepping::StabilityLimit stabilityLimit() const;
    double allowedStep(const stepping::StabilityLimit& limit) const;
    double stepSize() const;
    bool rehearseStep(std::string& fault);
    Spread rehearseBatches(Rehearsal& rehearsal, double guess, double allowed, bool beyond);
    void rehearseSteps(Rehearsal& rehearsal, double steps, double start);
    void rehearseOutput(Rehearsal& rehearsal);
    double nextStep();
    std::string tryStep();
    void goBack(const std::string& why);
    [[noreturn]] void giveUp(const std::string& why);
    void openSeries(std::optional<double> continueAt);
    void writeRow();
    void writeState(bool outOfTurn = false);
    void writeSeries();
    void finishWriting();
    [[noreturn]] void failWriting(const InputError& error);
    void warnings() const;
    EffectRun effectRun() const;
    std::vector<const Effect*> usedEffects() const;
    std::string deeds() const;

    RunProfile profile_; ///< first: its time begins with the run's
    const CaseDirectory& folder_;
    const Options& options_;
    Overrides overrides_;
    std::optional<RunTime> runTime_;
    state::State state_;
    SceneOfCase scene_;
    std::unique_ptr<stepping::Stepper> stepper_;
    stepping::StabilityLimit limit_;
    std::optional<RunMonitor> monitor_;
    double restWaveSpeed_ = 0;
    std::unique_ptr<StrainRecorder> recorder_;
    std::unique_ptr<output::CsvSeries> history_, budget_;
    std::unique_ptr<ActorSeries> actors_; ///< null: nothing moves as prescribed
    std::unique_ptr<Progress> progress_;
    std::string lastStored_;
    std::vector<std::string> laterTimes_; ///< to be removed when the run begins
    output::ParaviewSeries series_;
    std::optional<WrittenTimes> written_;
    std::future<void> writing_; ///< the disk takes the state `writingName_` while steps go on
    std::string writingName_;
    double firstTime_ = 0, timeBefore_ = 0, peakKinetic_ = 0, peakTime_ = 0;
    double stepSeconds_ = 0;
    state::Ledger firstLedger_;                 ///< of the state the run began with
    double smallestStep_ = 0, largestStep_ = 0; ///< [s]
    Index firstStep_ = 0, writtenStep_ = 0;
    Index limitStep_ = 0; ///< the step limit_ was made anew at
};
} // namespace mpm::cases

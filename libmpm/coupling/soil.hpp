#pragma once
/// The case a participant steps: its dictionaries, state, stepper and files. What mpmSolve's run (case/solverRun.hpp)
/// is on the command line, without a word on the screen, and with a master that says how far.
#include "case/actorSeries.hpp"
#include "case/caseDirectory.hpp"
#include "case/caseLock.hpp"
#include "case/overrides.hpp"
#include "case/readScene.hpp"
#include "case/runMonitor.hpp"
#include "case/runTime.hpp"
#include "case/writtenTimes.hpp"
#include "output/csvSeries.hpp"
#include "output/paraviewSeries.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/timeStep.hpp"

#include <optional>

namespace mpm::coupling
{
class Soil
{
  public:
    /// Reads and checks the case; writes nothing. InputError: all that mpmSolve refuses, stored times after the start,
    /// recordStrain.
    Soil(const std::filesystem::path& caseFolder, const cases::Overrides& overrides);

    const cases::CaseDirectory& folder() const { return folder_; }
    const state::State& state() const { return state_; }
    state::State& state() { return state_; }
    stepping::Scene& scene() { return scene_.scene; }
    const stepping::Scene& scene() const { return scene_.scene; }
    const std::string& shape() const { return scene_.shape; }

    /// With all surfaces in the scene: makes the stepper, takes the lock, refuses an unstable deltaT.
    void begin();
    /// The largest step allowed now [s]: deltaT, or what adjustTimeStep makes of the stability limit.
    double largestStep() const;
    /// One step; a StepError is what the step or the monitor finds wrong. Rows that are due wait for accept().
    void step(double dt);
    /// Puts a state back; rows and files after it are given up.
    void goBack(const state::State& state);

    /// The way up to now stands: rows go to disk, and the state if it is due.
    void accept();
    /// The accepted state as the last stored time.
    void store(const state::State& state);
    /// Is a state to be written at the next accept()?
    bool due() const { return due_; }
    /// Did it begin with a state of step 0?
    bool fresh() const { return startStep_ == 0; }
    /// The last time folder written in this run; empty: none.
    const std::string& storedName() const { return storedName_; }
    /// Lets go of files and the lock.
    void end();
    bool outputBegun() const { return history_ != nullptr; }
    stepping::Totals totals() const;
    const stepping::StepReport& report() const { return stepper_->report(); }

  private:
    struct Row
    {
        double time;
        std::vector<double> history, budget;
        stepping::StepReport report;
    };
    void addRow();
    void openSeries(std::optional<double> continueAt);
    void writeState(state::State& state, bool outOfTurn);
    stepping::StabilityLimit limitNow() const;

    cases::CaseDirectory folder_;
    cases::Overrides overrides_;
    std::optional<cases::RunTime> runTime_;
    std::optional<cases::RunMonitor> monitor_;
    state::State state_;
    cases::SceneOfCase scene_;
    std::optional<Location> deltaTAt_;
    std::unique_ptr<cases::CaseLock> lock_;
    std::unique_ptr<stepping::Stepper> stepper_;
    stepping::StabilityLimit limit_;
    double restWaveSpeed_ = 0;
    std::string startName_, storedName_;
    Index startStep_ = 0;
    std::unique_ptr<output::CsvSeries> history_, budget_;
    std::unique_ptr<cases::ActorSeries> actors_;
    std::optional<cases::WrittenTimes> written_;
    output::ParaviewSeries series_;
    std::vector<Row> rows_;   ///< not accepted yet
    double acceptedTime_ = 0; ///< [s]
    double storedTime_ = 0;   ///< [s] of the last state on disk
    bool due_ = false;        ///< is a state to be written at the next accept()?
};
} // namespace mpm::coupling

#pragma once
/// The monitor of a run (stepping/monitor.hpp) and what is done about its findings: the dictionary `monitor` of
/// system/controlDict, and with `action adapt` the copy of the state a run goes back to.
///
/// adapt: every 50 steps the state is copied in memory (the price: its size again). On a finding, or when the step
/// itself fails, the run goes back to the copy and takes half the time step (State::stepFactor) from there; every 200
/// steps the factor doubles until it is 1 again. Where 1/64 of the step does not help, the run ends as with `stop`.
/// A run cut by a restart is bitwise the uninterrupted one unless it goes back over the cut.
#include "dictionary/dictionary.hpp"
#include "stepping/monitor.hpp"
#include "stepping/timeStep.hpp"

#include <memory>

namespace mpm::cases
{
class RunMonitor
{
  public:
    /// Reads `monitor`, if it is there. adjustable: adjustTimeStep yes, which `adapt` needs, and with which it is the
    /// default unless strain paths are recorded: those cannot go back.
    RunMonitor(const dictionary::Dictionary& controlDict, bool adjustable, bool records);

    void begin(const state::State& state, const stepping::Scene& scene);
    bool adapts() const { return rule_.action == stepping::MonitorAction::adapt; }

    /// Before a step.
    void remember(state::State& state);
    /// After a step; empty: go on. `warn` prints a finding here, once each.
    std::string look(const state::State& state, const stepping::StepReport& report,
                     const stepping::StabilityLimit& limit);
    /// adapt: puts the last copy back with half the step factor. False if it has come to 1/64, or was not asked for.
    bool goBack(state::State& state);

    /// "stop at 25 % of energy from nowhere".
    std::string describe() const;
    /// Lines of the summary: extremes; how often the run went back or warned; steps over the stability limit.
    std::vector<std::pair<std::string, std::string>> summary() const;

  private:
    static constexpr Index stride = 50, recovery = 200;
    static constexpr double smallestAllowed = 1.0 / 64;

    stepping::MonitorRule rule_;
    std::unique_ptr<stepping::Monitor> monitor_;
    std::unique_ptr<state::State> good_;
    Index wentBack_ = 0, warnings_ = 0;
    double smallestFactor_ = 1;
};
} // namespace mpm::cases

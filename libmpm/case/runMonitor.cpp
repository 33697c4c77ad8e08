#include "case/runMonitor.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using stepping::MonitorAction;

RunMonitor::RunMonitor(const dictionary::Dictionary& controlDict, bool adjustable, bool records)
{
    const bool mayGoBack = adjustable && !records;
    rule_.action = mayGoBack ? MonitorAction::adapt : MonitorAction::stop;
    const auto* d = controlDict.findDict("monitor", "what to do about energy from nowhere and the like");
    if (!d)
        return;
    const auto action = d->choose("action", "what happens on a finding",
                                  {{"stop", "the run ends, exit code 2; the last stored state is good"},
                                   {"adapt", "back to the last good step, then half the time step"},
                                   {"warn", "a message, once, and on"}},
                                  mayGoBack ? "adapt" : "stop");
    if (action == "adapt" && !adjustable)
        d->fail("action", "adapt with adjustTimeStep no", "stop or warn, or adjustTimeStep yes");
    if (action == "adapt" && records)
        d->fail("action", "adapt beside recordStrain, whose paths cannot go back", "stop or warn, or no recordStrain");
    rule_.action = action == "stop"   ? MonitorAction::stop
                   : action == "warn" ? MonitorAction::warn
                                      : MonitorAction::adapt;
    rule_.energyTolerance =
        d->get<double>({"energyTolerance",
                        "energy from nowhere over the energy that was there, supplied or dissipated",
                        {},
                        Bound::positive(),
                        rule_.energyTolerance});
}

void RunMonitor::begin(const state::State& state, const stepping::Scene& scene)
{
    monitor_ = std::make_unique<stepping::Monitor>(state, scene, rule_);
}

void RunMonitor::remember(state::State& state)
{
    if (!adapts() || (good_ && (state.step % stride != 0 || state.step == good_->step)))
        return;
    if (state.step > 0 && state.step % recovery == 0) // also where a restart begins
        state.stepFactor = std::min(1.0, 2 * state.stepFactor);
    good_ = std::make_unique<state::State>(state);
}

std::string RunMonitor::look(const state::State& state, const stepping::StepReport& report,
                             const stepping::StabilityLimit& limit)
{
    const auto finding = monitor_->look(state, report, limit);
    if (finding.text.empty() || rule_.action != MonitorAction::warn || finding.fatal)
        return finding.text;
    if (warnings_++ == 0)
        std::fputs(
            fmt::format("--> mpmSolve: warning: step {} at time {:.9g} s: {}\n", state.step, state.time, finding.text)
                .c_str(),
            stderr);
    return {};
}

bool RunMonitor::goBack(state::State& state)
{
    if (!good_ || good_->stepFactor <= smallestAllowed)
        return false;
    good_->stepFactor *= 0.5;
    smallestFactor_ = std::min(smallestFactor_, good_->stepFactor);
    ++wentBack_;
    state = *good_;
    return true;
}

std::string RunMonitor::describe() const
{
    const char* action = rule_.action == MonitorAction::stop    ? "stop"
                         : rule_.action == MonitorAction::adapt ? "adapt"
                                                                : "warn";
    return fmt::format("{} at {:g} % of energy from nowhere", action, 100 * rule_.energyTolerance);
}

std::vector<std::pair<std::string, std::string>> RunMonitor::summary() const
{
    const auto& e = monitor_->extremes();
    std::vector<std::pair<std::string, std::string>> lines;
    lines.emplace_back("monitor",
                       fmt::format("det F >= {:.3g}, (c_p + |v|) deltaT/h <= {:.3f}, nodal mass >= {:.2g} of "
                                   "a full node, yield <= {:.1g}, energy from nowhere <= {:.2g} %",
                                   e.jacobian, e.courant, e.nodalMass, std::max(0.0, e.yieldViolation),
                                   100 * e.energyFromNowhere));
    if (wentBack_ > 0)
        lines.emplace_back("note",
                           fmt::format("the run went back {} times and took up to {:g} times smaller steps there",
                                       wentBack_, 1 / smallestFactor_));
    if (warnings_ > 0)
        lines.emplace_back("note", fmt::format("the monitor found fault with {} steps", warnings_));
    if (e.limitUse > 1.000001)
        lines.emplace_back("note",
                           fmt::format("deltaT came to {:.2f} of the stability limit, which falls as soil loosens, "
                                       "speeds up or (USL, linear) leaves nodes",
                                       e.limitUse));
    return lines;
}
} // namespace mpm::cases

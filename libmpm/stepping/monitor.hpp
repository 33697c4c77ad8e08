#pragma once
/// Watches a run for what physics does not explain. Looks at sums the step makes anyway, after every step, so that a
/// wrong run is found within a few steps and no state is written after it.
///
///     energy      used = K + U + plastic + friction + damping + splitting, K kinetic and U strain energy now;
///                 given = K + U at the start + work of gravity, loads, body forces and moving walls +
///                 finiteStrainWork
///                 (energyBudget.hpp). used - given is energy that came from nowhere. Allowed: energyTolerance times
///                 all energy that was there, supplied or dissipated. What is lost in transfer and impact (each takes
///                 what the other gives back) and what time integration holds back for half a step (staggering) is left
///                 out of `used`, so that an unstable step and a transfer that makes energy are both seen: the residual
///                 would close over either.
///     balance     |momentum - initial - impulses of walls, gravity, loads, damping| <= 1e-8 of their sizes, except
///     with
///                 prescribed body forces: anything else is a mistake of ours.
///     yield       f <= 1e-6 max(|sigma|, strength) after each return to the yield surface
///     finite      all of these are numbers
/// det F <= 0 and particles outside the grid are errors of the step itself (stepper.hpp).
/// Kept for the summary: smallest det F, smallest nodal mass, largest Courant number, largest yield violation, most
/// energy from nowhere.
///
/// Dictionary system/controlDict (all optional):
///     monitor
///     {
///         action           stop;   // stop: end the run, exit 2, the last stored state is good (default)
///                                  // adapt: go back to the last good step and halve deltaT (adjustTimeStep yes; there
///                                  //        the default)
///                                  // warn: say so once and go on
///         energyTolerance  0.25;   // [-]
///     }
/// Verified in tests/unit/monitor.cpp and by tests/stability/randomScenes.
#include "stepping/stepper.hpp"
#include "stepping/timeStep.hpp"

#include <string>

namespace mpm::stepping
{
enum class MonitorAction
{
    stop,
    adapt,
    warn
};

struct MonitorRule
{
    MonitorAction action = MonitorAction::stop;
    double energyTolerance = 0.25;
};

/// The extremes of a run so far.
struct Extremes
{
    double jacobian = 1;          ///< smallest det F
    double courant = 0;           ///< largest (c_p + |v|) dt/h
    double limitUse = 0;          ///< largest share of the stability limit of its moment
    double nodalMass = 0;         ///< smallest nodal mass over that of a full node
    double yieldViolation = 0;    ///< largest f/max(|sigma|, strength)
    double energyFromNowhere = 0; ///< largest share, as compared with energyTolerance
};

/// What is wrong with a step and what could help; an empty text while all is well.
struct Finding
{
    std::string text;
    bool fatal = false; ///< numbers are no longer finite: nobody can go on from there
};

class Monitor
{
  public:
    Monitor(const state::State& state, const Scene& scene, const MonitorRule& rule);

    /// After a step; `limit` is that of the state as it is now.
    Finding look(const state::State& state, const StepReport& report, const StabilityLimit& limit);

    const Extremes& extremes() const { return extremes_; }

  private:
    Finding energy(const state::Ledger& ledger, const StepReport& report);
    Finding balance(const state::State& state, const StepReport& report) const;

    MonitorRule rule_;
    bool bodyForces_;
    double mass_ = 0, fullNode_ = 0;
    Extremes extremes_;
};
} // namespace mpm::stepping

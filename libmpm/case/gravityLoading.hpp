#pragma once
/// Initial stress by gravity loading: from the seeded state, all loads act at once and the motion is damped until
/// forces balance (dynamic relaxation: A. S. Day 1965, The Engineer 219, 218-221; local damping: Cundall, see
/// nodal/localDamping.hpp; kinetic damping: P. A. Cundall 1976, Explicit finite-difference methods in geomechanics,
/// velocities go to zero whenever the kinetic energy passes a maximum).
///
/// At rest means: ratio = sum over nodes and components of |net force| over that of the internal forces and loads (at
/// least the weight) below `tolerance`, and nodal kinetic energy below `kineticTolerance` of the elastic energy. What
/// walls hold is no net force. The kinetic energy is that of velocities as they are projected to nodes: what no grid
/// sees does not count, nor what forces give to nodes next to nothing lies at. How bodies get there does not matter, so
/// the time of the motion has no meaning.
///
///     dynamicRelaxation            // system/gravityLoadingDict; all of it may be absent
///     {
///         damping           local; // local | kinetic
///         coefficient       0.7;   // local: share of the net force, [0, 1)
///         tolerance         1e-6;  // ratio at rest
///         kineticTolerance  1e-9;  // kinetic over elastic energy at rest
///     }
///     maxSteps       100000;
///     maxTime        10;           // [s] of motion; default: no bound
///     keepPositions  yes;          // yes: only stresses are kept; no: the deformed body is
///
/// keepPositions yes, as geotechnical codes do: positions, F, volumes and surfaces go back to those seeded. Stresses in
/// balance on the deformed body are so on the seeded one but for a share as small as the strains, so relaxation begins
/// anew from them until the seeded body is at rest with its stresses (two or three passes). History of laws other than
/// stress starts with the run. Not with hyperelastic laws, whose stress is that of F.
///
/// Velocities are zero in the end, and the ledger is empty: the run that follows begins at time 0, step 0. A body
/// without equilibrium (a slope that fails) comes to no rest: StepError after maxSteps or maxTime, nothing is written.
/// So where positions are kept and each pass moves the body as far as the one before. Splitting, merging,
/// staggeredStart, bulk viscosity, rest and Runge-Kutta steps do
/// not take part, and walls and rigid bodies that will move rest where they
/// start. Gravity must not come on by a ramp. Verified in
/// tests/verification/gravityLoading.
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/readScene.hpp"

#include <limits>

namespace mpm::cases
{
struct RelaxationRule
{
    bool kinetic = false;
    double coefficient = 0.7;
    double tolerance = 1e-6, kineticTolerance = 1e-9;
    Index maxSteps = 100000;
    double maxTime = std::numeric_limits<double>::infinity(); ///< [s]
    bool keepPositions = true;
};

class GravityLoading
{
  public:
    /// Reads and checks everything.
    GravityLoading(const CaseDirectory& folder, const Options& options);

    void banner() const;
    /// Throws StepError if the body comes to no rest.
    void run();
    void report() const;
    /// The state anew.
    void write();

  private:
    void refuse(const Options& options) const;
    bool relax();
    void putBack();
    void standStill();
    double ratioOf(const stepping::StepReport& report) const;
    double largestDisplacement() const;
    [[noreturn]] void giveUp(double ratio) const;

    const CaseDirectory& folder_;
    RelaxationRule rule_;
    std::string dictionary_, timeName_;
    state::State state_, seeded_;
    SceneOfCase scene_;
    double weight_ = 0;      ///< sum over axes of m |g_a| [N]
    double firstRatio_ = -1; ///< before anything moved
    double ratio_ = 0, displacement_ = 0, kinetic_ = 0, strain_ = 0, time_ = 0;
    Index steps_ = 0, passes_ = 0;
};
} // namespace mpm::cases

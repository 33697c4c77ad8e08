#pragma once
/// The energy budget (METHOD, Energy), every entry from its own formula, none the remainder of the others:
///     kineticEnergy        sum m v_p^2/2
///     strainEnergy         sum V 1/2 sigma : C^-1 : sigma; sum V0 W(F) of hyperelastic laws
///     plasticDissipation   sum V sigma_mid : dEps_p, sigma_mid the mean of the stresses before and after the step
///     frictionDissipation  - sum J_t . v* over friction walls, J_t the impulse of friction on a node
///     dampingDissipation   - sum J . (v_i + v*)/2, J the impulse of damping (nodal/damping.hpp)
///     wallLoss             sum m (v_i - v*)^2/2 where walls hold nodes: impact. Other forces on such nodes work on v*
///     contactFriction      - sum J_t . v* between bodies (nodal/contact.hpp); contactLoss is the rest of what they do
///                          to each other: m* (difference of v_i along the normal)^2/2 of an impact, m* the reduced
///                          mass
///     transferLoss         (change of grid KE) - (change of particle KE), and the work of stress on what projections
///                          change in the velocities it meets (ExplicitStepper::bookStressWork): v_i and v* in the
///                          forces, w in the strains
///     splitMergeLoss       kinetic and elastic energy lost by splitting and merging
///     relaxationLoss       sum V (u - u~) + V (s - s~) : e/2, s~ the stress before a step after relaxation
///     averagingLoss        sum (V s~ + V' S) : (e - e_a)/2 with e_a the strains after volumetric averaging; 0 where it
///                          is conjugate: forces then do their work on e_a
///     viscosityLoss        sum (V q + V' q') tr e/2, q the viscous normal stress of volumetric averaging in the forces
///     restLoss             sum m v_p^2/2 of particles that fall asleep (rest.hpp)
///     bulkViscosityLoss    sum (V q + V' q') tr e/2, q the pressure of bulk viscosity in the forces, negative
///     gapWork              sum V p_mid (g' - g) of tension gaps, given back when they close
///     motionWork           sum J . V of the impulses J that walls and bodies moving at V give to nodes; friction and
///                          impact are then those of the velocity relative to V
///     absorbedEnergy       - sum J . ((v_i + v*)/2 - V) of absorbing boundaries, V twice the velocity of a wave that
///                          comes in (nodal/absorbingBoundary.hpp)
///     gravityWork          sum dt m_i b . (v_i + v*)/2; tractionWork, bodyForceWork likewise
///     finiteStrainWork     elastic energy that finite steps of a rate law make out of nothing: with u the energy
///                          density, s the stress before a step, s' the same turned, S after it, V and V' the
///                          volumes, e = dt sym L the strain forces do work on and dEps the one the law sees
///                          (constitutive/kinematics.hpp),
///                          sum (u + u')/2 (V' - V) + (V + V')/2 (s' + S) : dEps/2 - (V s + V' S) : e/2.
///                          Of hyperelastic laws: the change of their energy less the work of the trapezoidal rule,
///                          sum V0 (W' - W) - (V s + V' S) : e/2, third order in dt
///     staggering           energy that velocities lack because they live half a step off the stresses, a function of
///                          the state: 1/2 sum dt V sigma : D_w (USL, MUSL), - 1/2 sum dt V sigma : D* (USF). A
///                          leapfrog keeps kinetic + strain energy - staggering, not their sum without it
///     residual             gravityWork + tractionWork + bodyForceWork + motionWork + finiteStrainWork + change of
///                          staggering - change of kineticEnergy - change of strainEnergy
///                          - all losses
/// Losses are positive when energy left the body. Leaving any entry out makes the residual grow by it. What remains is
/// the change of dt from step to step (a leapfrog keeps energy at constant steps only) and round-off.
#include "constitutive/material.hpp"
#include "state/state.hpp"
#include "stepping/stepper.hpp"

#include <string>
#include <vector>

namespace mpm::stepping
{
/// Books the initial energies and momentum of a state at step 0; does nothing later.
void beginLedger(state::State& state, const std::vector<constitutive::Material>& materials);

struct Extents
{
    Vector3 low{}, high{}; ///< of particle centres [m]; zero along unused axes
};

/// Totals over the particles of a state.
struct Totals
{
    double mass = 0, volume = 0;
    double kineticEnergy = 0, strainEnergy = 0; ///< [J], per metre in 2D
    Vector3 momentum{};                         ///< [N s]
    Extents extents;
};
Totals totals(const state::State& state, const std::vector<constitutive::Material>& materials);
/// Strain energy of `count` particles from `first` on.
double strainEnergy(const state::State& state, const std::vector<constitutive::Material>& materials, Index first,
                    Index count);

/// The mismatch of the budget [J].
double residual(const state::Ledger& ledger, double strainEnergy);

/// postProcessing/history.csv, SI units, in 2D per metre of thickness; energies are sums since the start.
const std::vector<std::string>& historyColumns();
std::vector<double> historyRow(const state::State& state, const Totals& totals, const StepReport& report);

/// postProcessing/energyBudget.csv: all entries of the budget, which add up to the residual.
const std::vector<std::string>& budgetColumns();
std::vector<double> budgetRow(const state::State& state, const Totals& totals);
} // namespace mpm::stepping

#pragma once
/// The energy budget (METHOD, Energy), every entry from its own formula, none the remainder of the others:
///     kineticEnergy        sum m v_p^2/2
///     strainEnergy         sum V 1/2 sigma : C^-1 : sigma
///     plasticDissipation   sum V sigma_mid : dEps_p, sigma_mid the mean of the stresses before and after the step
///     frictionDissipation  - sum dt f_t . (v_i + v*)/2 over friction walls
///     dampingDissipation   - sum J . (v_i + v*)/2, J the impulse of damping (nodal/damping.hpp)
///     wallLoss             - the same for all other wall forces (impact on walls)
///     transferLoss         (change of grid KE) - (change of particle KE), and in USF and MUSL, whose strains see a
///                          projected velocity w, - sum dt f_int . (v* - w)/2: the stress at both ends of a step works
///                          on w where the forces worked on v*
///     splitMergeLoss       energy lost by splitting
///     gravityWork          sum dt m_i b . (v_i + v*)/2; tractionWork, bodyForceWork likewise
///     residual             gravityWork + tractionWork + bodyForceWork
///                          - change of kineticEnergy - change of strainEnergy - all losses
/// Losses are positive when energy left the body. Leaving any entry out makes the residual grow by it.
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

/// The mismatch of the budget [J].
double residual(const state::Ledger& ledger, double strainEnergy);

/// postProcessing/history.csv, SI units, in 2D per metre of thickness; energies are sums since the start.
const std::vector<std::string>& historyColumns();
std::vector<double> historyRow(const state::State& state, const Totals& totals, const StepReport& report);

/// postProcessing/energyBudget.csv: all entries of the budget, which add up to the residual.
const std::vector<std::string>& budgetColumns();
std::vector<double> budgetRow(const state::State& state, const Totals& totals);
} // namespace mpm::stepping

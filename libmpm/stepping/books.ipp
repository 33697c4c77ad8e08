// What a step did, for the ledger of the state: sums of the tiles, and the work of stress.
#pragma once
#include "base/error.hpp"
#include "stepping/explicitStepper.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::stepping
{
/// Adds the tiles' sums in the order of the tiles and stops at the first bad particle.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::book(const Pass& pass)
{
    if (scene_.bodyForce)
        if (const auto fault = scene_.bodyForce->takeFault(); !fault.empty())
            throw StepError(fmt::format("step {} at time {:.9g} s: {}", state_.step, state_.time, fault));
    TileSums total;
    for (const auto& s : tileSums_)
    {
        if (s.badParticle >= 0)
            fail(s.badParticle,
                 "is turned inside out or no longer finite (det F <= 0): a smaller deltaT, finer particles "
                 "(splitting) or a stiffer material is needed there");
        total.kinetic += s.kinetic;
        total.plasticWork += s.plasticWork;
        total.apexVolume += s.apexVolume;
        total.bodyForceWork += s.bodyForceWork;
        total.bodyForceEnd += s.bodyForceEnd;
        total.strainWorkBefore += s.strainWorkBefore;
        total.strainWork += s.strainWork;
        total.strainEnergy += s.strainEnergy;
        total.finiteStrainWork += s.finiteStrainWork;
        total.relaxationLoss += s.relaxationLoss;
        total.averagingLoss += s.averagingLoss;
        total.viscosityLoss += s.viscosityLoss;
        total.gapWork += s.gapWork;
        total.bulkViscosityLoss += s.bulkViscosityLoss;
        for (int a = 0; a < dim; ++a)
            total.momentum[a] += s.momentum[a];
        total.fastest = std::max(total.fastest, s.fastest);
        total.largestJacobian = std::max(total.largestJacobian, s.largestJacobian);
        total.apexReturns += s.apexReturns;
        total.cappedDomains += s.cappedDomains;
        total.smallestJacobian = std::min(total.smallestJacobian, s.smallestJacobian);
        total.maxYield = std::max(total.maxYield, s.maxYield);
        total.stray = total.stray || s.stray;
    }
    auto& ledger = state_.ledger;
    if (pass.velocity)
    {
        ledger.transferLoss -= total.kinetic + resting_.kinetic - ledger.kineticEnergy;
        ledger.kineticEnergy = total.kinetic + resting_.kinetic;
        ledger.bodyForceWork += total.bodyForceWork;
        work_.ofForcesBefore += 2 * total.bodyForceWork - total.bodyForceEnd;
        work_.ofForces += total.bodyForceEnd;
        report_.momentum = total.momentum;
        for (int a = 0; a < dim; ++a)
            report_.momentum[a] += resting_.momentum[a];
        report_.largestSpeed = std::max(std::sqrt(total.fastest), actorSpeed());
    }
    if (pass.strain)
    {
        work_.ofStrainsBefore = total.strainWorkBefore;
        work_.ofStrains = total.strainWork;
        ledger.plasticDissipation += total.plasticWork;
        ledger.finiteStrainWork += total.finiteStrainWork;
        ledger.relaxationLoss += total.relaxationLoss;
        ledger.averagingLoss += total.averagingLoss;
        ledger.viscosityLoss += total.viscosityLoss;
        ledger.gapWork += total.gapWork;
        ledger.bulkViscosityLoss += total.bulkViscosityLoss;
        report_.strainEnergy = total.strainEnergy + restingEnergy_;
        state_.largestJacobian = total.largestJacobian;
        ledger.apexVolume += total.apexVolume;
        ledger.apexReturns += total.apexReturns;
        report_.smallestJacobian = total.smallestJacobian;
        report_.maxYieldViolation = total.maxYield;
        if (Shape::followsStretch || hasCorners)
            report_.cappedDomains = total.cappedDomains;
    }
    if (pass.then != Project::nothing)
    {
        projected_ = true;
        stray_ = total.stray;
    }
    if (pass.pressure)
        stray_ = total.stray;
}

/// The stress works on three velocities: v_i and v* in the nodal equations, w in the strains. What it does on the
/// changes that projections make between them is lost in transfer, half of it belonging to either end of a step:
///     USL, MUSL    1/2 sigma_n : (D* - D_w) and, from one step to the next, 1/2 sigma_n : (D_i - D_w of the last step)
///     USF          1/2 sigma_n+1 : (D_i - D_w) and 1/2 sigma_n : (D* of the last step - D_w)
/// What is left of the mismatch is a function of the state, the staggering: velocities live half a step off the
/// stresses. A step of another size than the last takes up another staggering than was left: the difference is lost in
/// transfer too.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::bookStressWork(double dt)
{
    auto& ledger = state_.ledger;
    const bool strainsFirst = scene_.stressUpdate == StressUpdate::USF;
    // the last step's work on this step's stress, and the same work as this step finds it
    const double found = strainsFirst ? work_.ofStrainsBefore : work_.ofForcesBefore;
    if (state_.step == 0)
    {
        ledger.pendingWork = found;
        ledger.initialStaggering = (strainsFirst ? -0.5 : 0.5) * found;
    }
    if (kick_ != dt) // half a kick at the start, then strains over the whole step
    {
        ledger.initialStaggering = 0.5 * (work_.ofForcesBefore - work_.ofForces);
        work_.ofForces *= dt / kick_;
    }
    if (strainsFirst)
        ledger.transferLoss += 0.5 * (work_.ofForcesBefore - work_.ofStrains + ledger.pendingWork - found);
    else
        ledger.transferLoss += 0.5 * (work_.ofForces - work_.ofStrainsBefore + found - ledger.pendingWork);
    ledger.pendingWork = strainsFirst ? work_.ofForces : work_.ofStrains;
    ledger.staggering = (strainsFirst ? -0.5 : 0.5) * ledger.pendingWork;
}
} // namespace mpm::stepping

#include "stepping/timeStep.hpp"

#include "stepping/rungeKutta.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::stepping
{
double criticalCourant(int dim, bool ignoresMass, StressUpdate update, double smallestNodalMassFraction)
{
    if (update == StressUpdate::USL)
    {
        const double full = dim == 2 ? 0.36 : 0.32;
        return ignoresMass ? full : std::min(full, 1.2 * std::sqrt(smallestNodalMassFraction));
    }
    return !ignoresMass ? 0.85 : dim == 2 ? 1.2 : 1.0;
}

namespace
{
bool carriesAffineField(const Scene& scene)
{
    return scene.transfer == Transfer::APIC || scene.transfer == Transfer::TPIC;
}
} // namespace

double methodCourant(int dim, bool ignoresMass, const Scene& scene, double smallestNodalMassFraction)
{
    if (scene.timeIntegration != TimeIntegration::symplecticEuler)
        return rungeKuttaCourant(
            scene.timeIntegration == TimeIntegration::RK4 ? RungeKuttaOrder::RK4 : RungeKuttaOrder::RK2, dim);
    const double plain = criticalCourant(dim, ignoresMass, scene.stressUpdate, smallestNodalMassFraction);
    if (scene.transfer == Transfer::FMPM && !scene.filterRate)
        return plain / std::sqrt(double(scene.transferOrder));
    if (!carriesAffineField(scene))
        return plain;
    return ignoresMass ? std::min(plain, dim == 2 ? 0.75 : 0.62)
                       : criticalCourant(dim, false, StressUpdate::USL, smallestNodalMassFraction);
}

double fastestWave(const state::State& state, const std::vector<constitutive::Material>& materials)
{
    std::vector<bool> used(materials.size(), false);
    for (Index i = 0; i < state.particles.size(); ++i)
        used[std::size_t(state.particles.material[std::size_t(i)])] = true;
    double fastest = 0;
    for (std::size_t m = 0; m < materials.size(); ++m)
        if (used[m])
            fastest = std::max(fastest, materials[m].waveSpeed());
    return fastest;
}

bool limitFollowsMass(const Scene& scene, bool ignoresMass)
{
    return !ignoresMass && scene.timeIntegration == TimeIntegration::symplecticEuler &&
           (scene.stressUpdate == StressUpdate::USL || carriesAffineField(scene));
}

StabilityLimit stabilityLimit(Stepper& stepper, const state::State& state, const Scene& scene, bool ignoresMass)
{
    StabilityLimit limit;
    const int dim = state.particles.dim;
    limit.courant = methodCourant(dim, ignoresMass, scene,
                                  limitFollowsMass(scene, ignoresMass) ? stepper.smallestNodalMassFraction() : 1.0);
    limit.hats = !ignoresMass;
    if (scene.bulkViscosity)
        limit.viscosity = *scene.bulkViscosity;
    return movedLimit(limit, fastestWave(state, scene.materials), state, stepper.largestSpeed());
}

StabilityLimit movedLimit(StabilityLimit limit, double restWaveSpeed, const state::State& state, double speed)
{
    limit.waveSpeed = restWaveSpeed * std::sqrt(state.largestJacobian);
    limit.speed = speed;
    const double reach = limit.waveSpeed + 3 * limit.speed;
    limit.deltaT = limit.courant * state.grid.h / reach *
                   (limit.hats ? limit.waveSpeed / std::min(reach, 7 * limit.waveSpeed) : 1);
    if (limit.viscosity.any())
        limit.deltaT *= treatment::bulkViscosityStepFactor(limit.viscosity, limit.speed, limit.waveSpeed);
    return limit;
}

std::string stressUpdateName(StressUpdate update)
{
    return update == StressUpdate::USF ? "USF" : update == StressUpdate::USL ? "USL" : "MUSL";
}
} // namespace mpm::stepping

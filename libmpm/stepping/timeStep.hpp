#pragma once
/// How large a time step may be.
///
/// Stability (METHOD, Stability limit): c_p dt/h must stay under a bound of the scheme, c_p = sqrt(M/rho) the largest
/// P-wave speed of the scene at rest, h the cell size. Bounds below are the smallest critical values of a free elastic
/// bar over all positions of the particles in their cells (spectral radius of the linearised step):
///                    linear                        GIMP, splines
///     USL            min(0.67, 1.8 sqrt(m_i/m))    0.65
///     USF, MUSL      1.4                           1.4
/// m_i/m is the smallest nodal mass over that of a full node: USL with hat functions loses stability as a node empties.
/// tests/verification/stabilityLimit.cpp checks them by power iteration on the step itself.
#include "stepping/stepper.hpp"

#include <string>

namespace mpm::stepping
{
/// Bound of c_p dt/h [-]. ignoresMass: the shape keeps its bound as nodes empty (all but hat functions).
double criticalCourant(bool ignoresMass, StressUpdate update, double smallestNodalMassFraction);

/// Fastest P wave of the materials in use [m/s].
double fastestWave(const state::State& state, const std::vector<constitutive::Material>& materials);

struct StabilityLimit
{
    double courant = 0;   ///< bound of c_p dt/h [-]
    double waveSpeed = 0; ///< c_p [m/s]
    double deltaT = 0;    ///< bound of dt [s]
};

/// Does the bound change as particles move? (USL with hat functions.)
bool limitFollowsMass(const Scene& scene, bool ignoresMass);

StabilityLimit stabilityLimit(Stepper& stepper, const state::State& state, const Scene& scene, bool ignoresMass);

/// "USF", "USL", "MUSL".
std::string stressUpdateName(StressUpdate update);
} // namespace mpm::stepping

#pragma once
/// How large a time step may be.
///
/// Stability (METHOD, Stability limit): (c_p + 2 |v|) dt/h must stay under a bound of the scheme; c_p = sqrt(M/rho) is
/// the largest P-wave speed, |v| the largest particle speed, h the cell size. With |v| particles cannot pass the reach
/// of a wave in one step, which impacts beyond the wave speed need. Bounds of c_p dt/h, for 2D and 3D:
///                    linear                        GIMP, splines
///     USL            min(0.36, 1.2 sqrt(m_i/m))    0.36
///     USF, MUSL      0.85                          1.4, in 3D 1.2
/// m_i/m is the smallest nodal mass over that of a full node: USL with hat functions loses stability as a node empties.
///
/// They lie under the smallest critical values of free elastic blocks over positions of the particles in their cells,
/// lattices and disordered ones, one particle a cell and many, Poisson's ratio 0 to 0.499 (spectral radius of the step
/// itself by power iteration, tests/verification/stabilityLimit.cpp). Bars in one dimension bear more: 0.65 to 0.75
/// with USL, 1.41 to 2.3 with USF and MUSL; blocks near incompressibility bear least, as shear and pressure modes share
/// nodes.
#include "stepping/stepper.hpp"

#include <string>

namespace mpm::stepping
{
/// Bound of (c_p + 2 |v|) dt/h [-]. ignoresMass: the shape keeps its bound as nodes empty (all but hat functions).
double criticalCourant(int dim, bool ignoresMass, StressUpdate update, double smallestNodalMassFraction);

/// Fastest P wave of the materials in use [m/s].
double fastestWave(const state::State& state, const std::vector<constitutive::Material>& materials);

struct StabilityLimit
{
    double courant = 0;   ///< bound of (c_p + 2 |v|) dt/h [-]
    double waveSpeed = 0; ///< c_p [m/s]
    double speed = 0;     ///< |v| [m/s]
    double deltaT = 0;    ///< bound of dt [s]
};

/// Does the bound change as particles move? (USL with hat functions.)
bool limitFollowsMass(const Scene& scene, bool ignoresMass);

/// The limit of the state as it is. c_p is that of the materials at rest times sqrt(max det F): an expanded solid is
/// lighter and as stiff (State::largestJacobian).
StabilityLimit stabilityLimit(Stepper& stepper, const state::State& state, const Scene& scene, bool ignoresMass);

/// The same limit for the speeds and stretches of a later state; the nodal masses stay those it was made with.
StabilityLimit movedLimit(StabilityLimit limit, double restWaveSpeed, const state::State& state, double speed);

/// "USF", "USL", "MUSL".
std::string stressUpdateName(StressUpdate update);
} // namespace mpm::stepping

#pragma once
/// How large a time step may be.
///
/// Stability (METHOD, Stability limit): dt <= C h/(c_p + 3 |v|), for hat functions times c_p/(c_p + 3 min(|v|, 2 c_p));
/// c_p = sqrt(M/rho) is the largest P-wave speed, |v| the largest particle speed, h the cell size. Bounds C in 2D and
/// 3D:
///                    linear                        GIMP, splines
///     USL            min(C, 1.2 sqrt(m_i/m))       0.36, in 3D 0.32
///     USF, MUSL      0.85                          1.2, in 3D 1.0
/// m_i/m is the smallest nodal mass over that of a full node: USL with hat functions loses stability as a node empties.
///
/// They lie under the smallest critical values of free elastic blocks over positions of the particles in their cells,
/// lattices and disordered ones, blocks of a cell and of many, one particle a cell and many, Poisson's ratio 0 to 0.499
/// (spectral radius of the step itself by power iteration, tests/verification/stabilityLimit.cpp). Bars in one
/// dimension bear more: 0.65 to 0.75 with USL, 1.41 to 2.3 with USF and MUSL; blocks near incompressibility bear least,
/// as shear and pressure modes share nodes.
///
/// Transfers: XPIC bears what FLIP does. FMPM of order k applies at most k times the inverse of the lumped mass: C over
/// sqrt(k). An affine field (APIC, TPIC) is lost on no second projection, so that USF and MUSL bear less, 0.75 (0.62 in
/// 3D), and with hat functions their bound follows the mass, as that of USL does.
///
/// Bulk viscosity takes the limit down by a factor of its own (treatment/bulkViscosity.hpp).
///
/// Runge-Kutta steps have bounds of their own (rungeKutta.hpp).
///
/// The linearised step knows no |v|. Impacts do: bodies close in at up to 2 |v|, and every cell face a particle crosses
/// is a jump of nodal forces, least with GIMP and splines, most with hat functions. The factors are those with which
/// random scenes up to twice the wave speed end within their energy budget (tests/stability/randomScenes).
#include "stepping/stepper.hpp"

#include <string>

namespace mpm::stepping
{
/// The bound C [-]. ignoresMass: the shape keeps its bound as nodes empty (all but hat functions).
double criticalCourant(int dim, bool ignoresMass, StressUpdate update, double smallestNodalMassFraction);

/// The bound C of a scene's method in `dim` dimensions. smallestNodalMassFraction matters where limitFollowsMass.
double methodCourant(int dim, bool ignoresMass, const Scene& scene, double smallestNodalMassFraction);

/// Fastest P wave of the materials in use [m/s].
double fastestWave(const state::State& state, const std::vector<constitutive::Material>& materials);

struct StabilityLimit
{
    double courant = 0;                       ///< C [-]
    bool hats = false;                        ///< hat functions: the second factor in |v|
    double waveSpeed = 0;                     ///< c_p [m/s]
    double speed = 0;                         ///< |v| [m/s]
    treatment::BulkViscosity viscosity{0, 0}; ///< of the scene, takes it down
    double deltaT = 0;                        ///< bound of dt [s]
};

/// Does the bound change as particles move? (Hat functions with USL, or with an affine field.)
bool limitFollowsMass(const Scene& scene, bool ignoresMass);

/// The limit of the state as it is. c_p is that of the materials at rest times sqrt(max det F): an expanded solid is
/// lighter and as stiff (State::largestJacobian); hyperelastic laws say themselves how fast waves are (waveFactor).
StabilityLimit stabilityLimit(Stepper& stepper, const state::State& state, const Scene& scene, bool ignoresMass);

/// The same limit for the speeds and stretches of a later state; the nodal masses stay those it was made with.
StabilityLimit movedLimit(StabilityLimit limit, double restWaveSpeed, const state::State& state, double speed);

/// "USF", "USL", "MUSL".
std::string stressUpdateName(StressUpdate update);
} // namespace mpm::stepping

#pragma once
/// The explicit time step, METHOD sections Projection to Stress, behind an interface that does not know dimension or
/// shape. One step:
///     weights        shape functions of each chunk
///     particleToGrid mass, momentum, internal and external force
///     nodal          body and boundary effects, in the order of the dictionary
///     gridToParticle velocity, position, velocity gradient
///     constitutive   law.update(chunk)
/// with the stress updated where the scheme says:
///     USF   before the forces, from the projected velocity v_i
///     USL   last, from v*
///     MUSL  last, from the second projection of the updated particle velocities (default)
/// The paper's Eq. 8 (old velocity and old stress) is forward Euler and unstable at every dt; it is not offered.
#include "constitutive/material.hpp"
#include "nodal/boundaries.hpp"
#include "nodal/carriedSurface.hpp"
#include "nodal/contactProperties.hpp"
#include "splitting/mergeParticles.hpp"
#include "splitting/splitParticles.hpp"
#include "state/state.hpp"
#include "stepping/rest.hpp"
#include "treatment/bulkViscosity.hpp"
#include "treatment/stressTreatment.hpp"

#include <memory>
#include <optional>
#include <string>

namespace mpm::stepping
{
enum class StressUpdate
{
    USF,
    USL,
    MUSL
};

/// How velocities return to the particles (transfer/, stepping/velocityFilter.ipp).
enum class Transfer
{
    FLIP, ///< v_p += dt sum N a, with a rate of PIC
    XPIC, ///< v_p = sum N (v^(k) + dt a): what no grid sees is filtered out of v
    FMPM, ///< v_p = sum N v*^(k): the same filter as an approximate inverse of the full mass matrix
    APIC, ///< v_p = sum N v* and an affine field around the particle (transfer/affine.hpp)
    TPIC  ///< the same with the velocity gradient
};

/// How the motion goes from one time to the next.
enum class TimeIntegration
{
    symplecticEuler, ///< the step above
    RK2,             ///< stages of the semi-discrete equations (rungeKutta.hpp)
    RK4
};

/// A prescribed body force per unit mass that varies in space and time (manufactured solutions).
class BodyForce
{
  public:
    virtual ~BodyForce() = default;
    /// b[axis][lane] [m/s^2] of the `count` particles from `first` on.
    virtual void acceleration(const state::Particles& particles, Index first, int count, double time,
                              double (&b)[3][lanes]) const = 0;
    /// What has gone wrong since this was asked last, or nothing. acceleration() is called by many threads, so it
    /// throws nothing; who called it asks afterwards and throws a StepError.
    virtual std::string takeFault() const { return {}; }
};

/// What a scene is made of besides its state. Effects that are not named are absent: empty or null.
struct Scene
{
    std::vector<constitutive::Material> materials; ///< by Particles::material
    std::optional<Vector3> gravity;                ///< [m/s^2]
    std::optional<double> relaxationTime;          ///< of viscous damping [s]
    std::optional<double> localDamping;            ///< its coefficient [-] (nodal/localDamping.hpp)
    std::vector<nodal::Wall> walls;                ///< in the order of the dictionary
    std::vector<nodal::Load> loads;
    std::optional<nodal::ContactProperties> contact;             ///< none: all materials hold together
    std::vector<nodal::Body> bodies;                             ///< rigid bodies, in the order of the dictionary
    std::vector<std::shared_ptr<nodal::CarriedSurface>> carried; ///< surfaces that go with the soil and may load it
    std::vector<nodal::Absorbing> absorbing;                     ///< planes that let waves out
    std::optional<nodal::GravityRamp> gravityRamp;               ///< how gravity comes on
    std::optional<splitting::Rule> splitting;
    std::optional<splitting::MergeRule> merging;
    std::optional<treatment::BulkViscosity> bulkViscosity;
    std::shared_ptr<const BodyForce> bodyForce;
    StressUpdate stressUpdate = StressUpdate::MUSL;
    TimeIntegration timeIntegration = TimeIntegration::symplecticEuler;
    Transfer transfer = Transfer::FLIP;
    int transferOrder = 2; ///< k of XPIC and FMPM; 1 is PIC
    /// MUSL with FLIP: particles move by the velocities w they are strained with, dt sum N w. By v* (METHOD Eq. 5) the
    /// difference of the two leaves positions and F an order apart: temporal errors of order 1, not 2.
    bool moveByStrainVelocity = false;
    /// XPIC and FMPM: share of the filter mixed in per second [1/s], every filterInterval steps; else FLIP. None: in
    /// full, every step.
    std::optional<double> filterRate;
    Index filterInterval = 1;
    treatment::StressTreatment treatment; ///< of erratic stresses
    std::optional<Rest> rest;             ///< soil at rest sleeps
    bool staggeredStart = false; ///< the first kick is half a step: velocities live half a step before positions
    double picRate = 0;          ///< FLIP: r [1/s]: v_p <- (1 - a) v_p + a v*(x_p), a = 1 - exp(-r dt)
    Index sortInterval = 20;     ///< steps between sorts of the particles
    /// 2^bits cells a side of a tile (state::TileLayout), which decides the order of sums; none: 5 in 2D, 4 in 3D, one
    /// less where soil may sleep.
    std::optional<int> tileBits;
};

/// What a moving wall or a rigid body met in the last step.
struct ActorReport
{
    std::string name;
    Vector3 position{};        ///< of a body's reference point, displacement of a wall, at the end of the step [m]
    Vector3 velocity{};        ///< mean of the step [m/s]
    Vector3 angularVelocity{}; ///< [rad/s]
    Vector3 force{}, torque{}; ///< of the soil on it, about the place its point began the step at; per metre in 2D
    Index contacts = 0;        ///< nodes pressed
};

/// What the last step saw.
struct StepReport
{
    double smallestJacobian = 1;     ///< min det F
    double largestSpeed = 0;         ///< max |v_p|, and of walls in motion [m/s]
    double strainEnergy = 0;         ///< sum V 1/2 sigma : C^-1 : sigma [J]
    Vector3 momentum{};              ///< sum m v_p [N s]
    double lightestNode = 0;         ///< smallest mass of a node that carries any [kg]
    double maxYieldViolation = 0;    ///< max f/max(|sigma|, strength) over particles, 0 if none yields
    std::vector<ActorReport> actors; ///< moving walls, then rigid bodies
    Index cappedDomains = 0;         ///< particle domains held at the widest size the shape allows
    Index resting = 0;               ///< particles that slept through it
    double restingStress =
        0; ///< largest stress out of balance that left a tile asleep so far, |a| rho h of a node [Pa]
    double unbalancedForce = 0;    ///< with localDamping: sum of |net force| over nodes, by components [N]
    double appliedForce = 0;       ///< with localDamping: the same of the projected forces (all but gravity)
    double nodalKineticEnergy = 0; ///< sum m_i v_i^2/2 as projected from the particles [J]
};

/// Seconds spent in the parts of the step since the start.
struct PassTimes
{
    double weights = 0;     ///< shape functions and where a particle's nodes are
    double toGrid = 0;      ///< projections
    double nodal = 0;       ///< sums over tiles, equations of motion, walls
    double toParticles = 0; ///< interpolation, velocity, position
    double law = 0;         ///< deformation gradient, rotation of stress, material laws
    double sort = 0;        ///< order of the particles and the tiles that follow from it
    double split = 0;

    PassTimes& operator+=(const PassTimes& o)
    {
        weights += o.weights;
        toGrid += o.toGrid;
        nodal += o.nodal;
        toParticles += o.toParticles;
        law += o.law;
        sort += o.sort;
        split += o.split;
        return *this;
    }
};

class Stepper
{
  public:
    virtual ~Stepper() = default;
    /// Advances the state by dt. Throws StepError (particle outside the grid, det F <= 0, numbers no longer finite)
    /// with the state's arrays no longer usable: go back to the last good state.
    virtual void step(double dt) = 0;
    /// To be called after anything but step() has changed particles (velocities set to zero, a state put back): the
    /// stepper keeps their projection from one step to the next.
    virtual void particlesChanged() = 0;
    virtual const StepReport& report() const = 0;
    virtual PassTimes times() const = 0;
    /// Smallest mass of a node that carries mass over rho h^d of a full cell, for the stability limit.
    virtual double smallestNodalMassFraction() = 0;
    /// max |v_p| of the particles as they are, and of walls in motion [m/s].
    virtual double largestSpeed() const = 0;
    /// Of columns the stepper keeps for itself [bytes].
    virtual double scratchBytesPerParticle() const { return 0; }
};

/// "MUSL, FLIP", "USL, XPIC of order 2, staggered start", "RK4".
std::string methodText(const Scene& scene);

/// The instantiated pairs; case/makeStepper.cpp chooses among them by name.
template <int dim, class Shape>
std::unique_ptr<Stepper> makeExplicitStepper(state::State& state, const Scene& scene);

/// Where children of split particles must not go.
std::vector<splitting::Barrier> wallBarriers(const Scene& scene, const state::GridBox& grid, double time = 0);
} // namespace mpm::stepping

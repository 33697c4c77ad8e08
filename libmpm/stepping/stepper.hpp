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
#include "splitting/splitParticles.hpp"
#include "state/state.hpp"

#include <memory>
#include <optional>

namespace mpm::stepping
{
enum class StressUpdate
{
    USF,
    USL,
    MUSL
};

/// A prescribed body force per unit mass that varies in space and time (manufactured solutions).
class BodyForce
{
  public:
    virtual ~BodyForce() = default;
    /// b[axis][lane] [m/s^2] of the chunk that starts at particle `first`; fill all lanes.
    virtual void acceleration(const state::Particles& particles, Index first, double time,
                              double (&b)[3][lanes]) const = 0;
};

/// What a scene is made of besides its state. Effects that are not named are absent: empty or null.
struct Scene
{
    std::vector<constitutive::Material> materials; ///< by Particles::material
    std::optional<Vector3> gravity;                ///< [m/s^2]
    std::vector<nodal::Wall> walls;                ///< in the order of the dictionary
    std::vector<nodal::Load> loads;
    std::optional<splitting::Rule> splitting;
    std::shared_ptr<const BodyForce> bodyForce;
    StressUpdate stressUpdate = StressUpdate::MUSL;
    double picRate = 0;      ///< r [1/s]: v_p <- (1 - a) v_p + a v*(x_p), a = 1 - exp(-r dt)
    Index sortInterval = 20; ///< steps between sorts of the particles
    Index defaultSlabs = 8;  ///< slabs of a fresh state; a stored state keeps its own
};

/// What the last step saw.
struct StepReport
{
    double smallestJacobian = 1;  ///< min det F
    double maxYieldViolation = 0; ///< max f/max(|sigma|, strength) over particles, 0 if none yields
    Index cappedDomains = 0;      ///< particle domains held at the widest size the shape allows
};

/// Seconds spent in the parts of the step since the start.
struct PassTimes
{
    double weights = 0, toGrid = 0, nodal = 0, toParticles = 0, law = 0, sort = 0, split = 0;
};

class Stepper
{
  public:
    virtual ~Stepper() = default;
    /// Advances the state by dt. Throws StepError (particle outside the grid, det F <= 0, numbers no longer finite)
    /// with the state's arrays no longer usable: go back to the last good state.
    virtual void step(double dt) = 0;
    virtual const StepReport& report() const = 0;
    virtual const PassTimes& times() const = 0;
    /// Smallest mass of a node that carries mass over rho h^d of a full cell, for the stability limit.
    virtual double smallestNodalMassFraction() = 0;
    /// max |v_p| of the particles as they are [m/s].
    virtual double largestSpeed() const = 0;
};

/// The instantiated pairs; case/makeStepper.cpp chooses among them by name.
template <int dim, class Shape>
std::unique_ptr<Stepper> makeExplicitStepper(state::State& state, const Scene& scene);

/// Where children of split particles must not go.
std::vector<splitting::Barrier> wallBarriers(const Scene& scene, const state::GridBox& grid);
} // namespace mpm::stepping

#pragma once
/// Everything a run needs to go on, and nothing else: what state.h5 holds.
#include "state/gridBox.hpp"
#include "state/particles.hpp"

#include <map>
#include <string>
#include <vector>

namespace mpm::state
{
/// Energies [J, per metre in 2D] and counts summed since the start of the run. Positive losses left the body.
struct Ledger
{
    double plasticDissipation = 0;  ///< sum V sigma_mid : dEps_p
    double frictionDissipation = 0; ///< work of tangential wall forces taken from the body
    double wallLoss = 0;        ///< work of all other wall forces taken from the body (impact on walls, fixed walls)
    double contactFriction = 0; ///< work of friction between bodies (nodal/contact.hpp)
    double contactLoss = 0;     ///< work of all else that bodies do to each other: impact
    double splitMergeLoss = 0;  ///< kinetic and elastic energy lost by splitting and merging
    /// Energy lost between particles and grid: kinetic energy in both directions, and the work of internal forces on
    /// the change a projection makes to the velocities strains are taken from (see stepping/energyBudget.hpp).
    double transferLoss = 0;
    double dampingDissipation = 0; ///< work of damping taken from the body
    double pendingWork =
        0; ///< work of the last step's stress that the next step finds again (stepping/energyBudget.hpp)
    double staggering = 0;        ///< energy of velocities that live half a step off the stresses, now
    double initialStaggering = 0; ///< the same at the first step
    double finiteStrainWork = 0;  ///< elastic energy that finite steps of a rate law make (energyBudget.hpp)
    double relaxationLoss = 0;    ///< elastic energy that stress relaxation takes (treatment/stressRelaxation.hpp)
    double averagingLoss = 0; ///< work of forces that averaged strains do not find (treatment/volumetricAveraging.hpp)
    double viscosityLoss = 0; ///< taken by its viscosity
    double bulkViscosityLoss = 0; ///< taken by bulk viscosity (treatment/bulkViscosity.hpp)
    double gapWork = 0;           ///< energy that open tension gaps hold (treatment/tensionGap.hpp)
    double restLoss = 0;          ///< kinetic energy of particles that fell asleep (stepping/rest.hpp)
    double gravityWork = 0;       ///< sum dt m_i b . (v_i + v*)/2
    double tractionWork = 0;      ///< sum dt f_tau . (v_i + v*)/2
    double motionWork = 0;        ///< work of moving walls and bodies on the body, positive when supplied
    double absorbedEnergy = 0;    ///< taken by absorbing boundaries
    double motionSupply = 0;      ///< the same, of steps that supplied any: what has come in, however much went back
    double apexVolume = 0;        ///< volume dropped by apex returns beyond the flow rule [m^3]
    double bodyForceWork = 0;     ///< work of prescribed body forces other than gravity
    double kineticEnergy = 0;     ///< of the particles, now
    double initialKineticEnergy = 0;
    double initialStrainEnergy = 0;
    Vector3 wallImpulse{};           ///< impulse of the walls on the body [N s]
    Vector3 gravityImpulse{};        ///< impulse of gravity [N s]
    Vector3 tractionImpulse{};       ///< impulse of tractions [N s]
    Vector3 dampingImpulse{};        ///< impulse of damping [N s]
    Vector3 restImpulse{};           ///< momentum that sleeping particles did not take (stepping/rest.hpp)
    Vector3 initialMomentum{};       ///< momentum at the start [N s]
    double splitAngularMomentum = 0; ///< |change| of angular momentum by splitting and merging, summed [kg m^2/s]
    Index apexReturns = 0;           ///< particle returns to the apex
    Index splits = 0;                ///< particles split
    Index merges = 0;                ///< pairs of particles merged
    Index splitsPutOff = 0;          ///< particles whose split is put off at a wall, at the last look
    Index splitsCapped = 0;          ///< particles whose split the caps on size and count refuse, at the last look
    Index restingSteps = 0;          ///< steps that particles slept through, summed over particles
    Index wakes = 0;                 ///< tiles of particles that were woken
    Index bodyContacts = 0;          ///< nodes and steps at which a rigid body pressed
    Index wallContacts = 0;          ///< nodes and steps at which a friction wall pressed
    Index contactNodes = 0;          ///< nodes and steps at which two bodies pressed
};

/// A named part of the body's surface, carried with the material: segments in 2D, triangles in 3D. Element e has its
/// centre, and edge vectors (one in 2D, two in 3D) that follow the motion like those of particles.
/// Its outward normal times area is (e_y, -e_x) in 2D and cross(e1, e2)/2 in 3D.
struct SurfacePatch
{
    std::string name;
    std::array<Column<double>, 3> centre; ///< [m]
    std::array<Column<double>, 6> edges;  ///< dim components of edge 1, then of edge 2 (3D) [m]
    Index size() const { return Index(centre[0].size()); }
    std::vector<Vector3> centres() const
    {
        std::vector<Vector3> out(std::size_t(size()), Vector3{});
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t e = 0; e < centre[a].size(); ++e)
                out[e][a] = centre[a][e];
        return out;
    }
};

struct State
{
    explicit State(int dim = 2) : particles(dim) { grid.dim = dim; }

    double time = 0;   ///< [s]
    Index step = 0;    ///< steps done since the start
    double deltaT = 0; ///< last time step used [s]; 0 before the first
    /// Largest det F of particles that carry stress (of hyperelastic ones their waveFactor, constitutive/law.hpp): the
    /// square of the wave speed over that at rest; adaptive steps follow it.
    double largestJacobian = 1;
    double stepFactor = 1; ///< share of the adaptive time step the monitor allows, 1 while nothing grows
    Vector3 seedSpacing{}; ///< lattice spacing of the seeding [m]
    Index nextId = 0;      ///< the next unused particle id
    GridBox grid;
    Particles particles;
    std::vector<std::string> materials; ///< names, by Particles::material
    std::vector<SurfacePatch> patches;
    Ledger ledger;
    std::map<std::string, std::string> provenance; ///< version, compiler, instruction set, dictionaries
};
} // namespace mpm::state

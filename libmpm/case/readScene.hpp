#pragma once
/// From the dictionaries of a case to the scene a stepper works on.
///
/// constant/materialProperties: one dictionary a material: law, its parameters, density (see constitutive/);
///     initialStress and initialVelocity are seedParticles' own.
/// constant/g: value (0 -9.8 0); absent: no gravity.
/// constant/boundaryConditions: one dictionary a boundary, named after a physical group of the geometry, or with a
/// plane
///     of its own: walls (nodal/wall.hpp) and loads (nodal/traction.hpp); boundaries not named are free. Absent: all
///     free.
/// system/mpmSchemes:
///     shape         uGIMP;      // uGIMP | cpGIMP | CPDI | quadraticBSpline | cubicBSpline | linear
///     stressUpdate  MUSL;       // USF | USL | MUSL
///     transfer      FLIP;       // FLIP | XPIC | FMPM | APIC | TPIC (stepping/velocityFilter.ipp, transfer/affine.hpp)
///     picRate       0;          // FLIP: [1/s] share of PIC velocity mixed in per second
///     order         2;          // XPIC, FMPM: terms of the filter; 1 is PIC
///     staggeredStart off;       // on: the first kick is half a step, velocities live at t - dt/2 (not with USF)
///     sortInterval  20;         // steps between sorts of the particles
///     damping       { ... }     // nodal/damping.hpp; absent: none
///     splitting     { ... }     // splitting/splitParticles.hpp; absent: none
#include "case/caseDirectory.hpp"
#include "case/overrides.hpp"
#include "dictionary/dictionary.hpp"
#include "stepping/stepper.hpp"

namespace mpm::cases
{
/// Every material in file order; names must be unique by construction of a dictionary.
std::vector<constitutive::Material> readMaterials(const dictionary::Dictionary& materialProperties);

/// A material's place, for State::materials; InputError naming those there are.
std::optional<Vector3> readGravity(const dictionary::Dictionary& g, int dim);

/// Walls and loads. Patches give planes to boundaries named after them.
void readBoundaries(const dictionary::Dictionary& boundaryConditions, const state::State& state,
                    stepping::Scene& scene);

/// Shape's name; the rest goes into the scene.
std::string readSchemes(const dictionary::Dictionary& mpmSchemes, const state::State& state, stepping::Scene& scene);

/// The words solver and splitParticles share: threshold, mode, maxParticles, maxGeneration.
splitting::Rule readSplitRule(const dictionary::Dictionary& splitting);
/// The same and interval.
splitting::Rule readSplitting(const dictionary::Dictionary& splitting);

struct SceneOfCase
{
    stepping::Scene scene;
    std::string shape;
    std::string dictionaries; ///< all dictionaries as they were understood (provenance)
};

/// Reads all of the above for a state, and checks that nothing was left unread, that the grid of system/gridDict is the
/// lattice the state was seeded on (its box may be wider now; the state takes it), and that materials match by name.
/// Overrides change the dictionaries as they are read.
SceneOfCase readScene(const CaseDirectory& folder, state::State& state, const Overrides& overrides = {});
} // namespace mpm::cases

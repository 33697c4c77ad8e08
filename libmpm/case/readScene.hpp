#pragma once
/// From the dictionaries of a case to the scene a stepper works on.
///
/// constant/materialProperties: one dictionary a material: law, its parameters, density (see constitutive/);
///     initialStress, initialVelocity and constants are seedParticles' own.
/// constant/bodyForce: a force per mass by formulas (case/expressionForce.hpp); absent: none.
/// constant/g: value (0 -9.8 0); absent: no gravity.
/// constant/rigidBodies: case/readRigidBodies.hpp; absent: none.
/// constant/boundaryConditions: case/readBoundaries.hpp; absent: all boundaries are free.
/// constant/contactProperties: case/readContact.hpp
/// system/mpmSchemes: case/readSchemes.hpp
#include "case/caseDirectory.hpp"
#include "case/overrides.hpp"
#include "dictionary/dictionary.hpp"
#include "stepping/stepper.hpp"

namespace mpm::cases
{
/// Every material in file order; names must be unique by construction of a dictionary. Laws that follow the cell size
/// (Law::regularise) are told it.
std::vector<constitutive::Material> readMaterials(const dictionary::Dictionary& materialProperties,
                                                  std::optional<double> cellSize = {});

/// The same in the order of State::materials, by which particles name them; InputError for one that is not there.
std::vector<constitutive::Material> matchMaterials(const dictionary::Dictionary& materialProperties,
                                                   const state::State& state);

std::optional<Vector3> readGravity(const dictionary::Dictionary& g, int dim);
/// `ramp { duration 1; shape smooth; }` of constant/g (nodal/gravity.hpp).
std::optional<nodal::GravityRamp> readGravityRamp(const dictionary::Dictionary& g);

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

#pragma once
/// constant/rigidBodies: one dictionary a body, words and example in nodal/bodyContact.hpp, motion in
/// nodal/rigidBody.hpp.
///
/// Errors (file:line): a name that something else in postProcessing has, neither or both of geometry and points, what a
/// surface may not be (nodal/rigidSurface.hpp), a body outside the grid, thinner than a cell everywhere, one that
/// starts inside the soil (how many particles, how deep), periodic grids. Verified in tests/unit/rigidBodies.cpp.
#include "dictionary/dictionary.hpp"
#include "stepping/stepper.hpp"

namespace mpm::cases
{
void readRigidBodies(const dictionary::Dictionary& rigidBodies, const state::State& state, stepping::Scene& scene);
} // namespace mpm::cases

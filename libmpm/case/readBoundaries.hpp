#pragma once
/// constant/boundaryConditions: one dictionary a boundary, named after a physical group of the geometry, or with a
/// plane of its own: walls at rest or in motion (nodal/wall.hpp), planes that let waves
/// out (nodal/absorbingBoundary.hpp) and loads (nodal/traction.hpp). Boundaries not named
/// are free.
///
///     base   { type fixed; motion { acceleration { file "constant/quake.csv"; direction (1 0 0); scale 9.81; } } }
///     piston { type friction; mu 0.3; plane { normal (-1 0 0); position 0; } motion { velocity (0.1 0 0); } }
///     top    { type pressure; value 1e3; }
///
/// Errors (file:line): a name the geometry does not know, walls out of reach or with soil behind them, two walls that
/// face the same way, a wall between planes of nodes unless it moves along its normal, and those of a motion
/// (dictionary/motion.hpp). Verified in tests/unit/boundaries.cpp.
#include "dictionary/dictionary.hpp"
#include "stepping/stepper.hpp"

namespace mpm::cases
{
/// Walls and loads. Patches give planes to boundaries named after them.
void readBoundaries(const dictionary::Dictionary& boundaryConditions, const state::State& state,
                    stepping::Scene& scene);
} // namespace mpm::cases

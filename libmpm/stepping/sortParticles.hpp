#pragma once
/// Order of the particles in memory: by (key, id). The key (state::TileLayout) stands for the tile and the first node
/// of the shape's support, so neighbours in memory share nodes, and the order depends on the state alone (METHOD,
/// Reproducibility). supportNodes below: nodes per axis of the shape.
#include "state/state.hpp"
#include "state/tileGrid.hpp"

namespace mpm::stepping
{
/// New keys from the positions, then sort.
void sortByPosition(state::State& state, const state::TileLayout& layout, int supportNodes);
/// Keys for particles made since the last sort (those with the largest key there is), and sort these alone, behind all
/// others. Sorts by position once more than one particle in eight is loose.
void sortLoose(state::State& state, const state::TileLayout& layout, int supportNodes);
/// What has left the box through a periodic side enters through the other one.
void wrapPositions(state::State& state);
/// Do the keys a state carries name the bodies its materials now belong to?
bool keysNameBodies(const state::State& state, const state::TileLayout& layout);
/// Of all particles.
double largestMass(const state::Particles& particles);
/// Sort by the keys the state carries (after loading).
void sortByStoredKeys(state::State& state);
} // namespace mpm::stepping

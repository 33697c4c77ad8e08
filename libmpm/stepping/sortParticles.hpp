#pragma once
/// Order of the particles in memory: by (key, id), the key being the first node of the shape's support, counted z, y,
/// x. Neighbours in memory then share nodes, and the order depends on the state alone (METHOD, Reproducibility).
#include "state/state.hpp"

namespace mpm::stepping
{
/// New keys from the positions, then sort. supportNodes: nodes per axis of the shape.
void sortByPosition(state::State& state, int supportNodes);
/// Sort by the keys the state carries (after loading).
void sortByStoredKeys(state::State& state);
} // namespace mpm::stepping

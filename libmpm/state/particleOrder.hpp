#pragma once
/// The order of particles in memory: by (sortKey, id), which depends on the state alone.
///
/// Linear: particles that are in order already cost one look each. Else keys are taken in groups of a tile: particles
/// that have left theirs are picked out (Cook and Kim, CACM 23(11), 1980: whatever breaks the order goes, with its
/// predecessor) and sorted; each group counts its keys and sorts the few ids within one. When most are out of place: a
/// radix sort by key, then ids within each key. Groups are shared among threads, and the order is the same for any
/// number of them. Covered by tests/unit/particleOrder.cpp.
#include "state/particles.hpp"

namespace mpm::state
{
/// order[i]: the particle that belongs at place i. Empty if they stand in order already.
Order orderByKeyAndId(const Particles& particles);

/// Brings the particles into that order; false if they were in it.
bool sortByKeyAndId(Particles& particles);
} // namespace mpm::state

#pragma once
/// The order of particles in memory: by (sortKey, id), which depends on the state alone.
///
/// Linear: particles that are in order already cost one look each; when few are out of place those are picked out
/// (Cook and Kim, CACM 23(11), 1980: whatever breaks the order goes, with its predecessor), sorted and merged back;
/// otherwise a radix sort by key, then ids within each key. Covered by tests/unit/particleOrder.cpp.
#include "state/particles.hpp"

namespace mpm::state
{
/// order[i]: the particle that belongs at place i. Empty if they stand in order already.
std::vector<Index> orderByKeyAndId(const Particles& particles);

/// Brings the particles into that order; false if they were in it.
bool sortByKeyAndId(Particles& particles);
} // namespace mpm::state

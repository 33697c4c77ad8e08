#pragma once
/// Which instruction set computed a state. Results are bitwise those of one set (x86-64-v3 and v4 contract sums to
/// fused multiply-adds, v2 has none; a native build may choose other sums to contract), so a state names every set its
/// steps were computed with:
///     x86-64-v3
///     x86-64-v3; x86-64-v4 from step 250
/// The same for what columns of particles are stored as (state::Stored), in an entry "storage" that a state computed
/// with doubles alone does not have:
///     float
///     double; float from step 250
///
/// Verified in tests/unit/provenance.cpp and by etc/compareInstructionSets.
#include "state/state.hpp"

#include <string>

namespace mpm::cases
{
/// Adds the running set to the state's entry "instructionSet", unless the steps before were computed with it.
void recordInstructionSet(state::State& state, const std::string& running);

/// What to tell a user who goes on from the state; empty if it was computed with the running set alone.
std::string instructionSetNote(const state::State& state, const std::string& running);

/// The same for the storage, "double" or "float".
void recordStorage(state::State& state, const std::string& running);
std::string storageNote(const state::State& state, const std::string& running);

/// All a run that goes on from the state says of itself: version, revision, compiler, both of the above, and the
/// dictionaries as they were understood.
void recordRun(state::State& state, const std::string& dictionaries);
} // namespace mpm::cases

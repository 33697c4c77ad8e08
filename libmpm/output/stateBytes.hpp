#pragma once
/// The bytes of a state.h5 (output/stateFile.hpp) and a state from them, by way of a temporary file. InputError as for
/// a file; a bitwise copy otherwise.
#include "state/state.hpp"

#include <cstddef>
#include <span>

namespace mpm::output
{
std::vector<std::byte> stateBytes(const state::State& state);
state::State stateFromBytes(std::span<const std::byte> bytes);
} // namespace mpm::output

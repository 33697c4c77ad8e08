#include "output/stateBytes.hpp"

#include "output/memoryFile.hpp"
#include "output/stateFile.hpp"

namespace mpm::output
{
std::vector<std::byte> stateBytes(const state::State& state)
{
    requireValid(state, "the state");
    const MemoryFile memory;
    writeStateAt(memory.path(), state);
    return memory.read();
}

state::State stateFromBytes(std::span<const std::byte> bytes)
{
    const MemoryFile memory;
    memory.write(bytes);
    return readState(memory.path());
}
} // namespace mpm::output

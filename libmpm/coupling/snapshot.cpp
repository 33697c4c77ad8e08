// Snapshots of a participant: in memory, as bytes, and as the text that goes with a state to disk.
#include "base/error.hpp"
#include "base/hash.hpp"
#include "coupling/byteStream.hpp"
#include "coupling/implementation.hpp"
#include "output/stateBytes.hpp"

#include <fmt/format.h>

namespace mpm::coupling
{
namespace
{
constexpr const char* memoryName = "coupling"; // in the provenance of a state
const std::string heading = "libmpm snapshot 1";

void putText(std::vector<std::byte>& out, const std::string& text)
{
    putBytes(out, std::uint64_t(text.size()));
    putBytes(out, text.data(), text.size());
}

std::string takeText(std::span<const std::byte>& bytes)
{
    const auto size = takeBytes<std::uint64_t>(bytes);
    if (size > bytes.size())
        throw CouplingError(Fault::badState, "found the end of the bytes within a text");
    std::string out;
    for (const auto b : bytes.first(size))
        out += char(b);
    bytes = bytes.subspan(size);
    return out;
}

std::vector<std::byte> takeBlock(std::span<const std::byte>& bytes)
{
    const auto size = takeBytes<std::uint64_t>(bytes);
    if (size > bytes.size())
        throw CouplingError(Fault::badState, "found the end of the bytes within a block");
    const auto block = bytes.first(size);
    bytes = bytes.subspan(size);
    return {block.begin(), block.end()};
}

std::uint64_t checksum(std::span<const std::byte> bytes)
{
    return hashOf({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::string hexadecimal(std::span<const std::byte> bytes)
{
    std::string out;
    for (const auto b : bytes)
        out += fmt::format("{:02x}", unsigned(b));
    return out;
}

std::vector<std::byte> fromHexadecimal(const std::string& text)
{
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    std::vector<std::byte> out(text.size() / 2);
    if (text.size() % 2 != 0 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
        throw CouplingError(Fault::badState, "found a text that is no bytes");
    for (std::size_t n = 0; n < out.size(); ++n)
        out[n] = std::byte(16 * digit(text[2 * n]) + digit(text[2 * n + 1]));
    return out;
}
} // namespace

std::shared_ptr<const HeldState> Participant::Implementation::hold() const
{
    return std::make_shared<HeldState>(HeldState{soil.state(), savedSurfaces(), lifecycle});
}

std::vector<std::vector<std::byte>> Participant::Implementation::savedSurfaces() const
{
    std::vector<std::vector<std::byte>> out;
    for (const auto& surface : surfaces)
        out.push_back(surface.save());
    return out;
}

void Participant::Implementation::putBack(const HeldState& held)
{
    std::size_t n = 0;
    for (auto& surface : surfaces)
        surface.load(held.surfaces[n++]);
    soil.goBack(held.state);
    lifecycle = held.lifecycle;
    startsNow = lifecycle == Lifecycle::Initialized;
}

/// One line a surface: its name and its bytes.
std::string Participant::Implementation::surfacesAsText(const std::vector<std::vector<std::byte>>& saved) const
{
    std::string out;
    std::size_t n = 0;
    for (const auto& surface : surfaces)
        out += surface.name() + " " + hexadecimal(saved[n++]) + "\n";
    return out;
}

/// Of the state the case starts from; a surface it does not know begins where its mesh is.
void Participant::Implementation::recallSurfaces()
{
    auto& provenance = soil.state().provenance;
    const auto found = provenance.find(memoryName);
    if (found == provenance.end())
        return;
    const std::string text = found->second;
    for (auto& surface : surfaces)
    {
        const std::string start = surface.name() + " ";
        std::size_t at = text.compare(0, start.size(), start) == 0 ? 0 : text.find("\n" + start);
        if (at == std::string::npos)
            continue;
        at = text.find(' ', at) + 1;
        surface.load(fromHexadecimal(text.substr(at, text.find('\n', at) - at)));
    }
}

Snapshot Participant::saveState() const
{
    own_->require({Lifecycle::Initialized, Lifecycle::Stepping}, "saveState");
    Snapshot out;
    out.held_ = own_->hold();
    return out;
}

void Participant::restoreState(const Snapshot& snapshot)
{
    own_->require({Lifecycle::Initialized, Lifecycle::Stepping}, "restoreState");
    if (snapshot.empty())
        throw CouplingError(Fault::badState,
                            "found an empty snapshot; allowed is one that saveState() or deserialise() made");
    const auto& held = *snapshot.held_;
    const auto& own = own_->soil.state();
    bool fits = held.surfaces.size() == own_->surfaces.size() && held.state.particles.dim == own.particles.dim &&
                held.state.materials == own.materials && held.state.grid.h == own.grid.h &&
                held.state.grid.origin == own.grid.origin && held.state.grid.cells == own.grid.cells;
    if (!fits)
        throw CouplingError(Fault::badState, "found the snapshot of another case, or with other surfaces");
    std::size_t n = 0;
    for (const auto& surface : own_->surfaces)
        surface.requireOwn(held.surfaces[n++]);
    const double acceptedTime = own_->accepted ? own_->accepted->state.time : time();
    own_->putBack(held);
    if (held.state.time > acceptedTime) // still after what was accepted last
        return;
    if (held.state.time < acceptedTime)
        own_->windows.close();
    own_->accepted.reset();
}

std::vector<std::byte> Participant::serialise(const Snapshot& snapshot) const
try
{
    if (snapshot.empty())
        throw CouplingError(Fault::badState, "found an empty snapshot; allowed is one that saveState() made");
    std::vector<std::byte> out;
    putText(out, heading);
    putBytes(out, std::int32_t(snapshot.held_->lifecycle));
    putBytes(out, std::uint64_t(snapshot.held_->surfaces.size()));
    const auto putBlock = [&](const std::vector<std::byte>& block) {
        putBytes(out, std::uint64_t(block.size()));
        putBytes(out, block.data(), block.size());
    };
    for (const auto& block : snapshot.held_->surfaces)
        putBlock(block);
    putBlock(output::stateBytes(snapshot.held_->state));
    putBytes(out, checksum(out));
    return out;
}
catch (const InputError& error)
{
    throw CouplingError(Fault::files, error.what());
}

Snapshot Participant::deserialise(std::span<const std::byte> bytes) const
try
{
    auto last = bytes.last(std::min(bytes.size(), sizeof(std::uint64_t)));
    const auto content = bytes.first(bytes.size() - last.size());
    if (takeText(bytes) != heading)
        throw CouplingError(Fault::badState, "found bytes that are no snapshot of this version");
    if (takeBytes<std::uint64_t>(last) != checksum(content))
        throw CouplingError(Fault::badState,
                            "found bytes that have changed since they were made: their checksum differs");
    bytes = bytes.first(bytes.size() - sizeof(std::uint64_t));
    auto held = std::make_shared<HeldState>();
    const auto lifecycle = takeBytes<std::int32_t>(bytes);
    if (lifecycle != int(Lifecycle::Initialized) && lifecycle != int(Lifecycle::Stepping))
        throw CouplingError(Fault::badState, "found a snapshot of no lifecycle");
    held->lifecycle = Lifecycle(lifecycle);
    const auto count = takeBytes<std::uint64_t>(bytes);
    if (count != own_->surfaces.size())
        throw CouplingError(Fault::badState, fmt::format("found a snapshot of {} surfaces, allowed is one of {}", count,
                                                         own_->surfaces.size()));
    for (const auto& surface : own_->surfaces)
    {
        held->surfaces.push_back(takeBlock(bytes));
        surface.requireOwn(held->surfaces.back());
    }
    held->state = output::stateFromBytes(takeBlock(bytes));
    if (!bytes.empty())
        throw CouplingError(Fault::badState, "found bytes after the end of a snapshot");
    Snapshot out;
    out.held_ = std::move(held);
    return out;
}
catch (const InputError& error)
{
    throw CouplingError(Fault::badState, error.what());
}
} // namespace mpm::coupling

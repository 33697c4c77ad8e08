#pragma once
/// The inside of a participant: the soil, its surfaces, and where in its life it is.
#include "coupling/soil.hpp"
#include "coupling/surface.hpp"
#include "coupling/windowSeries.hpp"

#include <list>

namespace mpm::coupling
{
/// What a Snapshot holds.
struct HeldState
{
    state::State state;
    std::vector<std::vector<std::byte>> surfaces; ///< in their order
    Lifecycle lifecycle = Lifecycle::Initialized;
};

struct Participant::Implementation
{
    Implementation(const std::filesystem::path& caseFolder, const std::vector<Setting>& settings, int threads);

    /// CouplingError (callOrder) unless the lifecycle is one of these.
    void require(std::initializer_list<Lifecycle> allowed, const char* call) const;
    Surface& find(const std::string& name);
    const Surface& find(const std::string& name) const
    {
        return const_cast<Implementation*>(this)->find(name); // NOLINT: the same search
    }
    void add(const std::string& name, SurfaceMesh mesh, SurfaceKind kind, const SurfaceOptions& options);
    /// Values as a field wants them.
    void checkSize(const Surface& surface, const Field& field, std::size_t count) const;

    std::vector<std::vector<std::byte>> savedSurfaces() const;
    std::shared_ptr<const HeldState> hold() const;
    void putBack(const HeldState& held);
    /// Surfaces go with the state to disk, and come back from there.
    std::string surfacesAsText(const std::vector<std::vector<std::byte>>& saved) const;
    void recallSurfaces();

    void substeps(double end, Index& count);
    void substep(double dt);

    Soil soil;
    int threads = 0;
    std::list<Surface> surfaces;
    Lifecycle lifecycle = Lifecycle::Created;
    std::shared_ptr<const HeldState> accepted; ///< the end of the last accepted window; null: it is where soil is
    bool startsNow = true;                     ///< has no step been taken since initialize()?
    WindowSeries windows;
};
} // namespace mpm::coupling

#pragma once
/// A participant with a wall that is pushed into its block, for tests of coupling.
#include "coupling/participant.hpp"
#include "support/coupledCase.hpp"

#include <catch2/catch.hpp>

namespace mpm::tests
{
using namespace mpm::coupling;

constexpr double dt = 1.0 / 1024; // a sum of them is exact

inline SurfaceMesh box(double x0, double y0, double x1, double y1)
{
    return polygon({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}}, true);
}

inline std::vector<double> pose(double x, double y, double angle = 0)
{
    return {x, y, 0, std::cos(angle / 2), 0, 0, std::sin(angle / 2)};
}

/// Bytes of all there is.
inline std::vector<std::byte> everything(const Participant& p)
{
    return p.serialise(p.saveState());
}

/// A wall of 0.5 m x 0.8 m, its middle 0.1 m below the block's, that comes from the left at 1 m/s, its face 0.1 m
/// before the block at first.
inline Participant pushed(const std::filesystem::path& folder, SurfaceKind kind = SurfaceKind::Rigid, int threads = 0)
{
    Participant out(folder, {}, threads);
    out.addCouplingSurface("wall", box(0.4, 0.25, 0.9, 1.05), kind, {.mu = 0.2});
    out.initialize();
    return out;
}

inline void pushOn(Participant& p, double window, double speed = 1)
{
    const double x = 0.65 + speed * (p.time() + window);
    if (p.kind("wall") == SurfaceKind::Rigid)
        p.writeField("wall", FieldName::RigidPose, pose(x, 0.65), window);
    else
        p.writeField("wall", FieldName::Displacement,
                     std::vector<double>{x - 0.65, 0, 0, x - 0.65, 0, 0, x - 0.65, 0, 0, x - 0.65, 0, 0}, window);
    REQUIRE(p.advance(window).status == Status::reached);
}
} // namespace mpm::tests

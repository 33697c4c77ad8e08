// Effects of what is prescribed in time: walls in motion, rigid bodies, waves let out and in, gravity by a ramp.
#include "base/error.hpp"
#include "case/effectCatalogue.hpp"
#include "nodal/rigidBody.hpp"
#include "nodal/wall.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using Ledger = state::Ledger;

/// A motion by formula that goes nowhere.
dictionary::Motion nowhere()
{
    const dictionary::Expression zero({"0*t", {}}, "velocity", {"t"}, {});
    return {dictionary::Motion::Given::velocity, dictionary::TimeFunction({zero, 0, 0}, "velocity")};
}

Deed motionDeed(const EffectRun& run)
{
    const double supplied = run.grown(&Ledger::motionSupply), work = run.grown(&Ledger::motionWork);
    if (supplied == 0 && work == 0)
        return {0, "J", "0 J of work", false};
    return {work, "J", fmt::format("work {} in all, {} while they supplied", run.energy(work), run.energy(supplied))};
}

Effect movingWallEffect()
{
    Effect e{.name = "movingWall",
             .family = EffectFamily::boundary,
             .word = "motion { ... }",
             .file = "constant/boundaryConditions",
             .help = "a wall that moves as prescribed, a base that shakes"};
    e.uses = [](const EffectScene& s) {
        return std::any_of(s.scene.walls.begin(), s.scene.walls.end(), [](const auto& wall) { return wall.motion; });
    };
    e.without = [](EffectScene& s) {
        for (auto& wall : s.scene.walls)
            if (wall.motion) // it stays where it is
            {
                wall.plane = nodal::wallPlane(wall, s.state.grid, s.state.time);
                wall.motion.reset();
            }
    };
    e.base = [](EffectScene& s) {
        if (s.scene.walls.empty())
            s.scene.walls.push_back({"side", nodal::WallType::roller, 0, -1, 0, 0, true});
    };
    e.neutral = [](EffectScene& s) {
        auto& wall = s.scene.walls.front();
        const auto axis = std::size_t(wall.axis);
        wall.position = s.state.grid.origin[axis] + s.state.grid.h * double(wall.plane);
        wall.motion = std::make_shared<const dictionary::Motion>(nowhere());
    };
    e.neutralText = "velocity (\"0*t\" 0 0)";
    e.did = motionDeed;
    return e;
}

/// A square or a cube of two cells, in the first corner of the grid whose nodes no particle reaches.
nodal::Body farBody(const EffectScene& s)
{
    const auto& grid = s.state.grid;
    const auto& p = s.state.particles;
    const double size = 2 * grid.h;
    for (int corner = 0; corner < 1 << grid.dim; ++corner)
    {
        Vector3 low{}, high{};
        for (int a = 0; a < grid.dim; ++a)
        {
            const auto n = std::size_t(a);
            low[n] = corner >> a & 1 ? grid.upper(a) - size : grid.origin[n];
            high[n] = low[n] + size;
        }
        bool far = true;
        for (std::size_t i = 0; i < std::size_t(p.size()) && far; ++i)
        {
            double most = 0;
            for (std::size_t a = 0; a < std::size_t(grid.dim); ++a)
                most = std::max({most, low[a] - p.x[a][i], p.x[a][i] - high[a]});
            far = most > 2.6 * grid.h;
        }
        if (!far)
            continue;
        const Location where{"body", 0};
        std::vector<Vector3> points;
        for (int n = 0; n < 1 << grid.dim; ++n)
            points.push_back({n & 1 ? high[0] : low[0], n & 2 ? high[1] : low[1], n & 4 ? high[2] : low[2]});
        auto surface = grid.dim == 2 ? nodal::RigidSurface::polygon({points[0], points[1], points[3], points[2]}, where)
                                     : nodal::RigidSurface(3, points, nodal::RigidSurface::boxTriangles(), where);
        auto motion = std::make_shared<nodal::RigidMotion>();
        motion->centre = surface.centroid();
        const auto shared = std::make_shared<const nodal::RigidSurface>(std::move(surface));
        return {"far", std::make_shared<nodal::RigidBody>(shared, motion->centre), 0.3, true, motion};
    }
    throw InputError("no corner of the grid is free for a body that touches nothing");
}

Effect rigidBodyEffect()
{
    Effect e{.name = "rigidBody",
             .family = EffectFamily::boundary,
             .word = "blade { geometry ...; mu 0.3; motion { ... } }",
             .file = "constant/rigidBodies",
             .help = "a rigid polygon or surface of triangles that moves as prescribed and pushes soil"};
    e.uses = [](const EffectScene& s) { return !s.scene.bodies.empty(); };
    e.without = [](EffectScene& s) { s.scene.bodies.clear(); };
    e.neutral = [](EffectScene& s) { s.scene.bodies.push_back(farBody(s)); };
    e.neutralText = "where no particle is";
    e.did = [](const EffectRun& run) -> Deed {
        const Index contacts = run.grown(&Ledger::bodyContacts);
        if (contacts == 0)
            return {0, "1", "0 contacts", false};
        return {double(contacts), "1",
                fmt::format("pressed {:.4g} nodes a step", double(contacts) / double(std::max<Index>(1, run.steps)))};
    };
    return e;
}

Effect absorbingEffect()
{
    Effect e{.name = "absorbing",
             .family = EffectFamily::boundary,
             .word = "type absorbing",
             .file = "constant/boundaryConditions",
             .help = "dashpots that let waves out, and a wave from below in"};
    e.uses = [](const EffectScene& s) { return !s.scene.absorbing.empty(); };
    e.without = [](EffectScene& s) { s.scene.absorbing.clear(); };
    e.neutral = [](EffectScene& s) { s.scene.absorbing.push_back({"side", 0, -1, s.state.grid.cells[0], 0, 0}); };
    e.neutralText = "normal 0; shear 0";
    e.did = [](const EffectRun& run) -> Deed {
        const double energy = run.grown(&Ledger::absorbedEnergy);
        if (energy == 0)
            return {0, "J", "0 J absorbed", false};
        return {energy, "J", "let out " + run.share(energy)};
    };
    return e;
}

Effect rampEffect()
{
    Effect e{.name = "gravityRamp",
             .family = EffectFamily::process,
             .word = "ramp { duration 1; shape smooth; }",
             .file = "constant/g",
             .help = "gravity that comes on over a time"};
    e.uses = [](const EffectScene& s) { return s.scene.gravityRamp.has_value(); };
    e.without = [](EffectScene& s) { s.scene.gravityRamp.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.gravityRamp = nodal::GravityRamp{0, false}; };
    e.neutralText = "duration 0";
    e.did = [](const EffectRun& run) -> Deed {
        if (!run.scene.gravity)
            return {0, "1", "no gravity to come on", false};
        const double now = run.scene.gravityRamp->mean(run.state.time, 1e-6 * run.scene.gravityRamp->duration);
        return {now, "1", fmt::format("{:.4g} of gravity has come on", now)};
    };
    return e;
}
} // namespace

std::vector<Effect> motionEffects()
{
    return {movingWallEffect(), rigidBodyEffect(), absorbingEffect(), rampEffect()};
}
} // namespace mpm::cases

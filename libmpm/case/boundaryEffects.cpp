// Effects of boundaries: walls, and loads on the surface.
#include "base/error.hpp"
#include "case/effectCatalogue.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using nodal::Load;
using nodal::Wall;
using nodal::WallType;
using stepping::Scene;
using Ledger = state::Ledger;

const std::string file = "constant/boundaryConditions";

/// Are all particles at least two cells away from a plane?
bool isFar(const state::State& state, int axis, Index plane)
{
    const auto& x = state.particles.x[std::size_t(axis)];
    const double position = state.grid.origin[std::size_t(axis)] + state.grid.h * double(plane);
    return std::all_of(x.begin(), x.begin() + state.particles.size(),
                       [&](double at) { return std::abs(at - position) > 2 * state.grid.h; });
}

/// A wall nothing touches, at a side of the grid where none is yet.
Wall farWall(const EffectScene& s, WallType type, bool separation)
{
    const auto& grid = s.state.grid;
    for (const int side : {1, -1})
        for (int axis = 0; axis < grid.dim; ++axis)
        {
            const Index plane = side > 0 ? grid.cells[std::size_t(axis)] : 0;
            const bool taken = std::any_of(s.scene.walls.begin(), s.scene.walls.end(),
                                           [&](const Wall& w) { return w.axis == axis && w.side == side; });
            if (!taken && !grid.periodic[std::size_t(axis)] && isFar(s.state, axis, plane))
                return {"far", type, axis, side, plane, 0, separation};
        }
    throw InputError("no side of the grid is free for a wall that touches nothing");
}

bool hasWall(const Scene& scene, WallType type)
{
    return std::any_of(scene.walls.begin(), scene.walls.end(), [&](const Wall& w) { return w.type == type; });
}

/// Friction and no friction differ in this alone.
bool isSmooth(const Wall& wall)
{
    return wall.type == WallType::roller && wall.separation;
}

Deed wallDeed(const EffectRun& run)
{
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a)
        square += std::pow(run.state.ledger.wallImpulse[a] - run.atStart.wallImpulse[a], 2);
    const double impulse = std::sqrt(square);
    if (impulse == 0)
        return {0, "N s", "0 contacts", false};
    return {impulse, "N s",
            fmt::format("impulse {:.4g} kN s of all walls, {} lost in impact", impulse / 1e3,
                        run.energy(run.grown(&Ledger::wallLoss)))};
}

Deed frictionDeed(const EffectRun& run)
{
    const Index contacts = run.grown(&Ledger::wallContacts);
    if (contacts == 0)
        return {0, "J", "0 contacts", false};
    const double work = run.grown(&Ledger::frictionDissipation);
    return {work, "J",
            fmt::format("took {} at {:.4g} nodes a step", run.share(work),
                        double(contacts) / double(std::max<Index>(1, run.steps)))};
}

/// fixed and roller.
Effect wallEffect(const std::string& name, WallType type, const std::string& help)
{
    Effect e{.name = name, .family = EffectFamily::boundary, .word = "type " + name, .file = file, .help = help};
    e.uses = [type](const EffectScene& s) { return hasWall(s.scene, type); };
    e.without = [type](EffectScene& s) { std::erase_if(s.scene.walls, [&](const Wall& w) { return w.type == type; }); };
    e.neutral = [type](EffectScene& s) { s.scene.walls.push_back(farWall(s, type, false)); };
    e.neutralText = "where no particle is";
    e.did = wallDeed;
    return e;
}

Effect frictionEffect()
{
    Effect e{.name = "friction",
             .family = EffectFamily::boundary,
             .word = "type friction",
             .file = file,
             .help = "a wall that pushes, with Coulomb friction"};
    e.uses = [](const EffectScene& s) { return hasWall(s.scene, WallType::friction); };
    e.without = [](EffectScene& s) {
        for (auto& wall : s.scene.walls)
            if (wall.type == WallType::friction)
                wall.type = WallType::roller;
    };
    e.base = [](EffectScene& s) { // a wall that may have friction
        auto& walls = s.scene.walls;
        if (std::any_of(walls.begin(), walls.end(), isSmooth))
            return;
        if (walls.empty())
            walls.push_back(farWall(s, WallType::roller, true));
        walls.front().type = WallType::roller;
        walls.front().separation = true;
    };
    e.neutral = [](EffectScene& s) {
        for (auto& wall : s.scene.walls)
            if (isSmooth(wall))
            {
                wall.type = WallType::friction;
                wall.mu = 0;
            }
    };
    e.neutralText = "mu 0";
    e.did = frictionDeed;
    return e;
}

Deed loadDeed(const EffectRun& run)
{
    const double work = run.grown(&Ledger::tractionWork);
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a)
        square += std::pow(run.state.ledger.tractionImpulse[a] - run.atStart.tractionImpulse[a], 2);
    if (square == 0)
        return {0, "J", "0 N s of load", false};
    return {work, "J",
            fmt::format("work {}, impulse {:.4g} kN s of all loads", run.energy(work), std::sqrt(square) / 1e3)};
}

/// A surface on top of the body: one element a particle of the uppermost row.
state::SurfacePatch topOf(const state::State& state)
{
    const auto& p = state.particles;
    const int dim = p.dim;
    state::SurfacePatch patch;
    patch.name = "top";
    const auto& y = p.x[1];
    const double top = *std::max_element(y.begin(), y.begin() + p.size());
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        if (y[i] < top - 0.5 * p.length0[1][i])
            continue;
        for (int a = 0; a < dim; ++a)
            patch.centre[std::size_t(a)].push_back(p.x[std::size_t(a)][i]);
        for (int k = 0; k < dim - 1; ++k)
            for (int a = 0; a < dim; ++a)
                patch.edges[std::size_t(k * dim + a)].push_back(
                    a == (k == 0 ? 0 : 2) ? double(p.length0[std::size_t(a)][i]) : 0);
    }
    return patch;
}

Effect loadEffect(const std::string& name, bool pressure, const std::string& help)
{
    Effect e{.name = name, .family = EffectFamily::boundary, .word = "type " + name, .file = file, .help = help};
    const auto mine = [pressure](const Load& load) { return load.pressure == pressure; };
    e.uses = [mine](const EffectScene& s) { return std::any_of(s.scene.loads.begin(), s.scene.loads.end(), mine); };
    e.without = [mine](EffectScene& s) { std::erase_if(s.scene.loads, mine); };
    e.neutral = [pressure](EffectScene& s) {
        if (s.state.patches.empty())
            s.state.patches.push_back(topOf(s.state));
        s.scene.loads.push_back({s.state.patches.front().name, pressure, {}, 0});
    };
    e.neutralText = pressure ? "value 0" : "value (0 0 0)";
    e.did = loadDeed;
    return e;
}
} // namespace

std::vector<Effect> boundaryEffects()
{
    return {
        wallEffect("fixed", WallType::fixed, "a wall that holds all motion"),
        wallEffect("roller", WallType::roller, "a wall that holds its normal and lets the body slide"),
        frictionEffect(),
        loadEffect("traction", false, "a given load vector on a surface"),
        loadEffect("pressure", true, "a given pressure on a surface"),
    };
}
} // namespace mpm::cases

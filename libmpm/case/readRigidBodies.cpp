#include "case/readRigidBodies.hpp"

#include "case/readSurface.hpp"
#include "nodal/insideBody.hpp"
#include "nodal/rigidBody.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;

namespace
{
nodal::RigidSurface readGeometry(const Dictionary& d, int dim)
{
    const double scale = d.get<double>({"scale", "factor of all coordinates", {}, Bound::positive(), 1.0});
    const bool file = d.found("geometry"), points = d.found("points");
    if (file == points)
        d.fail(file ? "points" : "geometry", file ? "points besides a geometry" : "nothing",
               dim == 2 ? "geometry \"geometry/blade.msh\"; or points ((0 0) (1 0) (1 2));"
                        : "geometry \"geometry/blade.stl\";");
    if (file)
        return readSurface(d.file("geometry", "the body's closed surface, .stl or .msh"), dim, scale);
    if (dim == 3)
        d.fail("points", "a polygon", "geometry \"geometry/blade.stl\"; in 3D");
    std::vector<Vector3> corners;
    for (const auto& row :
         d.get<std::vector<dictionary::TableRow>>({"points", "corners of a polygon (x y)", dictionary::unit::length}))
    {
        if (row.values.size() > 2 || (row.values.size() == 2 && row.values[1] != 0))
            throw InputError(row.where, "points: found a corner that is not (x y)");
        corners.push_back({scale * row.at, scale * row.values[0], 0});
    }
    return nodal::RigidSurface::polygon(corners, d.where("points"));
}

void refuseInsideSoil(const Dictionary& all, const nodal::Body& body, const state::State& state)
{
    const auto found = nodal::particlesInside(*body.body, state.particles, state.grid.h);
    if (found.count > 0)
        throw InputError(all.where(body.name),
                         fmt::format("{}: found {} particles inside the body at the start, particle {} the deepest, "
                                     "{:g} m ({:.2g} cells); allowed: a body that begins outside the soil",
                                     body.name, found.count, state.particles.id[std::size_t(found.deepest)],
                                     found.depth, found.depth / state.grid.h));
}

nodal::Body readBody(const Dictionary& all, const Dictionary& d, const std::string& name, const state::State& state)
{
    const int dim = state.particles.dim;
    const auto surface = std::make_shared<const nodal::RigidSurface>(readGeometry(d, dim));
    nodal::Body out;
    out.name = name;
    out.mu = d.get<double>({"mu", "Coulomb friction coefficient", {}, Bound::nonNegative(), 0.0});
    out.separation = d.get<bool>({"separation", "on: the body only pushes; off: it also holds", {}, {}, true});
    auto motion = std::make_shared<nodal::RigidMotion>();
    motion->centre = surface->centroid();
    if (const Dictionary* given = d.findDict("motion", "of the body; default: it rests"))
        *motion = nodal::RigidMotion::read(*given, dim, surface->centroid());
    const auto rigid = std::make_shared<nodal::RigidBody>(surface, motion->centre);
    rigid->move(motion->pose(state.time), {});
    out.body = rigid;
    out.motion = motion;

    const auto& grid = state.grid;
    const auto fail = [&](const std::string& what) { throw InputError(all.where(name), name + ": " + what); };
    for (int a = 0; a < dim; ++a)
    {
        const auto n = std::size_t(a);
        if (out.body->high()[n] < grid.origin[n] || out.body->low()[n] > grid.upper(a))
            fail(fmt::format("found a body at {} = {:g} to {:g}, outside the grid; allowed: {:g} to {:g} "
                             "(system/gridDict)",
                             axisNames[n], out.body->low()[n], out.body->high()[n], grid.origin[n], grid.upper(a)));
        if (grid.periodic[n])
            fail("found a rigid body in a periodic grid; allowed: no periodic in system/gridDict");
    }
    if (const double most = surface->depth(grid.h); most < 0.45 * grid.h)
        fail(fmt::format("found a body {:g} m thick at most, allowed is a cell, {:g} m, and more: nodes inside it have "
                         "to tell its sides apart",
                         2 * most, grid.h));
    if (state.step == 0)
        refuseInsideSoil(all, out, state);
    return out;
}
} // namespace

void readRigidBodies(const Dictionary& d, const state::State& state, stepping::Scene& scene)
{
    for (const auto& name : d.dictNames())
    {
        for (const char* taken : {"history", "energyBudget", "profile", "strainPaths", "accuracyCost"})
            if (name == taken)
                throw InputError(d.where(name), fmt::format("{0}: found a body called like postProcessing/{0}.csv, "
                                                            "allowed is another name",
                                                            name));
        for (const auto& wall : scene.walls)
            if (wall.name == name)
                throw InputError(
                    d.where(name),
                    fmt::format("{}: found a body and a wall of that name, allowed is another name", name));
        scene.bodies.push_back(readBody(d, d.subDict(name, "a rigid body"), name, state));
    }
}
} // namespace mpm::cases

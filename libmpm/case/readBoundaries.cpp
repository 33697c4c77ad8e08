#include "case/readBoundaries.hpp"

#include "nodal/wall.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

namespace
{
/// A plane normal to an axis.
struct Plane
{
    int axis = 0, side = -1;
    double position = 0;
};

Plane readPlane(const Dictionary& plane, int dim)
{
    const Vector3 n = plane.get<Vector3>({"normal", "outward normal, along an axis"});
    Plane out;
    int nonzero = 0;
    for (int a = 0; a < 3; ++a)
        if (n[a] != 0)
        {
            ++nonzero;
            out.axis = a;
            out.side = n[a] < 0 ? -1 : 1;
        }
    if (nonzero != 1 || out.axis >= dim)
        plane.fail("normal", fmt::format("({:g} {:g} {:g})", n[0], n[1], n[2]),
                   dim == 2 ? "(-1 0 0), (1 0 0), (0 -1 0) or (0 1 0)" : "a vector along one axis");
    out.position = plane.get<double>({"position", "coordinate of the plane along its normal's axis", unit::length});
    return out;
}

const state::SurfacePatch* findPatch(const state::State& state, const std::string& name)
{
    for (const auto& patch : state.patches)
        if (patch.name == name)
            return &patch;
    return nullptr;
}

std::vector<std::string> patchNames(const state::State& state)
{
    std::vector<std::string> names;
    for (const auto& patch : state.patches)
        names.push_back(patch.name);
    return names;
}

[[noreturn]] void failUnknownPatch(const Dictionary& all, const std::string& name, const state::State& state)
{
    const auto names = patchNames(state);
    const auto near = nearestWord(name, names);
    throw InputError(all.where(name),
                     fmt::format("{}: found no boundary of that name in the geometry{}; allowed: {}{}", name,
                                 near.empty() ? "" : " (did you mean '" + near + "'?)",
                                 names.empty() ? std::string("(the geometry names none)") : joinWords(names),
                                 ", or for a wall any name with plane { normal (0 -1 0); position 0; }"));
}

/// The plane all of a patch lies in.
Plane planeOfPatch(const Dictionary& all, const state::SurfacePatch& patch, int dim, double h)
{
    for (int a = 0; a < dim; ++a)
    {
        const auto [low, high] = std::minmax_element(patch.centre[a].begin(), patch.centre[a].end());
        bool flat = patch.size() > 0 && *high - *low <= 1e-9 * h;
        double outward = 0;
        for (Index e = 0; e < patch.size() && flat; ++e)
        {
            const auto edge = [&](int k) { return patch.edges[k][std::size_t(e)]; };
            for (int k = 0; k < dim - 1; ++k)
                flat = flat && std::abs(edge(k * dim + a)) <= 1e-9 * h;
            outward += dim == 2 ? (a == 0 ? edge(1) : -edge(0))
                                : edge((a + 1) % 3) * edge(3 + (a + 2) % 3) - edge((a + 2) % 3) * edge(3 + (a + 1) % 3);
        }
        if (flat && outward != 0)
            return {a, outward < 0 ? -1 : 1, 0.5 * (*low + *high)};
    }
    throw InputError(
        all.where(patch.name),
        fmt::format("{}: found a boundary that is not flat and normal to an axis; a wall must be: give it as "
                    "plane {{ normal (0 -1 0); position 0; }}",
                    patch.name));
}

/// A wall no particle can reach would be ignored, one with its normal into the soil would hold all of it.
void refuseUselessWall(const Dictionary& all, const nodal::Wall& wall, const state::State& state)
{
    const auto& grid = state.grid;
    const auto axis = std::size_t(wall.axis);
    const double position = nodal::wallPosition(wall, grid, 0);
    const double slack = 1e-6 * grid.h;
    if (position < grid.origin[axis] - slack || position > grid.upper(wall.axis) + slack)
        throw InputError(
            all.where(wall.name),
            fmt::format("{}: found a wall at {} = {:g}, outside the grid; allowed: {:g} to {:g} (system/gridDict)",
                        wall.name, axisNames[axis], position, grid.origin[axis], grid.upper(wall.axis)));
    const auto& p = state.particles;
    const double now = nodal::wallPosition(wall, grid, state.time);
    const auto behind = [&](Index i) { return wall.side * (p.x[axis][std::size_t(i)] - now) > grid.h; };
    Index count = 0, first = -1;
    for (Index i = 0; i < p.size(); ++i)
        if (behind(i) && count++ == 0)
            first = i;
    if (count > 0)
        throw InputError(
            all.where(wall.name),
            fmt::format("{}: found {} of {} particles behind the wall at {} = {:g}, particle {} at {:g} the first; "
                        "allowed: a normal that points out of the soil, and a position beside it",
                        wall.name, count, p.size(), axisNames[axis], now, p.id[std::size_t(first)],
                        p.x[axis][std::size_t(first)]));
}

/// Walls are whole planes: of two that face the same way only the inner one acts, and on one plane friction would act
/// twice.
void refuseSecondWall(const Dictionary& all, const nodal::Wall& wall, const std::vector<nodal::Wall>& others)
{
    for (const auto& other : others)
        if (other.axis == wall.axis && other.side == wall.side)
            throw InputError(
                all.where(wall.name),
                fmt::format("{}: found a second wall with outward normal {}{}, besides '{}'; allowed: one, as a "
                            "wall is a whole plane",
                            wall.name, wall.side < 0 ? '-' : '+', axisNames[std::size_t(wall.axis)], other.name));
}

/// The plane of a boundary: its own, or that of the patch of its name.
Plane readOwnPlane(const Dictionary& all, const Dictionary& d, const std::string& name, const state::State& state)
{
    const int dim = state.particles.dim;
    Plane plane;
    if (const Dictionary* own = d.findDict("plane", "the boundary's plane; default: that of the boundary of this name"))
        plane = readPlane(*own, dim);
    else if (const auto* patch = findPatch(state, name))
        plane = planeOfPatch(all, *patch, dim, state.grid.h);
    else
        failUnknownPatch(all, name, state);
    if (state.grid.periodic[std::size_t(plane.axis)])
        throw InputError(all.where(name),
                         fmt::format("{}: found a wall normal to {}, along which the grid is periodic; allowed: walls "
                                     "normal to other axes, or no periodic in system/gridDict",
                                     name, axisNames[std::size_t(plane.axis)]));
    return plane;
}

/// The plane of nodes at a position; between two of them is an error.
Index planeOfNodes(const Dictionary& all, const std::string& name, const Plane& plane, const state::GridBox& grid,
                   const char* otherwise)
{
    const double index = (plane.position - grid.origin[std::size_t(plane.axis)]) / grid.h;
    if (std::abs(index - std::round(index)) > 1e-6)
    {
        const auto at = [&](double i) { return grid.origin[std::size_t(plane.axis)] + grid.h * i; };
        throw InputError(all.where(name),
                         fmt::format("{}: found a wall at {} = {:g}, between planes of nodes; allowed: the nearest are "
                                     "{:.10g} and {:.10g} (or move min of system/gridDict{})",
                                     name, axisNames[std::size_t(plane.axis)], plane.position, at(std::floor(index)),
                                     at(std::floor(index) + 1), otherwise));
    }
    return Index(std::lround(index));
}

nodal::Absorbing readAbsorbing(const Dictionary& all, const Dictionary& d, const std::string& name,
                               const state::State& state, const stepping::Scene& scene)
{
    const auto word = d.get<std::string>({"material", "of the soil beside the boundary, whose impedance it has"});
    const constitutive::Material* material = nullptr;
    std::vector<std::string> names;
    for (const auto& m : scene.materials)
    {
        names.push_back(m.name);
        material = m.name == word ? &m : material;
    }
    if (!material)
        d.fail("material", "'" + word + "'", joinWords(names));
    const double shearSpeed = std::sqrt(material->law->shearModulus() / material->density);
    const double perCell = 2 / state.grid.h;
    nodal::Absorbing out;
    out.name = name;
    out.normalRate = perCell * material->waveSpeed() *
                     d.get<double>({"normal", "share of rho c_p along the normal", {}, Bound::between(0, 10), 1.0});
    out.shearRate = perCell * shearSpeed *
                    d.get<double>({"shear", "share of rho c_s along the plane", {}, Bound::between(0, 10), 1.0});
    if (const Dictionary* incoming = d.findDict("incoming", "velocity of a wave that comes in; default: none"))
        out.incoming =
            std::make_shared<const dictionary::Motion>(dictionary::Motion::read(*incoming, state.particles.dim));
    const Plane plane = readOwnPlane(all, d, name, state);
    out.axis = plane.axis;
    out.side = plane.side;
    out.plane = planeOfNodes(all, name, plane, state.grid, "");
    return out;
}

nodal::Wall readWall(const Dictionary& all, const Dictionary& d, const std::string& name, const std::string& type,
                     const state::State& state)
{
    nodal::Wall wall;
    wall.name = name;
    wall.type = type == "fixed"    ? nodal::WallType::fixed
                : type == "roller" ? nodal::WallType::roller
                                   : nodal::WallType::friction;
    if (wall.type == nodal::WallType::friction)
        wall.mu = d.get<double>({"mu", "Coulomb friction coefficient", {}, Bound::nonNegative()});
    wall.separation = d.get<bool>(
        {"separation", "on: the wall only pushes; off: it also holds", {}, {}, wall.type == nodal::WallType::friction});
    const int dim = state.particles.dim;
    const Plane plane = readOwnPlane(all, d, name, state);
    wall.axis = plane.axis;
    wall.side = plane.side;
    wall.position = plane.position;
    if (const Dictionary* motion = d.findDict("motion", "of the wall; default: it rests"))
    {
        auto given = dictionary::Motion::read(*motion, dim);
        for (const char* taken : {"history", "energyBudget", "profile", "strainPaths", "accuracyCost"})
            if (name == taken)
                throw InputError(all.where(name), fmt::format("{0}: found a moving wall called like "
                                                              "postProcessing/{0}.csv, allowed is another name",
                                                              name));
        if (!given.still())
            wall.motion = std::make_shared<const dictionary::Motion>(std::move(given));
    }
    const bool leaves = wall.motion && !wall.motion->stillAlong(std::size_t(plane.axis));
    wall.plane = leaves ? 0 : planeOfNodes(all, name, plane, state.grid, ", or give it a motion along its normal");
    refuseUselessWall(all, wall, state);
    return wall;
}
} // namespace

void readBoundaries(const Dictionary& d, const state::State& state, stepping::Scene& scene)
{
    for (const auto& name : d.dictNames())
    {
        const Dictionary& b = d.subDict(name, "a boundary");
        const auto type = b.choose("type", "what the boundary does",
                                   {{"fixed", "no motion"},
                                    {"roller", "no motion along the normal"},
                                    {"friction", "Coulomb friction"},
                                    {"absorbing", "dashpots that let waves out"},
                                    {"traction", "given load vector"},
                                    {"pressure", "given load along the inward normal"}});
        if (type == "absorbing")
        {
            const auto plane = readAbsorbing(d, b, name, state, scene);
            nodal::Wall same;
            same.name = name;
            same.axis = plane.axis;
            same.side = plane.side;
            same.plane = plane.plane;
            refuseUselessWall(d, same, state);
            for (const auto& other : scene.absorbing)
                if (other.axis == plane.axis && other.side == plane.side)
                    throw InputError(d.where(name), fmt::format("{}: found a second absorbing boundary that faces the "
                                                                "same way, besides '{}'; allowed: one",
                                                                name, other.name));
            if (plane.normalRate > 0 || plane.shearRate > 0)
                scene.absorbing.push_back(plane);
            continue;
        }
        if (type != "traction" && type != "pressure")
        {
            const nodal::Wall wall = readWall(d, b, name, type, state);
            refuseSecondWall(d, wall, scene.walls);
            scene.walls.push_back(wall);
            continue;
        }
        nodal::Load load;
        load.patch = name;
        load.pressure = type == "pressure";
        if (load.pressure)
            load.magnitude = b.get<double>({"value", "pressure", unit::pressure});
        else
            load.traction = b.get<Vector3>({"value", "load per current area", unit::pressure});
        if (state.particles.dim == 2 && load.traction[2] != 0)
            b.fail("value", fmt::format("a z component of {:g}", load.traction[2]), "0, as dimension is 2");
        if (!findPatch(state, name))
            failUnknownPatch(d, name, state);
        scene.loads.push_back(load);
    }
}
} // namespace mpm::cases

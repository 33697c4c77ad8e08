#include "coupling/couplingDict.hpp"

#include "base/error.hpp"
#include "coupling/readSurfaceMesh.hpp"
#include "dictionary/dictionary.hpp"

#include <fmt/format.h>

namespace mpm::coupling
{
using dictionary::Bound;
using dictionary::Dictionary;

namespace
{
constexpr const char* file = "system/couplingDict";

SurfaceMesh readMesh(const Dictionary& d, int dim, bool closed)
{
    const double scale = d.get<double>({"scale", "factor of all coordinates", {}, Bound::positive(), 1.0});
    const bool geometry = d.found("geometry"), points = d.found("points");
    if (geometry == points)
        d.fail(geometry ? "points" : "geometry", geometry ? "points besides a geometry" : "nothing",
               dim == 2 ? "geometry \"geometry/wall.msh\"; or points ((0 0) (1 0) (1 2));"
                        : "geometry \"geometry/wall.stl\";");
    if (geometry)
        return readSurfaceMesh(d.file("geometry", "the surface, .stl or .msh"), dim, closed, scale);
    if (dim == 3)
        d.fail("points", "a polygon", "geometry \"geometry/wall.stl\"; in 3D");
    std::vector<Vector3> corners;
    for (const auto& row :
         d.get<std::vector<dictionary::TableRow>>({"points", "corners (x y)", dictionary::unit::length}))
    {
        if (row.values.size() > 2 || (row.values.size() == 2 && row.values[1] != 0))
            throw InputError(row.where, "points: found a corner that is not (x y)");
        corners.push_back({scale * row.at, scale * row.values[0], 0});
    }
    return polygon(corners, closed);
}

NamedSurface readOne(const Dictionary& d, const std::string& name, int dim)
{
    NamedSurface out;
    out.name = name;
    out.kind = surfaceKind(d.choose(
        "type", "who moves the surface",
        {{"Rigid", "the master, as a whole"}, {"Deformable", "the master, each vertex"}, {"Monitor", "the soil"}}));
    const bool touches = out.kind != SurfaceKind::Monitor;
    out.mesh = readMesh(d, dim, touches);
    if (touches)
    {
        out.options.mu = d.get<double>({"mu", "Coulomb friction coefficient", {}, Bound::nonNegative(), 0.0});
        out.options.separation = d.get<bool>({"separation", "on: it only pushes; off: it also holds", {}, {}, true});
        out.options.referenceIsCentroid = !d.found("reference");
        if (!out.options.referenceIsCentroid)
            out.options.reference =
                d.get<Vector3>({"reference", "the point poses and torques speak of", dictionary::unit::length});
    }
    const auto word = d.choose("interpolation", "between the times a field was written for",
                               {{"constant", "what was said last"},
                                {"linear", "straight from one to the next"},
                                {"Hermite", "cubic, with written velocities as slopes"}},
                               std::string("linear"));
    out.interpolation = word == "constant" ? Interpolation::constant
                        : word == "linear" ? Interpolation::linear
                                           : Interpolation::Hermite;
    return out;
}
} // namespace

std::vector<NamedSurface> readCouplingDict(const cases::CaseDirectory& folder, int dim)
{
    std::vector<NamedSurface> out;
    if (!folder.hasFile(file))
        return out;
    const auto d = Dictionary::readFile(folder.dictionaryPath(file));
    d.passOver("preciceCoupling", "what preCICE exchanges (mpmCouple)");
    if (const auto* surfaces = d.findDict("surfaces", "coupling surfaces; default: none"))
        for (const auto& name : surfaces->dictNames())
        {
            const Dictionary& one = surfaces->subDict(name, "a coupling surface");
            try
            {
                out.push_back(readOne(one, name, dim));
                check(out.back().mesh, out.back().kind != SurfaceKind::Monitor, name);
            }
            catch (const CouplingError& error)
            {
                throw InputError(surfaces->where(name), error.what());
            }
        }
    d.rejectUnread();
    return out;
}
} // namespace mpm::coupling

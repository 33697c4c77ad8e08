#include "geometry/bodyGeometry.hpp"

#include "base/error.hpp"
#include "geometry/gmshMesh.hpp"
#include "geometry/region2D.hpp"
#include "geometry/region3D.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::geometry
{
namespace
{
using Surface = std::map<Simplex, Simplex>; ///< unoriented element -> as it faces outward

struct Loops
{
    std::vector<std::vector<int>> indices;
    std::unique_ptr<Region2D> region;
};

Loops makeLoops(const GmshMesh& mesh, const std::string& name, const std::vector<Simplex>& segments)
{
    Loops made;
    made.indices = chainLoops(mesh.points, segments, fmt::format("region '{}'", name));
    std::vector<Region2D::Loop> loops;
    for (const auto& loop : made.indices)
    {
        loops.emplace_back();
        for (const int i : loop)
            loops.back().push_back(mesh.points[std::size_t(i)]);
    }
    made.region = std::make_unique<Region2D>(name, std::move(loops));
    return made;
}

std::unique_ptr<Region> makeRegion2D(const GmshMesh& mesh, const RawRegion& raw, Surface& surface)
{
    double sum = 0;
    for (const auto& part : raw.parts)
    {
        const std::vector<Simplex> segments = oddElements({part});
        if (segments.empty())
            continue;
        const Loops loops = makeLoops(mesh, raw.name, segments);
        sum += loops.region->volume();
        for (std::size_t l = 0; raw.connected && loops.region->islands() > 1 && l < loops.region->loops(); ++l)
            if (l != loops.region->largest() && loops.region->island(l))
                throw InputError(
                    fmt::format("region '{}': a surface has a loop at {} that is not inside its outer loop; holes "
                                "must lie inside, separate areas need surfaces of their own",
                                raw.name, placeText(loops.region->loop(l)[0], 2)));
    }
    Loops whole = makeLoops(mesh, raw.name, oddElements(raw.parts));
    if (std::abs(sum - whole.region->volume()) > 1e-9 * sum)
        throw InputError(
            fmt::format("region '{}': its surfaces overlap: their areas add up to {:.9g}, together they cover {:.9g}",
                        raw.name, sum, whole.region->volume()));
    for (std::size_t l = 0; l < whole.indices.size(); ++l)
    {
        const auto& loop = whole.indices[l];
        for (std::size_t i = 0; i < loop.size(); ++i)
        {
            Simplex s = {loop[i], loop[(i + 1) % loop.size()], -1};
            if (whole.region->reversed(l))
                std::swap(s[0], s[1]);
            surface.emplace(unoriented(s), s);
        }
    }
    return std::move(whole.region);
}

std::unique_ptr<Region> makeRegion3D(const GmshMesh& mesh, const RawRegion& raw, Surface& surface)
{
    double sum = 0;
    if (raw.parts.size() > 1)
        for (const auto& part : raw.parts)
            sum += Region3D(raw.name, mesh.points, oddElements({part})).volume();
    auto region = std::make_unique<Region3D>(raw.name, mesh.points, oddElements(raw.parts));
    if (raw.parts.size() > 1 && std::abs(sum - region->volume()) > 1e-9 * sum)
        throw InputError(
            fmt::format("region '{}': its volumes overlap: they add up to {:.9g}, together they fill {:.9g}", raw.name,
                        sum, region->volume()));
    for (const Simplex& t : region->triangles())
        surface.emplace(unoriented(t), t);
    return region;
}

BoundaryElement element(const GmshMesh& mesh, const Simplex& s)
{
    BoundaryElement made;
    made.from = mesh.points[std::size_t(s[0])];
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t e = 0; e + 1 < std::size_t(mesh.dim); ++e)
            made.edges[e][k] = mesh.points[std::size_t(s[e + 1])][k] - made.from[k];
    return made;
}

Boundary makeBoundary(const GmshMesh& mesh, const RawBoundary& raw, const std::vector<Surface>& surfaces,
                      std::vector<std::string>& notes)
{
    Boundary boundary{raw.name, {}};
    for (const Simplex& s : raw.elements)
        for (const Surface& surface : surfaces)
            if (const auto found = surface.find(unoriented(s)); found != surface.end())
            {
                boundary.elements.push_back(element(mesh, found->second));
                break;
            }
    if (const std::size_t lost = raw.elements.size() - boundary.elements.size(); lost > 0)
        notes.push_back(fmt::format("boundary '{}': {} of its {} pieces bound no region and are left out", raw.name,
                                    lost, raw.elements.size()));
    return boundary;
}

void checkOverlaps(const BodyGeometry& body)
{
    for (std::size_t b = 1; b < body.regions.size(); ++b)
        for (std::size_t a = 0; a < b; ++a)
        {
            const auto &first = static_cast<const Region2D&>(*body.regions[a]),
                       &second = static_cast<const Region2D&>(*body.regions[b]);
            Vector3 place{};
            const double area = overlap(first, second, place);
            if (area > 1e-9 * std::min(first.volume(), second.volume()))
                throw InputError(
                    {body.file.string(), 0},
                    fmt::format("regions '{}' and '{}' overlap in {:.6g} m2 at {}; a point may belong to one "
                                "region only",
                                first.name(), second.name(), area, placeText(place, 2)));
        }
}
} // namespace

double Boundary::area() const
{
    double sum = 0;
    for (const BoundaryElement& b : elements)
    {
        const auto &e = b.edges[0], &f = b.edges[1];
        const bool segment = f == Vector3{};
        sum += segment
                   ? std::hypot(e[0], e[1])
                   : 0.5 * std::hypot(e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]);
    }
    return sum;
}

BodyGeometry readGeometry(const std::filesystem::path& file, int dim, double scale, double seconds)
{
    return makeBody(readGmsh(file, dim, scale, seconds));
}

BodyGeometry makeBody(GmshMesh mesh)
{
    BodyGeometry body;
    const int dim = body.dim = mesh.dim;
    const std::filesystem::path& file = body.file = mesh.file;
    body.notes = std::move(mesh.notes);
    std::vector<Surface> surfaces;
    for (const RawRegion& raw : mesh.regions)
        try
        {
            surfaces.emplace_back();
            body.regions.push_back(dim == 2 ? makeRegion2D(mesh, raw, surfaces.back())
                                            : makeRegion3D(mesh, raw, surfaces.back()));
        }
        catch (const InputError& error)
        {
            throw InputError({file.string(), 0}, error.what());
        }
    if (dim == 2)
        checkOverlaps(body);
    for (const RawBoundary& raw : mesh.boundaries)
        if (Boundary boundary = makeBoundary(mesh, raw, surfaces, body.notes); !boundary.elements.empty())
            body.boundaries.push_back(std::move(boundary));
    return body;
}
} // namespace mpm::geometry

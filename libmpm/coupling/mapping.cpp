#include "coupling/mapping.hpp"

#include "coupling/closestPoint.hpp"
#include "coupling/couplingError.hpp"
#include "nodal/vectors.hpp"

#include <fmt/format.h>

namespace mpm::coupling
{
namespace
{
void usable(const SurfaceMesh& mesh, bool elements, const char* which)
{
    const auto fail = [&](const std::string& what) {
        throw CouplingError(Fault::badSurface, fmt::format("the mesh values are mapped {}: {}", which, what));
    };
    if (mesh.vertices.empty())
        fail("found no vertices");
    for (std::size_t n = 0; n < mesh.vertices.size(); ++n)
        for (const double x : mesh.vertices[n])
            if (!std::isfinite(x))
                fail(fmt::format("found vertex {} with a coordinate {:g}", n, x));
    if (!elements)
        return;
    if (mesh.elements.empty())
        fail("found no elements to project on; nearestNeighbour needs none");
    for (std::size_t n = 0; n < mesh.elements.size(); ++n)
        for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
            if (const Index v = mesh.elements[n][k]; v < 0 || v >= Index(mesh.vertices.size()))
                fail(fmt::format("found element {} of vertex {}, allowed are 0 to {}", n, v, mesh.vertices.size() - 1));
    const auto areas = elementAreas(mesh);
    for (std::size_t n = 0; n < areas.size(); ++n)
        if (!(areas[n] > 0))
            fail(fmt::format("found element {} of no size", n));
}

void wantSize(std::size_t found, Index vertices, int components, const char* which)
{
    const std::size_t wanted = std::size_t(vertices) * std::size_t(std::max(components, 0));
    if (found != wanted)
        throw CouplingError(Fault::wrongSize, fmt::format("found {} values {}, allowed are {}: {} a vertex", found,
                                                          which, wanted, components));
}
} // namespace

Mapping::Mapping(const SurfaceMesh& from, const SurfaceMesh& to, MappingMethod method)
    : rows_(Index(to.vertices.size())), columns_(Index(from.vertices.size()))
{
    const bool project = method == MappingMethod::nearestProjection;
    usable(from, project, "from");
    usable(to, false, "to");
    if (from.dim != to.dim)
        throw CouplingError(Fault::badSurface,
                            fmt::format("found meshes of {} and {} dimensions, allowed are meshes of "
                                        "the same",
                                        from.dim, to.dim));
    if (project)
    {
        const ClosestPoint closest(from);
        for (Index i = 0; i < rows_; ++i)
        {
            const Foot foot = closest(to.vertices[std::size_t(i)]);
            distance_ = std::max(distance_, foot.distance);
            for (std::size_t k = 0; k < std::size_t(from.dim); ++k)
                if (foot.weights[k] != 0)
                    weights_.push_back({i, from.elements[std::size_t(foot.element)][k], foot.weights[k]});
        }
        return;
    }
    std::vector<BoxTree::Box> points;
    for (const auto& x : from.vertices)
        points.push_back({x, x});
    const BoxTree tree(std::move(points));
    for (Index i = 0; i < rows_; ++i)
    {
        const Vector3& x = to.vertices[std::size_t(i)];
        const auto hit = tree.nearest(x, [&](Index j) {
            const Vector3 d = nodal::minus(from.vertices[std::size_t(j)], x);
            return nodal::dot(d, d);
        });
        distance_ = std::max(distance_, std::sqrt(hit.distance2));
        weights_.push_back({i, hit.item, 1});
    }
}

void Mapping::consistent(std::span<const double> in, int components, std::span<double> out) const
{
    wantSize(in.size(), columns_, components, "to map from");
    wantSize(out.size(), rows_, components, "to map to");
    std::fill(out.begin(), out.end(), 0.0);
    const auto n = std::size_t(components);
    for (const auto& w : weights_)
        for (std::size_t c = 0; c < n; ++c)
            out[std::size_t(w.row) * n + c] += w.value * in[std::size_t(w.column) * n + c];
}

void Mapping::conservative(std::span<const double> in, int components, std::span<double> out) const
{
    wantSize(in.size(), rows_, components, "to map from");
    wantSize(out.size(), columns_, components, "to map to");
    std::fill(out.begin(), out.end(), 0.0);
    const auto n = std::size_t(components);
    for (const auto& w : weights_)
        for (std::size_t c = 0; c < n; ++c)
            out[std::size_t(w.column) * n + c] += w.value * in[std::size_t(w.row) * n + c];
}
} // namespace mpm::coupling

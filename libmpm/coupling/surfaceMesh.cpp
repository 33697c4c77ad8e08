#include "coupling/surfaceMesh.hpp"

#include "nodal/vectors.hpp"

#include <algorithm>
#include <numeric>

namespace mpm::coupling
{
using nodal::cross;
using nodal::dot;
using nodal::length;
using nodal::minus;
using nodal::plus;
using nodal::times;

namespace
{
/// Normal times size: length, or area.
Vector3 areaVector(const SurfaceMesh& mesh, const std::array<Index, 3>& e)
{
    const Vector3& a = mesh.vertices[std::size_t(e[0])];
    const Vector3 d = minus(mesh.vertices[std::size_t(e[1])], a);
    if (mesh.dim == 2)
        return {d[1], -d[0], 0};
    return times(0.5, cross(d, minus(mesh.vertices[std::size_t(e[2])], a)));
}

double sizeOf(const SurfaceMesh& mesh)
{
    Vector3 low = mesh.vertices.front(), high = low;
    for (const auto& x : mesh.vertices)
        for (std::size_t a = 0; a < 3; ++a)
        {
            low[a] = std::min(low[a], x[a]);
            high[a] = std::max(high[a], x[a]);
        }
    return length(minus(high, low));
}
} // namespace

SurfaceMesh polygon(const std::vector<Vector3>& corners, bool closed)
{
    SurfaceMesh out{2, corners, {}};
    const auto count = Index(corners.size());
    for (Index n = 0; n + (closed ? 0 : 1) < count; ++n)
        out.elements.push_back({n, (n + 1) % count, -1});
    if (closed && enclosedVolume(out) < 0)
        for (auto& e : out.elements)
            std::swap(e[0], e[1]);
    return out;
}

/// Sorted along a direction that no lattice has, only vertices next to each other need be compared.
std::vector<Index> firstAtPlace(const SurfaceMesh& mesh)
{
    const auto& x = mesh.vertices;
    std::vector<Index> order(x.size()), out(x.size());
    std::iota(order.begin(), order.end(), Index(0));
    std::iota(out.begin(), out.end(), Index(0));
    if (x.empty())
        return out;
    const double tolerance = 1e-9 * sizeOf(mesh);
    const auto along = [&](Index n) { return dot(x[std::size_t(n)], {0.7548776662, 0.5698402910, 0.3247179572}); };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const double s = along(a), t = along(b);
        return s < t || (s == t && a < b);
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size() && along(order[j]) - along(order[i]) <= tolerance; ++j)
        {
            auto &a = out[std::size_t(order[i])], &b = out[std::size_t(order[j])];
            if (length(minus(x[std::size_t(order[j])], x[std::size_t(order[i])])) <= tolerance)
                a = b = std::min(a, b);
        }
    return out;
}

SurfaceMesh merged(const SurfaceMesh& mesh)
{
    const auto first = firstAtPlace(mesh);
    std::vector<Index> name(first.size(), -1);
    SurfaceMesh out{mesh.dim, {}, mesh.elements};
    for (std::size_t n = 0; n < first.size(); ++n)
        if (first[n] == Index(n))
        {
            name[n] = Index(out.vertices.size());
            out.vertices.push_back(mesh.vertices[n]);
        }
    for (auto& e : out.elements)
        for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
        {
            Index n = e[k];
            while (first[std::size_t(n)] != n)
                n = first[std::size_t(n)];
            e[k] = name[std::size_t(n)];
        }
    return out;
}

std::vector<Vector3> elementNormals(const SurfaceMesh& mesh)
{
    std::vector<Vector3> out;
    out.reserve(mesh.elements.size());
    for (const auto& e : mesh.elements)
    {
        const Vector3 n = areaVector(mesh, e);
        const double size = length(n);
        out.push_back(size > 0 ? times(1 / size, n) : n);
    }
    return out;
}

std::vector<double> elementAreas(const SurfaceMesh& mesh)
{
    std::vector<double> out;
    out.reserve(mesh.elements.size());
    for (const auto& e : mesh.elements)
        out.push_back(length(areaVector(mesh, e)));
    return out;
}

std::vector<double> vertexAreas(const SurfaceMesh& mesh)
{
    std::vector<double> out(mesh.vertices.size());
    for (const auto& e : mesh.elements)
    {
        const double share = length(areaVector(mesh, e)) / mesh.dim;
        for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
            out[std::size_t(e[k])] += share;
    }
    return out;
}

double enclosedVolume(const SurfaceMesh& mesh)
{
    double sum = 0;
    if (mesh.vertices.empty())
        return sum;
    const Vector3 origin = mesh.vertices.front();
    for (const auto& e : mesh.elements)
        sum += dot(areaVector(mesh, e), minus(mesh.vertices[std::size_t(e[0])], origin)) / mesh.dim;
    return sum;
}
} // namespace mpm::coupling

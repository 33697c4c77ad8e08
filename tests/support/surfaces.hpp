#pragma once
/// Surfaces for tests: circles, spheres, plates, a cube.
#include "coupling/surfaceMesh.hpp"
#include "nodal/rigidSurface.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace mpm::tests
{
using coupling::SurfaceMesh;

/// A polygon in a circle of radius 1, the first corner at `start` [rad].
inline SurfaceMesh circle(int corners, double start = 0)
{
    std::vector<Vector3> x;
    for (int n = 0; n < corners; ++n)
        x.push_back({std::cos(start + 2 * M_PI * n / corners), std::sin(start + 2 * M_PI * n / corners), 0});
    return coupling::polygon(x, true);
}

/// An octahedron whose triangles are divided into four `levels` times, its vertices on the sphere of radius 1; turned
/// about (1 2 3) by `angle`.
inline SurfaceMesh sphere(int levels, double angle = 0)
{
    SurfaceMesh out{3,
                    {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    for (int level = 0; level < levels; ++level)
    {
        std::map<std::pair<Index, Index>, Index> middles;
        const auto middle = [&](Index a, Index b) {
            const auto [at, isNew] = middles.try_emplace({std::min(a, b), std::max(a, b)}, Index(out.vertices.size()));
            if (isNew)
            {
                const Vector3 x = nodal::plus(out.vertices[std::size_t(a)], out.vertices[std::size_t(b)]);
                out.vertices.push_back(nodal::times(1 / nodal::length(x), x));
            }
            return at->second;
        };
        std::vector<std::array<Index, 3>> finer;
        for (const auto& e : out.elements)
        {
            const Index a = middle(e[0], e[1]), b = middle(e[1], e[2]), c = middle(e[2], e[0]);
            for (const std::array<Index, 3>& part :
                 std::initializer_list<std::array<Index, 3>>{{e[0], a, c}, {a, e[1], b}, {c, b, e[2]}, {a, b, c}})
                finer.push_back(part);
        }
        out.elements = finer;
    }
    const Vector3 axis = nodal::times(1 / std::sqrt(14.0), {1, 2, 3});
    for (auto& x : out.vertices) // Rodrigues
        x = nodal::plus(nodal::times(std::cos(angle), x),
                        nodal::plus(nodal::times(std::sin(angle), nodal::cross(axis, x)),
                                    nodal::times((1 - std::cos(angle)) * nodal::dot(axis, x), axis)));
    return out;
}

/// The unit square z = 0 of nx x ny fields of two triangles each, facing up.
inline SurfaceMesh plate(int nx, int ny)
{
    SurfaceMesh out{3, {}, {}};
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
            out.vertices.push_back({double(i) / nx, double(j) / ny, 0});
    for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i)
        {
            const Index a = i + j * (nx + 1), b = a + 1, c = a + nx + 1, d = c + 1;
            out.elements.push_back({a, b, d});
            out.elements.push_back({a, d, c});
        }
    return out;
}

/// The unit cube of 12 triangles.
inline SurfaceMesh cube()
{
    SurfaceMesh out{3, {}, nodal::RigidSurface::boxTriangles()};
    for (int n = 0; n < 8; ++n)
        out.vertices.push_back({n & 1 ? 1.0 : 0.0, n & 2 ? 1.0 : 0.0, n & 4 ? 1.0 : 0.0});
    return out;
}
} // namespace mpm::tests

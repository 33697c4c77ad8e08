#include "geometry/alphaWrap.hpp"

#include <CGAL/alpha_wrap_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <numeric>

namespace mpm::geometry
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Triangle = Kernel::Triangle_3;
using Triangles = std::vector<Triangle>;
using Tree =
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

/// Corner c of a box has sign + along axis k where bit k of c is set.
Point corner(const ParticleDomain& domain, unsigned c)
{
    Vector3 at = domain.centre;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i)
            at[i] += (c >> k & 1 ? 0.5 : -0.5) * domain.edges[k][i];
    return {at[0], at[1], at[2]};
}

/// Two triangles a side.
constexpr std::array<std::array<std::size_t, 3>, 12> sides = {{{0, 2, 6},
                                                               {0, 6, 4},
                                                               {1, 3, 7},
                                                               {1, 7, 5},
                                                               {0, 1, 5},
                                                               {0, 5, 4},
                                                               {2, 3, 7},
                                                               {2, 7, 6},
                                                               {0, 1, 3},
                                                               {0, 3, 2},
                                                               {4, 5, 7},
                                                               {4, 7, 6}}};

void numberPieces(Wrap& wrap)
{
    std::vector<int> root(wrap.points.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int v) {
        while (root[std::size_t(v)] != v)
            v = root[std::size_t(v)] = root[std::size_t(root[std::size_t(v)])];
        return v;
    };
    for (const Simplex& t : wrap.elements)
        for (const int other : {t[1], t[2]})
            root[std::size_t(find(other))] = find(t[0]);
    std::vector<int> number(wrap.points.size(), -1);
    for (const Simplex& t : wrap.elements)
    {
        int& n = number[std::size_t(find(t[0]))];
        if (n < 0)
            n = wrap.pieces++;
        wrap.piece.push_back(n);
    }
}
} // namespace

Wrap alphaWrap3D(const std::vector<ParticleDomain>& domains, double alpha, double offset)
{
    std::vector<Point> points;
    std::vector<std::array<std::size_t, 3>> faces;
    Triangles triangles;
    for (const ParticleDomain& domain : domains)
    {
        const std::size_t first = points.size();
        for (unsigned c = 0; c < 8; ++c)
            points.push_back(corner(domain, c));
        for (const auto& side : sides)
        {
            const Triangle triangle(points[first + side[0]], points[first + side[1]], points[first + side[2]]);
            if (triangle.is_degenerate())
                continue;
            faces.push_back({first + side[0], first + side[1], first + side[2]});
            triangles.push_back(triangle);
        }
    }
    Wrap wrap;
    if (triangles.empty())
        return wrap;
    Mesh mesh;
    CGAL::alpha_wrap_3(points, faces, alpha, offset, mesh);

    // Points lie on the surface at distance `offset`, so their directions are those of the nearest places on the boxes.
    const Tree tree(triangles.begin(), triangles.end());
    for (const auto v : mesh.vertices())
    {
        const Point& p = mesh.point(v);
        const auto away = p - tree.closest_point(p);
        const double length = std::sqrt(away.squared_length());
        wrap.points.push_back({p.x(), p.y(), p.z()});
        wrap.outward.push_back(length > 0 ? Vector3{away.x() / length, away.y() / length, away.z() / length}
                                          : Vector3{});
    }
    for (const auto f : mesh.faces())
    {
        const auto h = mesh.halfedge(f);
        wrap.elements.push_back(
            {int(mesh.source(h).idx()), int(mesh.target(h).idx()), int(mesh.target(mesh.next(h)).idx())});
    }
    numberPieces(wrap);
    return wrap;
}
} // namespace mpm::geometry

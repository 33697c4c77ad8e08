#include "geometry/alphaWrap.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace mpm::geometry
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;

constexpr int unseen = -1, carved = -2; ///< else the number of a face's piece

using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using Face = Delaunay::Face_handle;

/// Points all over a box, neighbours at most alpha apart.
void samplePoints(const ParticleDomain& domain, double alpha, std::vector<Point>& out)
{
    std::array<int, 2> parts;
    for (std::size_t k = 0; k < 2; ++k)
        parts[k] = std::max(1, int(std::ceil(std::hypot(domain.edges[k][0], domain.edges[k][1]) / alpha)));
    for (int i = 0; i <= parts[0]; ++i)
        for (int j = 0; j <= parts[1]; ++j)
        {
            const double r = double(i) / parts[0] - 0.5, s = double(j) / parts[1] - 0.5;
            out.emplace_back(domain.centre[0] + r * domain.edges[0][0] + s * domain.edges[1][0],
                             domain.centre[1] + r * domain.edges[0][1] + s * domain.edges[1][1]);
        }
}

class Carving
{
  public:
    Carving(const std::vector<Point>& points, double alpha) : mesh_(points.begin(), points.end()), alpha_(alpha)
    {
        for (auto f = mesh_.all_faces_begin(); f != mesh_.all_faces_end(); ++f)
            f->info() = unseen;
        for (auto f = mesh_.all_faces_begin(); f != mesh_.all_faces_end(); ++f)
            if (mesh_.is_infinite(f) || isHollow(f))
                spread(f, carved, [&](Face face, int i) { return mesh_.is_infinite(face, i) || passable(face, i); });
    }

    Wrap wrap()
    {
        Wrap out;
        for (auto f = mesh_.finite_faces_begin(); f != mesh_.finite_faces_end(); ++f)
            if (f->info() == unseen)
                spread(f, out.pieces++, [](Face, int) { return true; });
        std::vector<std::vector<Simplex>> sides(static_cast<std::size_t>(out.pieces));
        std::vector<Vector3> places;
        for (auto v = mesh_.finite_vertices_begin(); v != mesh_.finite_vertices_end(); ++v)
        {
            v->info() = int(places.size());
            places.push_back({v->point().x(), v->point().y(), 0});
        }
        for (auto f = mesh_.finite_faces_begin(); f != mesh_.finite_faces_end(); ++f)
            for (int i = 0; i < 3; ++i)
                if (f->info() >= 0 && f->neighbor(i)->info() == carved)
                    sides[std::size_t(f->info())].push_back(
                        {f->vertex(mesh_.ccw(i))->info(), f->vertex(mesh_.cw(i))->info(), -1});
        for (std::size_t piece = 0; piece < sides.size(); ++piece)
            addLoops(places, sides[piece], int(piece), out);
        return out;
    }

  private:
    /// Does an empty disc larger than alpha lie around the middle of the triangle?
    bool isHollow(Face f) const
    {
        const Point &a = f->vertex(0)->point(), &b = f->vertex(1)->point(), &c = f->vertex(2)->point();
        return CGAL::angle(a, b, c) != CGAL::OBTUSE && CGAL::angle(b, c, a) != CGAL::OBTUSE &&
               CGAL::angle(c, a, b) != CGAL::OBTUSE && CGAL::squared_radius(a, b, c) > alpha_ * alpha_;
    }

    bool passable(Face f, int i) const
    {
        return CGAL::squared_distance(f->vertex(mesh_.ccw(i))->point(), f->vertex(mesh_.cw(i))->point()) >
               4 * alpha_ * alpha_;
    }

    /// Gives a face and all it reaches over passable edges a number.
    template <class Passable>
    void spread(Face from, int number, Passable&& passable)
    {
        std::vector<Face> open{from};
        while (!open.empty())
        {
            const Face f = open.back();
            open.pop_back();
            if (f->info() != unseen)
                continue;
            f->info() = number;
            for (int i = 0; i < 3; ++i)
                if (f->neighbor(i)->info() == unseen && passable(f, i))
                    open.push_back(f->neighbor(i));
        }
    }

    static void addLoops(const std::vector<Vector3>& places, const std::vector<Simplex>& sides, int piece, Wrap& out);

    Delaunay mesh_;
    double alpha_;
};

/// Loops keep the direction of their sides. A place that two loops pass becomes two points, so that the surface can
/// move.
void Carving::addLoops(const std::vector<Vector3>& places, const std::vector<Simplex>& sides, int piece, Wrap& out)
{
    std::set<std::pair<int, int>> runs;
    for (const Simplex& s : sides)
        runs.insert({s[0], s[1]});
    for (std::vector<int> loop : chainLoops(places, sides, "the material"))
    {
        if (!runs.count({loop[0], loop[1]}))
            std::reverse(loop.begin(), loop.end());
        const int first = int(out.points.size()), n = int(loop.size());
        for (int i = 0; i < n; ++i)
        {
            const auto at = [&](int k) { return places[std::size_t(loop[std::size_t((k + n) % n)])]; };
            const Vector3 before = at(i - 1), here = at(i), behind = at(i + 1);
            const double a = std::hypot(here[0] - before[0], here[1] - before[1]),
                         b = std::hypot(behind[0] - here[0], behind[1] - here[1]);
            // both sides move out by 1, in sharp corners the corner does
            const Vector3 n1{(here[1] - before[1]) / a, (before[0] - here[0]) / a, 0},
                n2{(behind[1] - here[1]) / b, (here[0] - behind[0]) / b, 0};
            const double along = std::max(0.5, 1 + n1[0] * n2[0] + n1[1] * n2[1]);
            out.points.push_back(here);
            out.outward.push_back({(n1[0] + n2[0]) / along, (n1[1] + n2[1]) / along, 0});
            out.elements.push_back({first + i, first + (i + 1) % n, -1});
            out.piece.push_back(piece);
        }
    }
}
} // namespace

Wrap alphaWrap2D(const std::vector<ParticleDomain>& domains, double alpha)
{
    std::vector<Point> points;
    for (const ParticleDomain& domain : domains)
        samplePoints(domain, alpha, points);
    return Carving(points, alpha).wrap();
}
} // namespace mpm::geometry

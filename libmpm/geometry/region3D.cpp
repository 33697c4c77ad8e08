#include "geometry/region3D.hpp"

#include "base/error.hpp"
#include "geometry/rowIntegral.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <unordered_map>

namespace mpm::geometry
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

Vector3 vector(const Point& p)
{
    return {p.x(), p.y(), p.z()};
}

/// Where an edge of one triangle passes through another, for a message; nothing where rounding hides it. (CGAL's
/// intersection() with inexact constructions ends the program when numbers overflow or vanish.)
std::optional<Point> commonPoint(const Kernel::Triangle_3& edges, const Kernel::Triangle_3& face)
{
    const auto normal = CGAL::cross_product(face[1] - face[0], face[2] - face[0]);
    for (int k = 0; k < 3; ++k)
    {
        const Point& from = edges[k];
        const double before = normal * (from - face[0]), behind = normal * (edges[k + 1] - face[0]);
        const Point at = from + before / (before - behind) * (edges[k + 1] - from);
        bool inside = before * behind <= 0 && before != behind;
        for (int i = 0; i < 3; ++i)
            inside = inside && normal * CGAL::cross_product(face[i + 1] - face[i], at - face[i]) >= 0;
        if (inside)
            return at;
    }
    return std::nullopt;
}

/// A triangle of the surface with its range, for the sweep.
struct Facet
{
    std::array<Vector3, 3> corners;
    double low(std::size_t axis) const { return std::min({corners[0][axis], corners[1][axis], corners[2][axis]}); }
    double high(std::size_t axis) const { return std::max({corners[0][axis], corners[1][axis], corners[2][axis]}); }
};
} // namespace

struct Region3D::Body
{
    Mesh mesh;
    std::unique_ptr<CGAL::Side_of_triangle_mesh<Mesh, Kernel>> side;
    std::vector<Vector3> vertices;
    std::vector<Simplex> triangles;
    std::vector<Facet> facets; ///< by ascending lowest z

    void build(const std::string& name, const std::vector<Vector3>& points);
    void checkSurface(const std::string& name) const;
    void turnOutward(const std::vector<Vector3>& points);
    void sweepLayer(const std::string& name, const BoxTiling& tiling, Index layer, double z0, double z1,
                    std::vector<std::vector<Vector3>>& polygons, const Row& visit) const;
};

/// Points used by the triangles become vertices; points that coincide become one.
void Region3D::Body::build(const std::string& name, const std::vector<Vector3>& points)
{
    std::map<Vector3, std::size_t> number;
    std::vector<Point> soupPoints;
    std::vector<std::array<std::size_t, 3>> soup;
    for (const Simplex& t : triangles)
    {
        std::array<std::size_t, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
        {
            const Vector3& p = points[std::size_t(t[k])];
            const auto [at, isNew] = number.emplace(p, soupPoints.size());
            if (isNew)
            {
                soupPoints.emplace_back(p[0], p[1], p[2]);
                vertices.push_back(p);
            }
            corners[k] = at->second;
        }
        if (CGAL::collinear(soupPoints[corners[0]], soupPoints[corners[1]], soupPoints[corners[2]]))
            throw InputError(
                fmt::format("region '{}': a triangle of no area at {}", name, placeText(vertices[corners[0]], 3)));
        soup.push_back(corners);
    }
    PMP::orient_polygon_soup(soupPoints, soup); // keeps the order of triangles; may double points
    PMP::polygon_soup_to_polygon_mesh(soupPoints, soup, mesh);
}

void Region3D::Body::checkSurface(const std::string& name) const
{
    std::size_t open = 0;
    Vector3 place{};
    for (const auto h : mesh.halfedges())
        if (mesh.is_border(h) && open++ == 0)
            place = vector(CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
    if (open > 0)
        throw InputError(
            fmt::format("region '{}': its surface is open: {} of its edges have only one triangle (or more than "
                        "two that do not match), the first at {}; close the surface",
                        name, open, placeText(place, 3)));
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> cuts;
    PMP::self_intersections(mesh, std::back_inserter(cuts));
    if (cuts.empty())
        return;
    const auto triangle = [&](Mesh::Face_index f) {
        const auto h = mesh.halfedge(f);
        return Kernel::Triangle_3(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                  mesh.point(mesh.target(mesh.next(h))));
    };
    const auto first = triangle(cuts[0].first), second = triangle(cuts[0].second);
    place = vector(commonPoint(first, second).value_or(commonPoint(second, first).value_or(CGAL::centroid(first))));
    throw InputError(
        fmt::format("region '{}': its surface cuts or touches itself in {} pairs of triangles, the first at {}", name,
                    cuts.size(), placeText(place, 3)));
}

/// Turns the mesh so that it bounds a volume, and the triangles with it.
void Region3D::Body::turnOutward(const std::vector<Vector3>& points)
{
    PMP::orient_to_bound_a_volume(mesh);
    std::size_t f = 0;
    for (Simplex& t : triangles)
    {
        const auto h = mesh.halfedge(Mesh::Face_index(Mesh::size_type(f++)));
        const auto place = [&](const Vector3& p) {
            auto g = h;
            for (int k = 0; k < 3 && vector(mesh.point(mesh.source(g))) != p; ++k)
                g = mesh.next(g);
            return g;
        };
        const auto start = place(points[std::size_t(t[0])]);
        if (vector(mesh.point(mesh.target(start))) != points[std::size_t(t[1])])
            std::swap(t[1], t[2]);
        facets.push_back({{points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]}});
    }
    std::stable_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.low(2) < b.low(2); });
}

Region3D::Region3D(std::string name, const std::vector<Vector3>& points, const std::vector<Simplex>& triangles)
    : Region(std::move(name), 3), body_(std::make_unique<Body>())
{
    if (triangles.empty())
        throw InputError(fmt::format("region '{}' has no surface", name_));
    body_->triangles = triangles;
    body_->build(name_, points);
    body_->checkSurface(name_);
    body_->turnOutward(points);
    body_->side = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel>>(body_->mesh);

    lower_ = upper_ = body_->vertices[0];
    for (const Vector3& v : body_->vertices)
        for (std::size_t k = 0; k < 3; ++k)
        {
            lower_[k] = std::min(lower_[k], v[k]);
            upper_[k] = std::max(upper_[k], v[k]);
        }
    long double volume = 0, moment[3] = {0, 0, 0}; // tetrahedra from the lower corner
    for (const Facet& facet : body_->facets)
    {
        Vector3 r[3];
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k = 0; k < 3; ++k)
                r[c][k] = facet.corners[c][k] - lower_[k];
        const long double v =
            (r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
             r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0])) /
            6;
        volume += v;
        for (std::size_t k = 0; k < 3; ++k)
            moment[k] += v * (r[0][k] + r[1][k] + r[2][k]) / 4;
    }
    volume_ = double(volume);
    for (std::size_t k = 0; k < 3; ++k)
        centroid_[k] = lower_[k] + double(moment[k] / volume);
}

Region3D::~Region3D() = default;

bool Region3D::contains(const Vector3& p) const
{
    return (*body_->side)(Point(p[0], p[1], p[2])) != CGAL::ON_UNBOUNDED_SIDE;
}

const std::vector<Vector3>& Region3D::vertices() const
{
    return body_->vertices;
}

const std::vector<Simplex>& Region3D::triangles() const
{
    return body_->triangles;
}

void Region3D::forEachRow(const BoxTiling& tiling, const Row& visit) const
{
    const std::vector<double> zPlanes = tiling.zPlanes();
    std::vector<const Facet*> active;
    std::vector<std::vector<Vector3>> polygons;
    std::vector<Vector3> above, between;
    std::size_t next = 0;
    for (std::size_t k = 0; k + 1 < zPlanes.size(); ++k)
    {
        const double z0 = zPlanes[k], z1 = zPlanes[k + 1];
        std::erase_if(active, [&](const Facet* f) { return f->high(2) <= z0; });
        for (; next < body_->facets.size() && body_->facets[next].low(2) < z1; ++next)
            if (body_->facets[next].high(2) > z0)
                active.push_back(&body_->facets[next]);
        polygons.clear();
        for (const Facet* f : active)
        {
            clipPolygon({f->corners.begin(), f->corners.end()}, 2, z0, false, above);
            clipPolygon(above, 2, z1, true, between);
            if (between.size() >= 3)
                polygons.push_back(between);
        }
        if (!polygons.empty())
            body_->sweepLayer(name_, tiling, Index(k), z0, z1, polygons, visit);
    }
}

void Region3D::Body::sweepLayer(const std::string& name, const BoxTiling& tiling, Index layer, double z0, double z1,
                                std::vector<std::vector<Vector3>>& polygons, const Row& visit) const
{
    const auto range = [](const std::vector<Vector3>& polygon) {
        const auto [low, high] = std::minmax_element(polygon.begin(), polygon.end(),
                                                     [](const Vector3& a, const Vector3& b) { return a[1] < b[1]; });
        return std::pair((*low)[1], (*high)[1]);
    };
    std::stable_sort(polygons.begin(), polygons.end(),
                     [&](const auto& a, const auto& b) { return range(a).first < range(b).first; });
    RowIntegral integral(3);
    std::vector<BoxPart> parts;
    std::vector<double> xPlanes;
    std::vector<const std::vector<Vector3>*> active;
    std::vector<Vector3> above, between;
    const std::vector<double> yPlanes = tiling.yPlanes(layer);
    std::size_t next = 0;
    for (std::size_t j = 0; j + 1 < yPlanes.size(); ++j)
    {
        const double y0 = yPlanes[j], y1 = yPlanes[j + 1];
        std::erase_if(active, [&](const auto* polygon) { return range(*polygon).second <= y0; });
        for (; next < polygons.size() && range(polygons[next]).first < y1; ++next)
            if (range(polygons[next]).second > y0)
                active.push_back(&polygons[next]);
        if (active.empty())
            continue;
        tiling.xPlanes(Index(j), layer, xPlanes);
        integral.start(xPlanes, {y0, y1, z0, z1});
        for (const auto* polygon : active)
        {
            clipPolygon(*polygon, 1, y0, false, above);
            clipPolygon(above, 1, y1, true, between);
            if (between.size() >= 3)
                integral.addPolygon(between);
        }
        Vector3 bad{};
        const auto inside = [&](const Vector3& p) { return (*side)(Point(p[0], p[1], p[2])) == CGAL::ON_BOUNDED_SIDE; };
        if (!integral.finish(inside, parts, bad))
            throw InputError(
                fmt::format("region '{}': its surface does not enclose a volume at {}", name, placeText(bad, 3)));
        if (!parts.empty())
            visit(Index(j), layer, parts);
    }
}

std::vector<std::size_t> cuttingTriangles(const std::vector<Vector3>& points, const std::vector<Simplex>& triangles)
{
    Mesh mesh;
    for (const Vector3& p : points)
        mesh.add_vertex({p[0], p[1], p[2]});
    const auto vertex = [](int v) { return Mesh::Vertex_index(Mesh::size_type(v)); };
    for (const Simplex& t : triangles)
        mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> cuts;
    PMP::self_intersections(mesh, std::back_inserter(cuts));
    std::vector<std::size_t> found;
    for (const auto& [a, b] : cuts)
        found.insert(found.end(), {std::size_t(a), std::size_t(b)});
    for (const auto f : mesh.faces())
    {
        const auto h = mesh.halfedge(f);
        if (CGAL::collinear(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                            mesh.point(mesh.target(mesh.next(h)))))
            found.push_back(std::size_t(f));
    }
    return found;
}
} // namespace mpm::geometry

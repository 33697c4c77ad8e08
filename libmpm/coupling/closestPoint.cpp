#include "coupling/closestPoint.hpp"

#include "nodal/vectors.hpp"

namespace mpm::coupling
{
using nodal::dot;
using nodal::length;
using nodal::minus;

namespace
{
Vector3 segmentWeights(const Vector3& a, const Vector3& b, const Vector3& x)
{
    const Vector3 ab = minus(b, a);
    const double t = std::clamp(dot(ab, minus(x, a)) / dot(ab, ab), 0.0, 1.0);
    return {1 - t, t, 0};
}

/// Corners, edges, inside: in whose Voronoi region is x?
Vector3 triangleWeights(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& x)
{
    const Vector3 ab = minus(b, a), ac = minus(c, a), ax = minus(x, a), bx = minus(x, b), cx = minus(x, c);
    const double d1 = dot(ab, ax), d2 = dot(ac, ax), d3 = dot(ab, bx), d4 = dot(ac, bx), d5 = dot(ab, cx),
                 d6 = dot(ac, cx);
    if (d1 <= 0 && d2 <= 0)
        return {1, 0, 0};
    if (d3 >= 0 && d4 <= d3)
        return {0, 1, 0};
    if (d6 >= 0 && d5 <= d6)
        return {0, 0, 1};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    {
        const double t = (d4 - d3) / (d4 - d3 + d5 - d6);
        return {0, 1 - t, t};
    }
    const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
    return {std::max(0.0, 1 - v - w), v, w};
}
} // namespace

Foot footPoint(const SurfaceMesh& mesh, Index element, const Vector3& x)
{
    const auto& e = mesh.elements[std::size_t(element)];
    const auto corner = [&](std::size_t k) -> const Vector3& { return mesh.vertices[std::size_t(e[k])]; };
    Foot out{element, mesh.dim == 2 ? segmentWeights(corner(0), corner(1), x)
                                    : triangleWeights(corner(0), corner(1), corner(2), x)};
    for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
        out.point = nodal::plus(out.point, nodal::times(out.weights[k], corner(k)));
    out.distance = length(minus(x, out.point));
    return out;
}

ClosestPoint::ClosestPoint(SurfaceMesh mesh) : mesh_(std::move(mesh))
{
    std::vector<BoxTree::Box> boxes;
    for (const auto& e : mesh_.elements)
    {
        BoxTree::Box box{mesh_.vertices[std::size_t(e[0])], mesh_.vertices[std::size_t(e[0])]};
        for (std::size_t k = 1; k < std::size_t(mesh_.dim); ++k)
            for (std::size_t a = 0; a < 3; ++a)
            {
                box.low[a] = std::min(box.low[a], mesh_.vertices[std::size_t(e[k])][a]);
                box.high[a] = std::max(box.high[a], mesh_.vertices[std::size_t(e[k])][a]);
            }
        boxes.push_back(box);
    }
    tree_ = BoxTree(std::move(boxes));
}

Foot ClosestPoint::operator()(const Vector3& x) const
{
    const auto hit = tree_.nearest(x, [&](Index e) {
        const double d = footPoint(mesh_, e, x).distance;
        return d * d;
    });
    return hit.item < 0 ? Foot{} : footPoint(mesh_, hit.item, x);
}
} // namespace mpm::coupling

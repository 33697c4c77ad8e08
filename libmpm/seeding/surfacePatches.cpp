#include "seeding/surfacePatches.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::seeding
{
namespace
{
/// Round-off in an edge that is as long as allowed must not double the number of pieces.
constexpr double slack = 1 + 1e-9;

double length(const Vector3& a, const Vector3& b)
{
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
}

Vector3 between(const Vector3& a, const Vector3& b, double t)
{
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// Appends the element with these corners (2 or 3).
void append(state::SurfacePatch& patch, int dim, const std::vector<Vector3>& corners)
{
    for (std::size_t k = 0; k < std::size_t(dim); ++k)
    {
        double sum = 0;
        for (const Vector3& c : corners)
            sum += c[k];
        patch.centre[k].push_back(sum / double(corners.size()));
        for (std::size_t e = 1; e < corners.size(); ++e)
            patch.edges[(e - 1) * std::size_t(dim) + k].push_back(corners[e][k] - corners[0][k]);
    }
}

void halveTriangle(state::SurfacePatch& patch, const Vector3& a, const Vector3& b, const Vector3& c, double longest)
{
    const double ab = length(a, b), bc = length(b, c), ca = length(c, a);
    const double most = std::max({ab, bc, ca});
    if (most <= longest * slack)
        return append(patch, 3, {a, b, c});
    // Turned so that a longest edge comes first; the orientation stays.
    if (ab < most)
        return halveTriangle(patch, b, c, a, longest);
    const Vector3 m = between(a, b, 0.5);
    halveTriangle(patch, a, m, c, longest);
    halveTriangle(patch, m, b, c, longest);
}
} // namespace

state::SurfacePatch makePatch(const geometry::Boundary& boundary, int dim, double longestEdge)
{
    state::SurfacePatch patch;
    patch.name = boundary.name;
    for (const geometry::BoundaryElement& element : boundary.elements)
    {
        const Vector3& a = element.from;
        const auto corner = [&](std::size_t e) {
            return Vector3{a[0] + element.edges[e][0], a[1] + element.edges[e][1], a[2] + element.edges[e][2]};
        };
        if (dim == 3)
        {
            halveTriangle(patch, a, corner(0), corner(1), longestEdge);
            continue;
        }
        const Vector3 b = corner(0);
        const int pieces = std::max(1, int(std::ceil(length(a, b) / (longestEdge * slack))));
        for (int i = 0; i < pieces; ++i)
            append(patch, 2, {between(a, b, double(i) / pieces), between(a, b, double(i + 1) / pieces)});
    }
    return patch;
}
} // namespace mpm::seeding

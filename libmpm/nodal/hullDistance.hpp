#pragma once
/// The plane that separates two small clouds of points best: normal to the line between the closest points of their
/// convex hulls (the hard-margin classifier of the two). Found by the algorithm of Gilbert, Johnson and Keerthi 1988
/// (doi 10.1109/56.2083) on the set of differences a - b, whose point closest to the origin is the shortest way.
/// Verified in tests/unit/hullDistance.cpp.
#include "base/types.hpp"

#include <optional>
#include <vector>

namespace mpm::nodal
{
/// Unit vector from the hull of `a` to the hull of `b`; none where the hulls touch or overlap (closer than `least`), or
/// where a cloud is empty.
std::optional<Vector3> separatingNormal(const std::vector<Vector3>& a, const std::vector<Vector3>& b, double least);
} // namespace mpm::nodal

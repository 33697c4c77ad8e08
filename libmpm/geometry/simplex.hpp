#pragma once
/// Surface elements by point indices, and the sums (modulo 2) of surfaces made of them.
#include "base/types.hpp"

#include <map>
#include <string>
#include <vector>

namespace mpm::geometry
{
/// A segment (a, b, -1) in 2D, a triangle (a, b, c) in 3D.
using Simplex = std::array<int, 3>;

/// The same element whichever way it runs.
Simplex unoriented(const Simplex& s);

/// Elements that occur an odd number of times, in the order and orientation of their first occurrence: the surface of
/// the union of bodies whose common faces match.
std::vector<Simplex> oddElements(const std::vector<std::vector<Simplex>>& pieces);

/// Joins segments (an even number at every point) into closed loops of point indices, each of which passes a point once
/// and none of which cross where they meet. Throws InputError naming `name` and the place of an open end.
std::vector<std::vector<int>> chainLoops(const std::vector<Vector3>& points, const std::vector<Simplex>& segments,
                                         const std::string& name);
} // namespace mpm::geometry

#pragma once
/// Sides of mesh elements as segments and triangles. Types are gmsh's numbers: 2 triangle, 3 quadrangle, 4 tetrahedron,
/// 5 hexahedron, 6 prism, 7 pyramid; nodes in gmsh's order.
#include "geometry/simplex.hpp"

namespace mpm::geometry
{
/// A triangle as it is; a quadrangle as two, cut at its smallest index, so that neighbours cut it alike.
void addFace(const std::vector<int>& nodes, std::vector<Simplex>& out);

/// Segments around a plane element, triangles around a solid one.
void addSides(int type, const std::vector<int>& nodes, std::vector<Simplex>& out);
} // namespace mpm::geometry

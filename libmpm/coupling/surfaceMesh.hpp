#pragma once
/// A coupling surface as a mesh: segments in 2D, triangles in 3D, in reference coordinates.
///
/// Vertices keep their numbers: a master that speaks of vertex 17 means vertex 17. So nothing is merged or turned here;
/// what is wrong is refused with the number of the vertex or element, counted from 0. Verified in
/// tests/unit/surfaceMesh.cpp.
#include "base/types.hpp"

#include <array>
#include <string>
#include <vector>

namespace mpm::coupling
{
struct SurfaceMesh
{
    int dim = 2;
    std::vector<Vector3> vertices;              ///< [m], z = 0 in 2D
    std::vector<std::array<Index, 3>> elements; ///< vertices of a segment (the third -1) or a triangle, from 0; outward
                                                ///< normal (e_y, -e_x), cross(e1, e2)
};

/// CouplingError (badSurface, naming `name`): no vertices or elements; a vertex that is not finite, has z != 0 in 2D or
/// belongs to no element; elements of vertices that are not there, of no size, twice there; neighbours that face
/// against each other; more than two elements at an edge. Of a closed surface also: two vertices at one place (to 1e-9
/// of its size), an open edge, one that faces inward as a whole or cuts itself.
void check(const SurfaceMesh& mesh, bool closed, const std::string& name);

/// Segments from corner to corner, and from the last to the first if closed; then turned to face outward.
SurfaceMesh polygon(const std::vector<Vector3>& corners, bool closed);
/// Vertices at one place (to 1e-9 of the size) become one, the first: for files that name every corner anew.
SurfaceMesh merged(const SurfaceMesh& mesh);
/// Of each vertex the number of the first one at its place.
std::vector<Index> firstAtPlace(const SurfaceMesh& mesh);

std::vector<Vector3> elementNormals(const SurfaceMesh& mesh); ///< unit
std::vector<double> elementAreas(const SurfaceMesh& mesh);    ///< [m^2]; lengths [m] in 2D
/// Of each element an equal share goes to each of its vertices; they add up to the area of the surface.
std::vector<double> vertexAreas(const SurfaceMesh& mesh);
/// By the divergence theorem, negative if the surface faces inward [m^3]; area in 2D [m^2].
double enclosedVolume(const SurfaceMesh& mesh);
} // namespace mpm::coupling

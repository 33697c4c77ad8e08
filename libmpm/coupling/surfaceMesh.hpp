#pragma once
/// A coupling surface as a mesh: segments in 2D, triangles in 3D, in reference coordinates.
#include "base/types.hpp"

#include <array>
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
} // namespace mpm::coupling

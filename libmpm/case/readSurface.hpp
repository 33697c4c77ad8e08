#pragma once
/// The surface of a rigid body from a file, without gmsh:
///
///     .stl    triangles (3D), ASCII or binary
///     .msh    gmsh's mesh format 2.2 or 4.1, ASCII: its segments (2D) or triangles (3D), whichever way they face; from
///             a .geo file by: gmsh -1 blade.geo (2D: curves alone), gmsh -2 blade.geo (3D)
///
/// Errors (InputError, file:line): another ending, an unreadable file, numbers that are none, elements of higher order,
/// no elements; and all that nodal/rigidSurface.hpp refuses. Verified in tests/unit/rigidSurface.cpp.
#include "nodal/rigidSurface.hpp"

#include <filesystem>

namespace mpm::cases
{
/// As the file names them: points that elements share may be there several times, and the surface may be open.
struct SurfaceElements
{
    std::vector<Vector3> points;
    std::vector<nodal::RigidSurface::Element> elements; ///< a segment's third point is 0
};
SurfaceElements readSurfaceElements(const std::filesystem::path& file, int dim, double scale = 1);

/// Coordinates are multiplied by `scale`.
nodal::RigidSurface readSurface(const std::filesystem::path& file, int dim, double scale = 1);
} // namespace mpm::cases

#pragma once
/// A coupling surface from a file, without gmsh: .stl (3D) and .msh (case/readSurface.hpp). Vertices of one place
/// become one, in the order of the file; segments and triangles of a .msh are turned to face like their neighbours, and
/// a closed surface outward. An open surface keeps the side its first element faces to.
///
/// InputError (file, or file:line): what cannot be read, and what coupling/surfaceMesh.hpp refuses. Verified in
/// tests/unit/surfaceMesh.cpp.
#include "coupling/surfaceMesh.hpp"

#include <filesystem>

namespace mpm::coupling
{
/// Coordinates are multiplied by `scale`.
SurfaceMesh readSurfaceMesh(const std::filesystem::path& file, int dim, bool closed, double scale = 1);
} // namespace mpm::coupling

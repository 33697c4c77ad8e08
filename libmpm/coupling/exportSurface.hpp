#pragma once
/// A surface as a file for other programs, by its ending:
///
///     .stl    triangles (3D alone), binary, single precision; without fields
///     .vtp    VTK PolyData, XML: lines in 2D, polygons in 3D, with fields at vertices
///     .msh    gmsh 4.1, ASCII: lines or triangles, one physical group of the surface's name, a curve or surface for
///             each piece that hangs together; without fields
///
/// Coordinates of .vtp and .msh come back bit by bit (coupling/readSurfaceMesh.hpp, case/readSurface.hpp). A file is
/// written under another name and renamed, so that nobody reads half of one. (Formats: StL, M. Burns 1993, Automated
/// Fabrication, section 6.5; VTK File Formats; Gmsh 4.11 reference manual, section 10.1.)
///
/// CouplingError (files): another ending, .stl in 2D, a file that cannot be written; (wrongSize): a field of another
/// number of values. Verified in tests/unit/surfaceMesh.cpp.
#include "coupling/surfaceMesh.hpp"

#include <filesystem>
#include <span>

namespace mpm::coupling
{
struct VertexField
{
    std::string name;
    int components = 1;
    std::vector<double> values; ///< vertex by vertex
};

/// mesh: where the surface is now.
void exportSurface(const std::filesystem::path& file, const std::string& name, const SurfaceMesh& mesh,
                   const std::vector<VertexField>& fields = {});
} // namespace mpm::coupling

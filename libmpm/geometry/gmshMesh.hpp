#pragma once
/// Geometry files through gmsh's C++ API, as plain numbers. Only gmshMesh.cpp uses gmsh.
///
///     .geo           gmsh's own language, both of its kernels; only curves (2D) or surfaces (3D) are meshed
///     .step, .stp    CAD; a labelled solid or face is a region or boundary of its label, else all are one region
///     .stl           a triangle surface; all facets are one region named after the file
///     .msh           gmsh's mesh format 2.2 and 4.1, elements of first order
///
/// Physical groups of the asked dimension are regions, those of one dimension less are boundaries. A file without
/// groups of the asked dimension is one region named after the file. Straight curves come out as one segment between
/// their end points as written in the file, curved ones as chords: the mesh sizes of the file rule them, and at least
/// 180 (in 3D 130) chords make a full circle, 100 (40) any other curve, unless the .geo file sets
/// Mesh.MinimumCirclePoints, Mesh.MinimumCurvePoints or, for curved surfaces, Mesh.MeshSizeFromCurvature itself.
///
/// Lengths are metres. Coordinates of a STEP file are taken as written, whatever its unit (inches as millimetres, which
/// gmsh makes of them), and a note says so; `scale` multiplies all.
/// Errors (InputError, with the file's name): unreadable file or what gmsh says of it, no entity of the asked
/// dimension, a plane geometry that is not in a plane z = constant, elements of higher order.
///
/// gmsh runs in a child process (base/childProcess.hpp), so that its crash, its endless loop or its exit() is a message
/// of ours, and it can neither write files nor start programs. Commands that would are refused by name
/// (gmshScript.hpp).
#include "geometry/simplex.hpp"

#include <filesystem>

namespace mpm::geometry
{
/// A region before it is checked: the closed surfaces of its parts, elements facing either way.
struct RawRegion
{
    std::string name;
    std::vector<std::vector<Simplex>> parts; ///< one a surface (2D) or volume (3D) of the file
    bool connected = false;                  ///< each part is one CAD surface, which may have holes but no islands
};

struct RawBoundary
{
    std::string name;
    std::vector<Simplex> elements;
};

struct GmshMesh
{
    int dim = 2;
    std::filesystem::path file;
    std::vector<Vector3> points;         ///< [m]; z = 0 in 2D
    std::vector<RawRegion> regions;      ///< in the file's order of groups
    std::vector<RawBoundary> boundaries; ///< likewise
    std::vector<std::string> notes;      ///< what a user should know: choices made, gmsh's warnings
};

/// seconds: how long gmsh may take.
GmshMesh readGmsh(const std::filesystem::path& file, int dim, double scale = 1, double seconds = 300);

/// The same in this process, without any of the guards: what the child does.
GmshMesh readGmshHere(const std::filesystem::path& file, int dim, double scale);
} // namespace mpm::geometry

#pragma once
/// The body a case starts from: its checked regions and its named boundaries, facing outward.
///
/// Errors (InputError) name file, region and place: everything gmshMesh.hpp, region2D.hpp and region3D.hpp refuse, a
/// hole outside its surface, parts of a region that overlap, two regions that overlap in 2D (the area is exact; in 3D
/// the seeding sees overlaps).
#include "geometry/gmshMesh.hpp"
#include "geometry/region.hpp"

#include <filesystem>
#include <memory>

namespace mpm::geometry
{
/// A segment (2D: edges[0]) or triangle (3D: both edges from its first corner) of the surface. Its outward normal times
/// area is (e_y, -e_x), in 3D cross(e1, e2)/2.
struct BoundaryElement
{
    Vector3 from{};
    std::array<Vector3, 2> edges{};
};

struct Boundary
{
    std::string name;
    std::vector<BoundaryElement> elements;
    double area() const; ///< length in 2D
};

struct BodyGeometry
{
    int dim = 2;
    std::filesystem::path file;
    std::vector<std::unique_ptr<Region>> regions;
    std::vector<Boundary> boundaries;
    std::vector<std::string> notes;
};

/// Reads and checks a geometry file; coordinates are multiplied by scale. An element of a boundary between two regions
/// faces out of the one named first; a boundary that bounds no region is left out with a note.
/// seconds: how long gmsh may take.
BodyGeometry readGeometry(const std::filesystem::path& file, int dim, double scale = 1, double seconds = 300);

/// The second half of readGeometry: checks what was read. Its points are finite, its indices those of points.
BodyGeometry makeBody(GmshMesh mesh);
} // namespace mpm::geometry

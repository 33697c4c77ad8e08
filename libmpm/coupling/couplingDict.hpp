#pragma once
/// system/couplingDict: the coupling surfaces of a case. Absent: none but those a master adds.
///
///     surfaces
///     {
///         wall
///         {
///             type            Rigid;                  // Rigid | Deformable | Monitor (coupling/field.hpp)
///             geometry        "geometry/wall.stl";    // .stl or .msh (coupling/readSurfaceMesh.hpp); in 2D also
///             points          ((0 0) (1 0) (1 2));    // a polygon, outward or not; of a Monitor a line
///             scale           1;                      // of all coordinates
///             mu              0;                      // Coulomb friction; Rigid and Deformable
///             separation      on;                     // off: it also holds; Rigid and Deformable
///             reference       (0 0 0);                // X of the point poses and torques speak of; default: centroid
///             interpolation   linear;                 // constant | linear | Hermite: of what is written
///         }
///     }
///     preciceCoupling { ... }                         // libmpm/precice reads it
///
/// Errors (file:line): words nobody reads, neither or both of geometry and points, what a surface may not be.
#include "case/caseDirectory.hpp"
#include "coupling/participant.hpp"

namespace mpm::coupling
{
struct NamedSurface
{
    std::string name;
    SurfaceMesh mesh;
    SurfaceKind kind;
    SurfaceOptions options;
    Interpolation interpolation = Interpolation::linear;
};

std::vector<NamedSurface> readCouplingDict(const cases::CaseDirectory& folder, int dim);
} // namespace mpm::coupling

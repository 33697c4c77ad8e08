#pragma once
/// system/couplingDict, its part for preCICE:
///
///     surfaces { wall { type Rigid; geometry "geometry/wall.msh"; } }      // coupling/couplingDict.hpp
///     preciceCoupling
///     {
///         config          "../precice-config.xml"; // from the case folder
///         participant     Soil;                   // our name there; default Soil
///         maxStep         0.001;                  // [s] at most between two exchanges; default: a whole time window
///         samples         1;                      // times a step at which what is read is looked up; 1 is exact for
///                                                 // waveform-degree 0 and 1
///         forces          windowAverage;          // or instantaneous: Force, Torque, Traction that are written
///         surfaces
///         {
///             wall
///             {
///                 mesh    SoilMesh;               // its name in the configuration; the surface's own by default
///                 read    (Displacement Rotation);
///                 write   { Force ForceOfSoil; Torque TorqueOfSoil; }   // where data are called otherwise there
///             }
///         }
///     }
///
///     type          mesh                                 read                           write
///     Rigid         one vertex, the reference point      Displacement, Rotation,        Force, Torque, ContactArea
///                                                        Velocity, AngularVelocity
///     Deformable    the surface                          Displacement, Velocity         Force, Traction, ContactArea
///     Monitor       the surface                          Force, Traction                Displacement, Velocity
///
/// Displacement is from the reference configuration, Rotation a rotation vector [rad] from there. Rotation,
/// AngularVelocity and Torque are scalars in 2D (about z), vectors in 3D; ContactArea is a scalar; the rest are vectors
/// of the mesh's dimension. In 2D, Force is per metre of thickness.
///
/// windowAverage is the impulse of a step over its length: the peer then gets exactly the momentum the soil lost.
///
/// Errors (file:line): no such surface, a quantity its type does not have or not in this direction, one read or
/// written twice, nothing exchanged at all, two surfaces on one mesh, no such configuration file.
#include "coupling/field.hpp"
#include "dictionary/dictionary.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpm::precice
{
/// What preCICE's data of a surface are, by the words above.
enum class Quantity
{
    Displacement,
    Rotation,
    Velocity,
    AngularVelocity,
    Force,
    Torque,
    Traction,
    ContactArea
};

const char* quantityWord(Quantity quantity);
/// Numbers a vertex in a mesh of that many dimensions.
int componentsOf(Quantity quantity, int dim);

struct DataLink
{
    Quantity quantity;
    std::string data; ///< its name in the configuration
    Location where;
};

struct SurfaceLink
{
    std::string surface, mesh;
    coupling::SurfaceKind kind = coupling::SurfaceKind::Rigid;
    std::vector<DataLink> read, write;
    Location where;
};

struct PreciceCoupling
{
    std::filesystem::path config;
    std::string participant;
    std::optional<double> maxStep;
    Index samples = 1;
    bool windowAverage = true;
    std::vector<SurfaceLink> surfaces;
};

/// A surface the participant has.
struct KnownSurface
{
    std::string name;
    coupling::SurfaceKind kind;
};

/// From couplingDict as a whole; throws InputError where it has no preciceCoupling.
PreciceCoupling readPrecice(const dictionary::Dictionary& couplingDict, const std::filesystem::path& caseFolder,
                            const std::vector<KnownSurface>& known);
} // namespace mpm::precice

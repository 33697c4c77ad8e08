#pragma once
/// What a master and a coupling surface exchange. Every field of a surface goes one way:
///
///     surface      who moves it             the master writes             the master reads
///     Rigid        master, six freedoms     RigidPose, RigidTwist         Force, Torque, ContactArea (of the whole);
///                                                                         Traction, Displacement, Velocity (at
///                                                                         vertices)
///     Deformable   master, each vertex      Displacement, Velocity        Force, Traction, ContactArea (at vertices)
///     Monitor      the soil                 Force, Traction (loads it)    Displacement, Velocity, Stress (at vertices)
///
/// Vectors have three components in 2D too (z is 0), stresses six: xx yy zz xy yz zx. RigidPose is the place of the
/// reference point and a unit quaternion, x y z qw qx qy qz; RigidTwist its velocity and the angular velocity, vx vy vz
/// wx wy wz. Force and Torque are those of the soil on the surface where they are read, on the soil where they are
/// written. Tension is positive. In 2D, what is extensive is per metre of thickness.
#include "base/types.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mpm::coupling
{
enum class SurfaceKind
{
    Rigid,
    Deformable,
    Monitor
};

enum class FieldName
{
    Displacement,
    Velocity,
    RigidPose,
    RigidTwist,
    Force,
    Torque,
    Traction,
    Stress,
    ContactArea
};

enum class Direction
{
    written, ///< by the master
    read
};

enum class Support
{
    surface, ///< one value for the whole
    vertex   ///< one a vertex
};

/// Of a written field between the times it was said for (coupling/samples.hpp).
enum class Interpolation
{
    constant,
    linear, ///< default
    Hermite
};

struct Field
{
    FieldName name;
    Direction direction;
    Support support;
    int rank;                        ///< 0 scalar, 1 vector, 2 symmetric tensor; pose and twist count as 1
    int components;                  ///< doubles a value: 1, 3, 6, 7
    std::array<int, 7> dimensions{}; ///< exponents of kg m s K mol A cd; of a pose those of its place
    bool extensive;                  ///< does it add up over a surface? Then it is mapped conservatively.
};

/// "Displacement", ... and back; CouplingError (unknownField) that lists the words there are.
const char* fieldWord(FieldName name);
FieldName fieldName(const std::string& word);
/// "Rigid", ... and back; CouplingError (badSurface).
const char* kindWord(SurfaceKind kind);
SurfaceKind surfaceKind(const std::string& word);
/// "N", "m/s", "Pa".
std::string unitText(const Field& field);

/// The table above: all fields of surfaces of a kind; in 2D Force is N/m.
std::vector<Field> fieldsOf(SurfaceKind kind, int dim);
} // namespace mpm::coupling

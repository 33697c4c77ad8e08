#pragma once
/// What preCICE's numbers of a surface are to the participant, and the other way.
///
///     RigidPose = reference + Displacement, quaternion of the rotation vector: (cos a/2, sin a/2 r/a), a = |r|
///
/// (any textbook of rigid bodies; a = 0 is the identity). In 2D, z is left out of vectors, and a rotation is about z.
/// Verified in tests/unit/preciceCoupling.cpp.
#include "base/types.hpp"
#include "precice/preciceDict.hpp"

#include <array>
#include <map>
#include <vector>

namespace mpm::precice
{
using Values = std::vector<double>;

/// x y z qw qx qy qz of a body displaced by u and turned by the rotation vector r [rad] about its reference point.
std::array<double, 7> poseOf(const Vector3& reference, const Vector3& u, const Vector3& r);

/// A field of the participant and its values.
struct FieldValues
{
    coupling::FieldName field;
    Values values;
};

/// What is to be written to the participant from what was read, by quantity.
std::vector<FieldValues> toParticipant(const SurfaceLink& link, int dim, const Vector3& reference,
                                       const std::map<Quantity, Values>& read);

/// The participant's field a quantity to be written is taken from.
coupling::FieldName sourceOf(Quantity quantity);
/// The values of such a field as preCICE takes them.
Values toPrecice(Quantity quantity, int dim, const Values& field);
} // namespace mpm::precice

#pragma once
/// Rotations as unit quaternions (w x y z), rotation vectors and matrices.
///
///     exponential(phi)   the turn by |phi| about phi
///     logarithm(q)       its inverse, by the shortest arc: |phi| <= pi
///     omega = dexp(phi) phi'   spatial angular velocity of R(t) = exponential(phi(t)) R0:
///                              R' R^T = skew(omega), dexp = I + (1 - cos p)/p^2 phi^ + (p - sin p)/p^3 phi^^2, p =
///                              |phi|
///
/// (A. Iserles, H. Z. Munthe-Kaas, S. P. Norsett & A. Zanna 2000, Acta Numerica 9, 215-365, section 2 and appendix B.)
/// Verified in tests/unit/samples.cpp.
#include "base/types.hpp"

namespace mpm::coupling
{
using Quaternion = std::array<double, 4>; ///< w x y z
using Matrix3 = std::array<double, 9>;    ///< row by row

Quaternion product(const Quaternion& a, const Quaternion& b);
Quaternion conjugate(const Quaternion& q);
/// Of length one; what has no length becomes no rotation.
Quaternion normalised(const Quaternion& q);
Quaternion exponential(const Vector3& phi);
Vector3 logarithm(const Quaternion& q);
Matrix3 matrixOf(const Quaternion& q);
Quaternion quaternionOf(const Matrix3& R);
/// phi' from omega: the inverse of dexp.
Vector3 rateOfVector(const Vector3& phi, const Vector3& omega);
} // namespace mpm::coupling

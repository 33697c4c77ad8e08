#include "coupling/rotation.hpp"

#include "nodal/vectors.hpp"

namespace mpm::coupling
{
using nodal::cross;
using nodal::dot;
using nodal::length;
using nodal::plus;
using nodal::times;

Quaternion product(const Quaternion& a, const Quaternion& b)
{
    return {
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Quaternion conjugate(const Quaternion& q)
{
    return {q[0], -q[1], -q[2], -q[3]};
}

Quaternion normalised(const Quaternion& q)
{
    const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(size > 0))
        return {1, 0, 0, 0};
    return {q[0] / size, q[1] / size, q[2] / size, q[3] / size};
}

Quaternion exponential(const Vector3& phi)
{
    const double angle = length(phi);
    // sin(angle/2)/angle; its series where the quotient is 0/0
    const double s = angle > 1e-8 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48;
    return normalised({std::cos(0.5 * angle), s * phi[0], s * phi[1], s * phi[2]});
}

Vector3 logarithm(const Quaternion& q)
{
    const double sign = q[0] < 0 ? -1 : 1; // q and -q are one rotation
    const Vector3 v = {sign * q[1], sign * q[2], sign * q[3]};
    const double s = length(v), w = sign * q[0];
    return times(s > 1e-8 ? 2 * std::atan2(s, w) / s : 2 / w, v);
}

Matrix3 matrixOf(const Quaternion& q)
{
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
            2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

/// The largest of the four components first, so that nothing small is divided by (S. W. Shepperd 1978, J. Guid. Control
/// 1, 223-224).
Quaternion quaternionOf(const Matrix3& R)
{
    const double trace = R[0] + R[4] + R[8];
    const std::array<double, 4> squares = {trace, R[0], R[4], R[8]};
    std::size_t k = 0;
    for (std::size_t n = 1; n < 4; ++n)
        if (squares[n] > squares[k])
            k = n;
    const double wx = R[7] - R[5], wy = R[2] - R[6], wz = R[3] - R[1];
    const double xy = R[1] + R[3], yz = R[5] + R[7], zx = R[2] + R[6];
    const double most = 1 + 2 * squares[k] - trace; // of x, y, z; w has 1 + trace
    if (k == 0)
        return normalised({1 + trace, wx, wy, wz});
    if (k == 1)
        return normalised({wx, most, xy, zx});
    return k == 2 ? normalised({wy, xy, most, yz}) : normalised({wz, zx, yz, most});
}

Vector3 rateOfVector(const Vector3& phi, const Vector3& omega)
{
    const double p = length(phi), half = 0.5 * p;
    // (1 - half cot(half))/p^2
    const double c = p > 1e-4 ? (1 - half / std::tan(half)) / (p * p) : 1.0 / 12 + p * p / 720;
    return plus(omega, plus(times(-0.5, cross(phi, omega)), times(c, cross(phi, cross(phi, omega)))));
}
} // namespace mpm::coupling

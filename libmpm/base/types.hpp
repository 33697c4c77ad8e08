#pragma once
/// Conventions every room shares.
///
/// SI units; tension positive. Plane strain in 2D: all extensive quantities are per metre of thickness, the
/// out-of-plane strain increment is zero and sigma_zz is carried. Symmetric tensors are stored by components xx, yy,
/// zz, xy (2D) and xx, yy, zz, xy, yz, zx (3D); shear entries are tensor components, never doubled (a strain increment
/// stores D_xy, not gamma_xy). General tensors are stored row by row: F[0] = F_xx, F[1] = F_xy, ..., dim x dim entries
/// (F_zz = 1 in plane strain).
#include <array>
#include <cstdint>

namespace mpm
{
using Index = std::int64_t;
using Vector3 = std::array<double, 3>;

/// Number of stored components of a symmetric tensor: 4 in plane strain, 6 in 3D.
template <int dim>
inline constexpr int stressSize = dim == 2 ? 4 : 6;

inline constexpr int stressComponents(int dim)
{
    return dim == 2 ? 4 : 6;
}

/// Names of the stored components, in storage order.
inline constexpr std::array<const char*, 6> stressNames = {"xx", "yy", "zz", "xy", "yz", "zx"};
inline constexpr std::array<const char*, 3> axisNames = {"x", "y", "z"};

/// Particles are processed in chunks of this many lanes.
inline constexpr int lanes = 64;
} // namespace mpm

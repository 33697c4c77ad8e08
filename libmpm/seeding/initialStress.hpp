#pragma once
/// The stress particles start with, from a material's dictionary:
///
///     initialStress { type none; }                            // default
///     initialStress { type K0; K0 0.72; surfaceLevel 8; }     // K0 [-]: default nu/(1 - nu) of the law;
///                                                             // surfaceLevel [m]: default the region's highest point
///     initialStress { type uniform; value (-1e3 -1e3 -1e3 0 0 0); }   // xx yy zz xy yz zx [Pa]
///
/// K0 (METHOD Eq. 10): a wide layer at rest, sigma_v = -rho |g| d along gravity, both horizontal stresses K0 sigma_v,
/// no shear; d is the depth below surfaceLevel, measured against gravity. rho is the material's own density: with
/// several layers on each other give each its surfaceLevel. Errors (InputError, file:line): K0 without gravity or with
/// gravity off the axes, a seed above surfaceLevel, yz or zx not 0 in 2D, other than six values.
#include "base/types.hpp"
#include "dictionary/dictionary.hpp"

#include <optional>

namespace mpm::seeding
{
/// Gravity along one axis: g = magnitude * sign * e_axis.
struct GravityAxis
{
    int axis = 1;
    double sign = -1;
    double magnitude = 0; ///< [m/s^2]

    /// Height of a point against gravity [m].
    double height(const Vector3& p) const { return -sign * p[std::size_t(axis)]; }
};

/// Nothing if gravity is zero, along no axis, or (2D) out of the plane.
std::optional<GravityAxis> gravityAxis(const Vector3& g, int dim);

struct InitialStress
{
    enum class Type
    {
        none,
        K0,
        uniform
    };
    Type type = Type::none;
    double K0 = 0;
    std::optional<double> surfaceLevel; ///< coordinate along gravity's axis [m]
    GravityAxis gravity;
    std::array<double, 6> value{};

    /// Components xx yy zz xy yz zx [Pa] at p; highest is the region's highest point along gravity's axis (a
    /// coordinate).
    std::array<double, 6> at(const Vector3& p, double density, double highest) const;
    /// Is p above the surface?
    bool above(const Vector3& p, double highest) const;
};

/// Reads `initialStress` of a material; poissonRatio is its law's. A hyperelastic law has no stress where F = I: only
/// `type none` is allowed.
InitialStress readInitialStress(const dictionary::Dictionary& material, double poissonRatio, const Vector3& g, int dim,
                                bool hyperelastic = false);
} // namespace mpm::seeding

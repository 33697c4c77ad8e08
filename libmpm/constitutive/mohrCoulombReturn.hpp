#pragma once
/// The Mohr-Coulomb return of one sorted triple of principal stresses, branch-free, in the form the lane loops inline.
///
/// With D the isotropic stiffness, a = (k, 0, -1), b = (m, 0, -1), r = D b/(a.D b), edges l1 (s1 = s2) and l2 (s2 = s3)
/// with directions r1 = (1, 1, k), r2 = (1, k, k), their potentials g1 = (1, 1, m), g2 = (1, m, m), a point x of the
/// edge and t_i = g_i.D^-1 (s - x)/(g_i.D^-1 r_i), the order of decisions is (Clausen et al. 2006, section 5)
///
///     f <= 0                     elastic
///     t1 > 0 and t2 > 0          apex                     (t from x = apex)
///     (r x r1).(s - x) < 0       l1: x + t1 r1
///     (r x r2).(s - x) > 0       l2: x + t2 r2
///     else                       face: s - f r
///
/// Written so that nothing divides by k - 1 and nothing is lost by cancellation:
/// - x is the edge point with s3 = 0, (sc/k, sc/k, 0) or (sc/k, 0, 0), which exists for k = 1 too; then t_i > 0 seen
///   from the apex is (k - 1) s3 > sc at the returned s3 = k t_i, never true for Tresca.
/// - (r x r1).(s - x) is a positive multiple of s1 - s2 after the face return and (r x r2).(s - x) a negative one of
///   s2 - s3, so both are decided there.
/// - Every returned point takes s1 = (s3 + sc)/k: f is round-off of the returned stress, however large the trial was.
#include "constitutive/elasticTrial.hpp"
#include "constitutive/softening.hpp"

#include <cmath>
#include <limits>

namespace mpm::constitutive
{
/// What a user gives. Angles in degrees, stresses in Pa.
struct MohrCoulombParameters
{
    ElasticModuli moduli;
    double cohesion = 0;
    double frictionAngle = 0;
    double dilationAngle = 0;
    double tensionCutOff =
        std::numeric_limits<double>::infinity();       ///< largest principal stress (mohrCoulombCutOff.hpp)
    std::optional<Softening> softening = std::nullopt; ///< (softening.hpp)
};

/// Throws InputError unless the parameters are finite and in their bounds.
void requireParameters(const MohrCoulombParameters& parameters);

struct Slope
{
    double value, minusOne, root; ///< (1 + sin a)/(1 - sin a), the same minus one, its square root
};

/// Constants of the return, all formed from sums of terms of one sign.
struct MohrCoulombSurface
{
    double k, kMinus1, invK; ///< k, k - 1, 1/k
    double strength;         ///< sc = 2 c sqrt(k) [Pa]
    double onset;            ///< sc/k: s1 where s3 = 0 [Pa]
    double face2, face3;     ///< r2, r3
    double l1Major, l1Minor; ///< s3 on l1 = l1Major (s1 + s2 - 2 onset) + l1Minor s3
    double l2Major, l2Minor; ///< s3 on l2 = l2Major (s1 - onset) + l2Minor (s2 + s3)
    double apex;             ///< c cot phi [Pa]; 0 for phi = 0, where it is never used
    double highest;          ///< largest s3 on the surface: the apex, or infinity for phi = 0 [Pa]
    double dropsVolume;      ///< 1/K at psi = 0, else 0 [1/Pa]

    explicit MohrCoulombSurface(const MohrCoulombParameters& parameters);
    /// From the slopes of friction and dilation; dropsVolume as above.
    MohrCoulombSurface(const ElasticModuli& moduli, double cohesion, const Slope& friction, const Slope& dilation,
                       double dropsVolumeAtApex);
};

inline MohrCoulombSurface::MohrCoulombSurface(const ElasticModuli& moduli, double cohesion, const Slope& friction,
                                              const Slope& dilation, double dropsVolumeAtApex)
{
    const double nu = moduli.poisson, stiff = 1 - 2 * nu, m = dilation.value, mMinus1 = dilation.minusOne;
    k = friction.value;
    kMinus1 = friction.minusOne;
    invK = 1 / k;
    strength = 2 * cohesion * friction.root;
    onset = strength / k;

    // D b/(2G) = b + q (1, 1, 1)
    const double q = nu / stiff * mMinus1;
    const double aDb = k * m + 1 + q * kMinus1;
    face2 = q / aDb;
    face3 = (q - 1) / aDb;

    // E g.D^-1: (h1, h1, h3) on l1, (h2, h4, h4) on l2
    const double h1 = stiff - nu * mMinus1, h3 = stiff + mMinus1;
    const double l1 = (2 + k) * stiff + mMinus1 * (k - 2 * nu);
    l1Major = k * h1 / l1;
    l1Minor = k * h3 / l1;
    const double h2 = stiff - 2 * nu * mMinus1, h4 = stiff + mMinus1 * (1 - nu);
    const double l2 = (1 + 2 * k) * stiff + 2 * mMinus1 * (k * (1 - nu) - nu);
    l2Major = k * h2 / l2;
    l2Minor = k * h4 / l2;

    const bool cone = kMinus1 > 0;
    apex = cone ? strength / (cone ? kMinus1 : 1) : 0;
    highest = cone ? apex : std::numeric_limits<double>::infinity();
    dropsVolume = dropsVolumeAtApex;
}

struct Principal
{
    double s1, s2, s3;
};

struct Returned
{
    Principal s;
    bool plastic, apex, edge1, edge2;
    bool tension = false;
};

/// s1 >= s2 >= s3 in, the returned ones out (equal to the input where not plastic). All selects, no branches.
[[gnu::always_inline]] inline Returned returnToSurface(const MohrCoulombSurface& c, const Principal& s)
{
    const double f = c.k * s.s1 - s.s3 - c.strength;

    const double face3 = s.s3 - f * c.face3;
    const double face2 = s.s2 - f * c.face2;
    const double face1 = (face3 + c.strength) * c.invK;
    const double on1 = c.l1Major * (s.s1 + s.s2 - 2 * c.onset) + c.l1Minor * s.s3;
    const double on2 = c.l2Major * (s.s1 - c.onset) + c.l2Minor * (s.s2 + s.s3);

    const bool plastic = f > 0;
    const bool apex = (c.kMinus1 * on1 > c.strength) & (c.kMinus1 * on2 > c.strength);
    const bool edge1 = face1 < face2;
    const bool edge2 = face2 < face3;

    double s3 = edge2 ? on2 : face3;
    s3 = edge1 ? on1 : s3;
    s3 = s3 < c.highest ? s3 : c.highest;
    const double s1 = (s3 + c.strength) * c.invK;
    double s2 = edge2 ? s3 : face2;
    s2 = edge1 ? s1 : s2;

    Returned out;
    out.s.s1 = plastic ? (apex ? c.apex : s1) : s.s1;
    out.s.s2 = plastic ? (apex ? c.apex : s2) : s.s2;
    out.s.s3 = plastic ? (apex ? c.apex : s3) : s.s3;
    out.plastic = plastic;
    out.apex = plastic & apex;
    out.edge1 = plastic & edge1;
    out.edge2 = plastic & edge2;
    return out;
}

/// f over the larger of the largest principal stress and the strength scale sc; 0 at the vertex of a cohesionless law.
[[gnu::always_inline]] inline double relativeYield(const MohrCoulombSurface& c, double s1, double s3)
{
    const double size1 = std::abs(s1), size3 = std::abs(s3);
    const double size = size1 > size3 ? size1 : size3;
    const double scale = size > c.strength ? size : c.strength;
    const double f = c.k * s1 - s3 - c.strength;
    return scale > 0 ? f / scale : 0;
}
} // namespace mpm::constitutive

#pragma once
/// A limit T of the largest principal stress on top of Mohr-Coulomb's surface (Rankine planes s_i <= T with associated
/// flow), returned exactly and without branches.
///
/// In sorted principal stresses the composite surface has the faces f = 0 and s1 = T and, beyond the edges of
/// mohrCoulombReturn.hpp, the edge of both (s1 = T, s3 = z with z = k T - sc), the edge s1 = s2 = T and the vertices
/// (T, T, z), (T, z, z) and (T, T, T). Every pair of planes has a_i.D b_i a_j.D b_j > a_i.D b_j a_j.D b_i (for both
/// faces the difference is 4 G (lambda + G)), so that of the three candidates exactly one is admissible:
///
///     1. the return to Mohr-Coulomb's surface alone, where it leaves s1 <= T
///     2. the return to the cube s_i <= T alone, where it leaves f <= 0:
///            s1 = T, s2 and s3 less by nu/(1 - nu) (s1 - T);  if then s2 > T: s1 = s2 = T, s3 less by nu (s1 + s2 - 2
///            T); if then s3 > T: (T, T, T)
///     3. both: s1 = T, s3 = z, and as the flow of either keeps the second plastic strain zero, s2 less by
///            nu ((s1 - T) + (s3 - z)), whatever psi is;  held within [z, T]: the vertices
///
/// (de Borst, Crisfield, Remmers & Verhoosel, "Nonlinear Finite Element Analysis of Solids and Structures", 2nd ed.
/// 2012, chapter 7, has returns to Rankine's and Mohr-Coulomb's planes; candidates and their order are derived here.) A
/// limit at or above the apex of a cone never acts and is none. Where it acts the flow rule has a solution for psi = 0
/// too, so no volume is dropped. What tension opens does not close: torn and pushed together in turn, soil grows.
/// Proven against all subsets of the nine planes in tests/unit/tensionCutOff.cpp.
#include "constitutive/mohrCoulombReturn.hpp"

#include <utility>

namespace mpm::constitutive
{
struct CutOffSurface : MohrCoulombSurface
{
    double limit;    ///< T, infinite where it cannot act [Pa]
    double corner;   ///< z = k T - sc [Pa]
    double poisson;  ///< nu
    double sideways; ///< nu/(1 - nu)

    /// From what makes the surface below the limit, in place: a copy of it would keep lanes apart.
    template <class... Surface>
    CutOffSurface(double tensionCutOff, double nu, Surface&&... surface)
        : MohrCoulombSurface(std::forward<Surface>(surface)...),
          limit(tensionCutOff < highest ? tensionCutOff : std::numeric_limits<double>::infinity()),
          corner(k * limit - strength), poisson(nu), sideways(nu / (1 - nu))
    {
        dropsVolume = tensionCutOff < highest ? 0 : dropsVolume;
    }
};

[[gnu::always_inline]] inline Returned returnToSurface(const CutOffSurface& c, const Principal& s)
{
    const Returned shear = returnToSurface(static_cast<const MohrCoulombSurface&>(c), s);
    const bool within = !(shear.s.s1 > c.limit);

    const double over1 = s.s1 - c.limit, side2 = s.s2 - c.sideways * over1, side3 = s.s3 - c.sideways * over1;
    const bool two = side2 > c.limit;
    const double edge3 = s.s3 - c.poisson * (over1 + (s.s2 - c.limit));
    double cube3 = two ? edge3 : side3;
    const double cube2 = two ? c.limit : side2;
    const bool three = cube3 > c.limit;
    cube3 = three ? c.limit : cube3;
    const bool cube = cube3 >= c.corner;

    double both2 = s.s2 - c.poisson * (over1 + (s.s3 - c.corner));
    both2 = both2 > c.corner ? both2 : c.corner;
    both2 = both2 < c.limit ? both2 : c.limit;

    Returned out;
    const double s2 = cube ? cube2 : both2, s3 = cube ? cube3 : c.corner;
    out.s.s1 = within ? shear.s.s1 : c.limit;
    out.s.s2 = within ? shear.s.s2 : s2;
    out.s.s3 = within ? shear.s.s3 : s3;
    const bool vertex = cube & three;
    out.plastic = shear.plastic | !within;
    out.apex = (within & shear.apex) | (!within & vertex);
    out.edge1 = within & shear.edge1;
    out.edge2 = within & shear.edge2;
    out.tension = !within & !vertex;
    return out;
}

/// As without the limit, or s1 - T over the same scale if that is more.
[[gnu::always_inline]] inline double relativeYield(const CutOffSurface& c, double s1, double s3)
{
    const double shear = relativeYield(static_cast<const MohrCoulombSurface&>(c), s1, s3);
    const double size1 = std::abs(s1), size3 = std::abs(s3);
    const double size = size1 > size3 ? size1 : size3;
    const double scale = size > c.strength ? size : c.strength;
    const double over = scale > 0 ? (s1 - c.limit) / scale : 0;
    return over > shear ? over : shear;
}
} // namespace mpm::constitutive

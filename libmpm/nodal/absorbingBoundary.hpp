#pragma once
/// A plane that lets waves out: dashpots of the wave impedances (J. Lysmer & R. L. Kuhlemeyer 1969, J. Eng. Mech. Div.
/// ASCE 95, 859-877), traction on the body
///     t = - a rho c_p (v_n - V_n) n - b rho c_s (v_t - V_t),   c_p = sqrt(M/rho), c_s = sqrt(G/rho)
/// with V = 0, or twice the velocity of a wave that comes in from beyond (the compliant base: L. H. Mejia & E. M.
/// Dawson 2006, 4th FLAC symposium, 04-10). Waves that run along the normal leave wholly for a = b = 1; oblique ones in
/// part.
///
///     side { type absorbing; material soil; normal 1; shear 1; }      // constant/boundaryConditions; a, b 0 to 10
///     base { type absorbing; material rock; incoming { velocity ("0.1*sin(10*t)" 0 0); } }   // a, b: default 1
///
/// A node on the plane stands for the area A of soil beside it, A h/2 of volume: A = 2 m/(rho h), so that
/// dv/dt = acceleration - kappa (v - V) with kappa = 2 a c_p/h or 2 b c_s/h, whatever the mass, solved exactly over the
/// step for the acceleration of all other forces, as nodal/damping.hpp does: no dt is too large. The plane lies on
/// nodes; nodes behind it are treated alike. Dashpots bear no load at rest: what static stress there is pushes the
/// soil out (normal 0 beside a roller on the same plane holds it). They act before walls.
/// Strains do not follow a dashpot as they follow walls (WallEffect::follow): it absorbs best so, and what a = 10 sends
/// back is still right; more is refused, as ever stronger dashpots would gain a few per cent a reflection: take a wall.
/// Booked: absorbedEnergy = - sum J . ((v_i + v*)/2 - V), motionWork = sum J . V, impulse in wallImpulse. a = b = 0 is
/// bitwise no boundary. Verified in tests/unit/absorbingBoundary.cpp and tests/verification/absorbingSide.
#include "nodal/boundaries.hpp"
#include "nodal/nodeRow.hpp"

namespace mpm::nodal
{
template <int dim>
class AbsorbingBoundary
{
  public:
    explicit AbsorbingBoundary(const Absorbing& plane) : plane_(plane) {}

    /// To be called before a step: V.
    void place(double time, double dt);
    /// On the trial velocities of a row, before walls.
    void absorb(NodeRow<dim>& row) const;

  private:
    Absorbing plane_;
    Vector3 drive_{}; ///< V
};

extern template class AbsorbingBoundary<2>;
extern template class AbsorbingBoundary<3>;
} // namespace mpm::nodal

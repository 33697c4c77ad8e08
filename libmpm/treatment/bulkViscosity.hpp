#pragma once
/// Bulk viscosity: a pressure against compression that spreads shocks over a few cells. Without it a front steeper than
/// the grid can carry leaves a train of oscillations behind it.
///     q = rho h (b1 c_p |tr D| + b2^2 h (tr D)^2)   where tr D < 0, else 0;      sigma_p - q I in the forces
/// rho the current density, h the cell size, c_p the P-wave speed at rest, D of the particle's own velocity gradient.
/// The quadratic term (von Neumann & Richtmyer 1950, doi 10.1063/1.1699639) acts on shocks and hardly on anything else;
/// the linear one (Landshoff 1955, LA-1930) on what rings behind them. Both act in compression alone, so expansions
/// stay what they are. Defaults are those customary in explicit finite elements (b1 = 0.06, b2 = 1.2).
///
///     bulkViscosity            // system/mpmSchemes; absent: none
///     {
///         linear     0.06;     // b1 [-], >= 0
///         quadratic  1.2;      // b2 [-], >= 0; both 0: none, bitwise
///     }
///
/// Forces see q, the law does not: stress and strain energy of particles are those of the material. q is kept in the
/// column bulkViscousStress from the strains of one step to the forces of the next. What it takes is booked as
/// bulkViscosityLoss, sum (V q_n + V' q_n+1) |tr e|/2: the work of q on the strains at either end of the step.
///
/// A front of strength dv becomes about h/b2 + ... wide: it needs cells of that size. Smooth flow loses
/// b1 rho h c_p (tr D)^2 per second while it contracts, of first order in h.
///
/// Stability: damping in proportion to stiffness, evaluated a half step late, takes the bound of dt down by
///     sqrt(1 + xi^2) - xi,     xi = b1 + b2^2 h |tr D|/c_p,
/// (T. Belytschko, Nonlinear Finite Elements, Eq. 6.2.14 with xi the share of critical damping of the fastest mode);
/// |tr D| is bounded by |v|/h with |v| the largest particle speed. Verified in tests/unit/bulkViscosity.cpp and
/// tests/verification/barImpact.
#include "base/types.hpp"

#include <cmath>

namespace mpm::treatment
{
struct BulkViscosity
{
    double linear = 0.06;
    double quadratic = 1.2;
    bool any() const { return linear > 0 || quadratic > 0; }
};

/// - q from J = det F, tr D [1/s], and rho_0 h b1 c_p, rho_0 (b2 h)^2.
inline double bulkViscousStress(double linear, double quadratic, double J, double rate)
{
    const double squeeze = rate < 0 ? rate : 0;
    return (linear - quadratic * squeeze) * squeeze / J;
}

/// What is left of the bound of dt at particle speeds up to `speed`.
inline double bulkViscosityStepFactor(const BulkViscosity& b, double speed, double waveSpeed)
{
    const double xi = b.linear + b.quadratic * b.quadratic * speed / waveSpeed;
    return std::sqrt(1 + xi * xi) - xi;
}
} // namespace mpm::treatment

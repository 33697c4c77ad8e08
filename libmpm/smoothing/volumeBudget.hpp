#pragma once
/// Where volume came from, as shares of the initial volume V0 = sum V0_p:
///     change     (sum V - V0)/V0
///     elastic    what stresses explain: a law in rate form has tr D = dp/K (p = tr sigma/3), so ln(V/V0) =
///                (p - p_start)/K, and with e = sum V0_p (exp(p_p/K) - 1)/V0 the share is e - e_start, exact but for a
///                term of the order p_start (p - p_start)/K^2. A hyperelastic law's volume is all elastic.
///     inelastic  change - elastic: dilation by the flow rule and volume that is spurious
///     dropped    the ledger's apexVolume/V0: volume the law's return to the apex made beyond its flow rule. Spurious.
/// Where the flow rule keeps volume (von Mises; Mohr-Coulomb with psi = 0) dropped and inelastic are two measures of
/// the same thing, one booked step by step and one seen in the particles; they differ by what relaxation or smoothing
/// did to stresses without a strain.
/// Verified in tests/unit/stressMeasures.cpp.
#include "constitutive/material.hpp"
#include "state/state.hpp"

namespace mpm::smoothing
{
struct VolumeBudget
{
    double initial = 0; ///< V0 [m^3], m^2 in 2D
    double change = 0, elastic = 0, inelastic = 0, dropped = 0;
};

/// e above: the share of V0 by which elastic volume exceeds that of a body without stress.
double elasticVolume(const state::State& state, const std::vector<constitutive::Material>& materials);

/// `start`: elasticVolume of the state at step 0; not a number if there is none, and what needs it is not one either.
VolumeBudget volumeBudget(const state::State& state, const std::vector<constitutive::Material>& materials,
                          double start);
} // namespace mpm::smoothing

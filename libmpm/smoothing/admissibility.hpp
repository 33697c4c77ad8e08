#pragma once
/// Does every particle's stress obey its law? Stress that was moved after the law's return (smoothed, relaxed,
/// averaged) may lie beyond the yield surface or its apex.
///     yieldViolation    max f/max(|sigma|, strength) by the law's own yield function (Law::reportYield), 0 inside
///     tensionViolation  max (tr sigma/3 - p_apex)/scale, p_apex = c cot phi of Mohr-Coulomb (Law::tensionLimit), 0 if
///                       none is beyond; laws without an apex count as obeying
///     massInTension     share of the mass with tr sigma/3 > 0: allowed up to the apex, but soil carries little of it
/// `scale` [Pa] > 0: ComponentNoise::scale serves, the RMS of the smoothed mean stress.
/// Verified in tests/unit/stressMeasures.cpp.
#include "constitutive/material.hpp"
#include "state/state.hpp"

namespace mpm::smoothing
{
struct Admissibility
{
    double yieldViolation = 0, tensionViolation = 0, massInTension = 0; ///< [-]
};

/// `materials` in the order of State::materials.
Admissibility admissibility(const state::State& state, const std::vector<constitutive::Material>& materials,
                            double scale);
} // namespace mpm::smoothing

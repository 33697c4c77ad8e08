#pragma once
/// Elastic energy of one particle, in 2D per metre: V 1/2 sigma : C^-1 : sigma, or V0 W(F) of a hyperelastic law [J].
/// For reports and rare events; the step sums it over chunks (stepping/lawWork.ipp).
#include "constitutive/law.hpp"
#include "state/particles.hpp"

namespace mpm::constitutive
{
double particleEnergy(const state::Particles& particles, std::size_t i, const Law& law);
} // namespace mpm::constitutive

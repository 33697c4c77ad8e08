#pragma once
/// The domains of stored particles: parallelograms or parallelepipeds around their centres, with edge k = length0[k]
/// times column k of F. Their volumes are the particles'.
#include "geometry/alphaWrap.hpp"
#include "state/particles.hpp"

#include <optional>

namespace mpm::geometry
{
/// Of the particles of one material (index), or of all.
std::vector<ParticleDomain> particleDomains(const state::Particles& particles, std::optional<int> material = {});
} // namespace mpm::geometry

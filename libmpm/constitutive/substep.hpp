#pragma once
/// Sub-steps of a rate law, as many as its error asks for. A return map is exact while the axes of stress keep their
/// direction, and of first order where they turn or the active part of the surface changes (35 % in one step, 0.1 % in
/// 512, tests/support/mohrCoulombOde.csv).
///
///     law     mohrCoulomb;                // also vonMises
///     substep { tolerance 1e-4; }         // of the stress at the end of a step, relative; absent: none, at no cost
///
/// A step has a constant velocity gradient L: strain dt D, rotation dR of angle phi about the axis of W. It is cut in n
/// equal parts, each with the strain dt D/n and the rotation by phi/n. Strain directions stand still in space, so seen
/// by the material they turn: a part must rotate its stress before it adds its strain, and the law, which is handed the
/// stress turned by all of dR, turns it back first (Chunk::L, Chunk::dt). Without L no part turns.
///
/// n is doubled from 1 (the plain step) until two estimates of the stress agree: with s_n of n parts, first order, the
/// extrapolated S_n = 2 s_2n - s_n is of second order; a lane is done when |S_2n - S_n| <= tolerance max(|S|, scale).
/// S_2n is returned to the surface, which costs nothing in order. Lanes that are elastic in the whole step are done at
/// once where phi/2 |C : dt D|, the error of turning before straining, is within the tolerance. Each lane takes its
/// stress from its own last doubling, so results do not depend on what else is in the chunk. n stops at 2048: what is
/// not done by then (an active set that changes at random) keeps the last estimate.
///
/// Plastic work is (start + end)/2 : C^-1 (trial - end) of the whole step, so that the energy budget closes as without
/// sub-steps. apexStrain is summed over the parts of the last doubling.
/// Verified in tests/unit/substep.cpp and, with checkIntegration -law, against CVODE.
#include "constitutive/elasticTrial.hpp"

#include <functional>
#include <optional>

namespace mpm::constitutive
{
struct Substep
{
    double tolerance = 1e-4;
};

/// The dictionary `substep` of a material, if it is there.
std::optional<Substep> readSubstep(const dictionary::Dictionary& material);
/// ", substep tolerance 0.0001", or nothing.
std::string describeSubstep(const std::optional<Substep>& substep);

/// One chunk through `plain`, a law without sub-steps, in as many parts as needed. scale: strength below which stresses
/// count as small [Pa].
template <int dim>
void updateInParts(Chunk<dim>& chunk, const Substep& substep, const ElasticModuli& moduli, double scale,
                   const std::function<void(Chunk<dim>&)>& plain);

extern template void updateInParts<2>(Chunk<2>&, const Substep&, const ElasticModuli&, double,
                                      const std::function<void(Chunk<2>&)>&);
extern template void updateInParts<3>(Chunk<3>&, const Substep&, const ElasticModuli&, double,
                                      const std::function<void(Chunk<3>&)>&);
} // namespace mpm::constitutive

#pragma once
/// Merging, the reverse of splitting: two particles of one material in one cell become one again where what made them
/// two is gone. Only halvings are undone, so particles never get coarser than they were seeded.
///
///     merging                      // mpmSchemes; absent: none
///     {
///         threshold   0.6;         // [-] times the seeding spacing, >= 0; 0: none
///         closeness   0.5;         // [-] of an edge: how far a pair may be from tiling one domain
///         interval    20;          // [steps] between looks
///     }
///
/// Particles p and q (edges F l0_k, l0_k their initial lengths) merge along edge k if
///     - they have the material and all l0 in common, lie in one cell, and l0_k is at most half the seeding spacing,
///       no less halved than any other edge (what was halved last is undone first);
///     - |F l0_k| < threshold times the spacing for both, and no other edge is over twice that;
///     - they lie side by side: F^-1 (x_q - x_p) = l0_k e_k within closeness l0_j along each axis j, F the
///       mean of both, and |F_q - F_p| < closeness |F|.
/// Siblings of one split come first (the column `family` knows them), then pairs by their distance from an exact fit,
/// at most one merge of a particle at each look. So a body that was split and pressed back is again what it was, and
/// twice the threshold must stay under that of splitting, or particles would split and merge in turn.
///
/// Of the merged particle, exactly: m, V and V0 (sums), x and v (means by mass: centre of mass and momentum). Stress is
/// the mean by volume, so sum V sigma stays; laws with convex surfaces admit it. F is the mean by V0, scaled to
/// det F = V/V0. Doubled l0_k, the lower id. Kinetic energy mu |dv|^2/2 of the relative motion (mu the reduced mass)
/// and the elastic energy of the difference of stresses are lost: splitMergeLoss; angular momentum mu dx x dv:
/// splitAngularMomentum; merges are counted.
///
/// The order depends on ids and places alone, not on where particles lie in memory. Verified in tests/unit/merging.cpp.
#include "constitutive/material.hpp"
#include "state/state.hpp"

namespace mpm::splitting
{
struct MergeRule
{
    double threshold = 0.6;
    double closeness = 0.5;
    Index interval = 20;
};

/// Looks at all particles once and returns the number of merges. Those that are left keep their order; the state should
/// be sorted by position before the next step.
Index mergeParticles(state::State& state, const MergeRule& rule, const std::vector<constitutive::Material>& materials);
} // namespace mpm::splitting

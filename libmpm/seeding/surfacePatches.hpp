#pragma once
/// Boundaries of the geometry as surface patches of the state: segments cut into equal pieces, triangles halved across
/// their longest edge, until no edge is longer than the seed spacing. Orientation as in state/state.hpp.
#include "geometry/bodyGeometry.hpp"
#include "state/state.hpp"

namespace mpm::seeding
{
state::SurfacePatch makePatch(const geometry::Boundary& boundary, int dim, double longestEdge);
} // namespace mpm::seeding

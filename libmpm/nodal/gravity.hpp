#pragma once
/// Constant gravity, the body force b = g of METHOD Eqs. 1-3: as sum m_p g N_ip = m_i g, one addition a node.
///
///     dimensions [0 1 -2 0 0 0 0];     // constant/g
///     value      (0 -9.8 0);
///     ramp       { duration 1; shape smooth; }   // [s]; linear t/T or smooth s^2 (3 - 2 s), s = t/T, from zero at
///                                                // t = 0; absent or duration 0: all of it from the start
///
/// A step takes the mean of the ramp over the step, from its closed integral.
/// It is part of the equations of a node (nodal/nodeRow.hpp); its work sum dt m_i g . (v_i + v*)/2 (METHOD, Energy) is
/// booked after the walls, so that it is the work gravity does on the motion that happens. Verified in
/// tests/unit/stepper.cpp (free fall) and by the self-weight column.
#include "nodal/boundaries.hpp"

namespace mpm::nodal
{
/// g of a step of dt from `time` on.
inline Vector3 meanGravity(const Vector3& g, const std::optional<GravityRamp>& ramp, double time, double dt)
{
    if (!ramp)
        return g;
    const double factor = ramp->mean(time, dt);
    return {factor * g[0], factor * g[1], factor * g[2]};
}
} // namespace mpm::nodal

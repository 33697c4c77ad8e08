#pragma once
/// Plane walls normal to an axis, METHOD Walls: at nodes on and behind the wall, outward normal n (out of the soil),
/// u = v_i + dt a_i.
///     fixed     u = 0
///     roller    u.n = 0, tangentially free
///     friction  u_n = 0 and u_t <- u_t max(0, 1 - mu (u.n)/|u_t|) where u.n > 0
/// With separation the wall only pushes (acts where u.n > 0); without, it also holds. Friction walls separate, fixed
/// and roller walls hold, unless the dictionary says otherwise. A wall that holds rubs with its push alone.
///
///     base                         // constant/boundaryConditions: a physical name of the geometry, or any name with
///     {                            // a plane
///         type        friction;    // fixed | roller | friction
///         mu          0.6;         // friction only, >= 0
///         separation  on;
///         plane { normal (0 -1 0); position 0; }   // default: the named boundary's own plane
///     }
///
/// The wall must lie on a plane of nodes (an error names the nearest two). Books impulse and work, split into friction
/// and the rest. Verified in tests/unit/walls.cpp.
#include "nodal/boundaries.hpp"
#include "nodal/nodeRow.hpp"

namespace mpm::nodal
{
template <int dim>
class WallEffect
{
  public:
    explicit WallEffect(const Wall& wall) : wall_(wall) {}

    /// First, for all walls: takes away what moves into the wall (fixed: all velocity) from the lanes `trial`.
    void push(NodeRow<dim>& row) const;
    /// Then, for all walls: friction on what is left, which no longer moves into any wall. So the order of walls in the
    /// dictionary does not matter.
    void rub(NodeRow<dim>& row) const;
    /// For velocities w that strains are taken from, in the lanes `trial`, with v* in the lanes `velocity`: what the
    /// walls have brought to rest in v* rests in w, and nothing moves into the wall. Contact and stick are decided once
    /// a step: if w decided anew, a wall that pushes would let go whenever w points away from it, strains would not
    /// follow v*, and a body that bounces off, or presses on the wall at rest, would gain energy in every swing.
    void follow(NodeRow<dim>& row) const;
    const Wall& wall() const { return wall_; }

  private:
    std::pair<Index, Index> range(const NodeRow<dim>& row) const;
    Wall wall_;
};

extern template class WallEffect<2>;
extern template class WallEffect<3>;
} // namespace mpm::nodal

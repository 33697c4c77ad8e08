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
///
/// A moving wall (dictionary/motion.hpp has all forms of a motion):
///
///     piston { type roller; plane { normal (-1 0 0); position 0.013; } motion { velocity (0.1 0 0); } }
///     base   { type fixed; motion { acceleration { file "constant/quake.csv"; direction (1 0 0); scale 9.81; } } }
///
/// The equations hold for the velocity relative to the wall's, V: the mean of the step, so that the soil goes exactly
/// as far as the wall. V may have any direction; along the wall it shears what sticks or rubs. The plane is where the
/// motion has taken it at the start of the step, between nodes too; nodes behind it and up to half a cell before it are
/// held. So a wall that shakes by less than that holds the same nodes, and one that travels has its place wrong by
/// nothing in the mean, by half a cell at most; each new node is caught with an impact of its own (wallLoss). Where a
/// moving wall meets others, what moves into a wall after friction is pushed again, so that every normal velocity is
/// that of its wall. Work of the wall on the soil: motionWork = sum J . V, positive when supplied; impact and friction
/// are those of the relative velocity. A motion that moves nothing (V = 0) is bitwise no motion. Refused: more than a
/// cell in a step. Verified in tests/unit/movingWalls.cpp and by the scenes shakenLayer and passiveWall of
/// tests/verification.
#include "nodal/boundaries.hpp"
#include "nodal/nodeRow.hpp"
#include "state/gridBox.hpp"

namespace mpm::nodal
{
template <int dim>
class WallEffect
{
  public:
    /// actor: its place in NodeRow::actors; -1: what it does is not booked apart.
    explicit WallEffect(const Wall& wall, int actor = -1) : wall_(wall), actor_(actor), plane_(wall.plane) {}

    /// To be called before a step from `time` on: where the wall is and how fast it goes. StepError if it is too fast.
    void place(double time, double dt, const state::GridBox& grid);

    /// First, for all walls: takes away what moves into the wall (fixed: all velocity) from the lanes `trial`.
    void push(NodeRow<dim>& row) const;
    /// Then, for all walls: friction on what is left, which no longer moves into any wall. So the order of walls in the
    /// dictionary does not matter.
    void rub(NodeRow<dim>& row) const;
    /// Last, for all walls if any moves: friction of one may have slowed what another pushes.
    void pushAgain(NodeRow<dim>& row) const;
    /// For velocities w that strains are taken from, in the lanes `trial`, with v* in the lanes `velocity`: what the
    /// walls have brought to rest in v* rests in w, and nothing moves into the wall. Contact and stick are decided once
    /// a step: if w decided anew, a wall that pushes would let go whenever w points away from it, strains would not
    /// follow v*, and a body that bounces off, or presses on the wall at rest, would gain energy in every swing.
    void follow(NodeRow<dim>& row) const;
    /// Are there nodes of the row on the wall or behind it?
    bool meets(const NodeRow<dim>& row) const
    {
        const auto [begin, end] = range(row);
        return begin != end;
    }
    const Wall& wall() const { return wall_; }
    const Vector3& velocity() const { return velocity_; }

  private:
    /// Nodes of the row on the wall or behind it.
    std::pair<Index, Index> range(const NodeRow<dim>& row) const
    {
        const auto behind = [&](Index index) { return wall_.side < 0 ? index <= plane_ : index >= plane_; };
        if (wall_.axis > 0)
            return behind(wall_.axis == 1 ? row.j : row.k) ? std::pair(row.begin, row.end)
                                                           : std::pair(row.end, row.end);
        if (wall_.side < 0)
            return {row.begin, std::clamp(plane_ + 1, row.begin, row.end)};
        return {std::clamp(plane_, row.begin, row.end), row.end};
    }
    void take(NodeRow<dim>& row, Index i, int axis) const;
    Wall wall_;
    int actor_;
    Index plane_;
    Vector3 velocity_{}; ///< V
};

/// Where a wall is at a time, along its axis [m].
double wallPosition(const Wall& wall, const state::GridBox& grid, double time);
/// Lattice index of the plane of nodes nearest to the soil that it holds then.
Index wallPlane(const Wall& wall, const state::GridBox& grid, double time);

extern template class WallEffect<2>;
extern template class WallEffect<3>;
} // namespace mpm::nodal

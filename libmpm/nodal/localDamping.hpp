#pragma once
/// Local non-viscous damping at nodes (P. A. Cundall, Distinct element models of rock and soil structure, 1987; FLAC
/// manual, Theory and Background, Mechanical Damping): a force against the motion in proportion to the unbalanced one,
/// component by component,
///     F_a = - alpha |f_a| sign(v_a),        f = m (v* - v_i)/dt,
/// f all forces on the node together. It vanishes with f: at equilibrium no stress is altered, and steady motion is not
/// damped. Vibrations of any frequency lose the same share a cycle, about a fraction D = alpha/pi of critical damping;
/// a free fall goes at (1 - alpha) g.
///
///     damping                     // system/mpmSchemes; absent: none
///     {
///         type        local;
///         coefficient 0.7;        // alpha [-], 0 <= alpha < 1; 0: none
///     }
///
/// v_a is the velocity in the middle of the step without damping, w = v_i + dt f/(2 m), and the change is held at 2
/// |w|:
///     u_a <- u_a - sign(w_a) min(alpha |u_a - v_a|, 2 |w_a|)
/// so that the mean of v_i and v* never turns round and the dissipation - J . (v_i + v*)/2 is never negative, whatever
/// the step. Undamped steps keep their own energy, so these lose it: no dt that is stable without becomes unstable.
///
/// It acts after walls and contact, on the components of nodes that no wall touched in this step and on nodes without
/// contact: reactions are no unbalanced force, and friction sees the whole pressure. Forces that damping holds back
/// while a body moves are those of inertia: transients come late (by 1/(1 - alpha)), so this is for loading towards
/// rest (gravityLoading), or with a small alpha.
///
/// Impulse and dissipation are booked. Verified in tests/unit/localDamping.cpp and tests/verification/gravityLoading.
#include "nodal/nodeRow.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::nodal
{
template <int dim>
class LocalDamping
{
  public:
    explicit LocalDamping(double coefficient) : coefficient_(coefficient) {}

    /// After walls and contact. Sums up what it did, and the unbalanced force it found.
    void apply(NodeRow<dim>& row) const
    {
        for (Index i = row.begin; i < row.end; ++i)
            if (row.carries(i))
                for (int a = 0; a < dim; ++a)
                    if (!held(row, i, a))
                        applyTo(row, row.node[i], a);
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
                row.sums->appliedForce += std::abs((*row.projected)[std::size_t(i - row.begin)][row.trial + a]);
    }

  private:
    static bool held(const NodeRow<dim>& row, Index i, int axis)
    {
        if (row.contact && row.contact[i] != Vector3{})
            return true;
        if (row.walls->pushed.empty())
            return false;
        const std::size_t n = std::size_t(i - row.begin);
        return row.walls->other[n][axis] != 0 || row.walls->friction[n][axis] != 0;
    }

    void applyTo(NodeRow<dim>& row, Record& r, int axis) const
    {
        const double before = r[row.velocity + axis], gained = r[row.trial + axis] - before;
        row.sums->unbalancedForce += r[0] * std::abs(gained) / row.dt;
        if (coefficient_ == 0)
            return;
        const double middle = before + 0.5 * gained;
        const double change = -std::copysign(std::min(coefficient_ * std::abs(gained), 2 * std::abs(middle)), middle);
        const double impulse = r[0] * change;
        r[row.trial + axis] += change;
        row.sums->dampingImpulse[std::size_t(axis)] += impulse;
        row.sums->dampingLoss -= 0.5 * impulse * (before + r[row.trial + axis]);
    }

    double coefficient_;
};
} // namespace mpm::nodal

#pragma once
/// Viscous damping proportional to mass, the body force b = - v/tau (the mass term of Rayleigh damping: K.-J. Bathe,
/// Finite Element Procedures, Eq. 9.54 with alpha = 1/tau), tau the relaxation time.
///
///     damping                     // system/mpmSchemes; absent: none
///     {
///         type            viscous;
///         relaxationTime  0.5;    // [s], > 0
///     }
///
/// dv/dt = a - v/tau is solved exactly over the step for the acceleration a = (u - v_i)/dt of all other forces:
///     u <- e v_i + phi (u - v_i),   e = exp(-dt/tau),   phi = (1 - e) tau/dt,
/// so momentum without outer forces decays as exp(-t/tau), a free fall ends at g tau, states of rest stay what they
/// are, and no dt is too large for tau: the step's stability limit does not fall. It comes after all other body effects
/// and before the walls. It acts on nodal velocities: what of the particles' velocities the grid does not see is not
/// damped (picRate does that).
///
/// Impulse J = m (change of u) and dissipation - sum J . (v_i + v*)/2 are booked after the walls. Verified in
/// tests/unit/damping.cpp and tests/stability/dampingOnly.
#include "nodal/nodeRow.hpp"

#include <cmath>

namespace mpm::nodal
{
template <int dim>
class Damping : public NodeEffect<dim>
{
  public:
    explicit Damping(double relaxationTime) : relaxationTime_(relaxationTime) {}

    void apply(NodeRow<dim>& row) const override
    {
        const Factors f(row.dt / relaxationTime_);
        for (Index i = row.begin; i < row.end; ++i)
        {
            Record& r = row.node[i];
            const Record before = Lanes::toTrial(r);
            r = select(Lanes::trial(), r + f.decay * before + f.reduction * (r - before), r);
        }
    }

    /// The change that apply() made follows from v_i and what it left behind, which is v* less what walls did.
    void book(NodeRow<dim>& row) const override
    {
        const Factors f(row.dt / relaxationTime_);
        Record impulse{}, work{};
        for (Index i = row.begin; i < row.end; ++i)
        {
            const Record& r = row.node[i];
            const Record before = Lanes::toTrial(r);
            const Record others = (1 / (1 + f.reduction)) * (r - byWalls(row, i) - (1 + f.decay) * before);
            const Record change = r[0] * (f.decay * before + f.reduction * others);
            impulse += change;
            work += change * (before + r);
        }
        for (int a = 0; a < dim; ++a)
        {
            row.sums->dampingLoss -= 0.5 * work[row.trial + a];
            row.sums->dampingImpulse[a] += impulse[row.trial + a];
        }
    }

  private:
    using Lanes = NodeLanes<dim>;

    struct Factors
    {
        explicit Factors(double s) : decay(std::expm1(-s)), reduction(-std::expm1(-s) / s - 1) {}
        double decay;     ///< e - 1
        double reduction; ///< phi - 1
    };

    /// Change of the trial velocity of a node by walls and contact.
    static Record byWalls(const NodeRow<dim>& row, Index i)
    {
        Record change{};
        if (row.contact && row.carries(i))
            for (int a = 0; a < dim; ++a)
                change[row.trial + a] = row.contact[i][a] / row.node[i][0];
        if (row.walls->pushed.empty() || !row.carries(i))
            return change;
        const std::size_t n = std::size_t(i - row.begin);
        for (int a = 0; a < dim; ++a)
            change[row.trial + a] += (row.walls->other[n][a] + row.walls->friction[n][a]) / row.node[i][0];
        if (!row.walls->absorbed.empty())
            for (int a = 0; a < dim; ++a)
                change[row.trial + a] += row.walls->absorbed[n][std::size_t(a)] / row.node[i][0];
        return change;
    }

    double relaxationTime_;
};
} // namespace mpm::nodal

#pragma once
/// Constant gravity, the body force b = g of METHOD Eqs. 1-3: as sum m_p g N_ip = m_i g, one addition a node.
///
///     dimensions [0 1 -2 0 0 0 0];     // constant/g
///     value      (0 -9.8 0);
///     ramp       { duration 1; shape smooth; }   // [s]; linear t/T or smooth s^2 (3 - 2 s), s = t/T, from zero at
///                                                // t = 0; absent or duration 0: all of it from the start
///
/// A step takes the mean of the ramp over the step, from its closed integral.
/// Work sum dt m_i g . (v_i + v*)/2 (METHOD, Energy) is booked after the walls, so that it is the work gravity does on
/// the motion that happens. Verified in tests/unit/stepper.cpp (free fall) and by the self-weight column.
#include "nodal/boundaries.hpp"
#include "nodal/nodeRow.hpp"

namespace mpm::nodal
{
template <int dim>
class Gravity : public NodeEffect<dim>
{
  public:
    explicit Gravity(const Vector3& g, const std::optional<GravityRamp>& ramp = {}) : g_(g), ramp_(ramp) {}

    void apply(NodeRow<dim>& row) const override
    {
        Record change{};
        const Vector3 g = now(row);
        for (int a = 0; a < dim; ++a)
            change[row.trial + a] = row.dt * g[a];
        for (Index i = row.begin; i < row.end; ++i)
            row.node[i] += row.carries(i) ? change : Record{};
    }

    void book(NodeRow<dim>& row) const override
    {
        double mass = 0;
        Record momentum{};
        for (Index i = row.begin; i < row.end; ++i)
        {
            const double m = row.carries(i) ? row.node[i][0] : 0;
            mass += m;
            momentum += m * row.node[i];
        }
        const Vector3 g = now(row);
        for (int a = 0; a < dim; ++a)
        {
            const double both = momentum[row.velocity + a] + momentum[row.trial + a];
            row.sums->gravityWork += 0.5 * row.dt * g[a] * both;
            row.sums->gravityImpulse[a] += row.dt * g[a] * mass;
        }
    }

  private:
    Vector3 now(const NodeRow<dim>& row) const
    {
        if (!ramp_)
            return g_;
        const double factor = ramp_->mean(row.time, row.dt);
        return {factor * g_[0], factor * g_[1], factor * g_[2]};
    }

    Vector3 g_;
    std::optional<GravityRamp> ramp_;
};
} // namespace mpm::nodal

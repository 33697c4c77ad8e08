#pragma once
/// Constant gravity, the body force b = g of METHOD Eqs. 1-3: as sum m_p g N_ip = m_i g, one addition a node.
///
///     dimensions [0 1 -2 0 0 0 0];     // constant/g
///     value      (0 -9.8 0);
///
/// Work sum dt m_i g . (v_i + v*)/2 (METHOD, Energy) is booked after the walls, so that it is the work gravity does on
/// the motion that happens. Verified in tests/unit/stepper.cpp (free fall) and by the self-weight column.
#include "nodal/nodeRow.hpp"

namespace mpm::nodal
{
template <int dim>
class Gravity : public NodeEffect<dim>
{
  public:
    explicit Gravity(const Vector3& g) : g_(g) {}

    void apply(NodeRow<dim>& row) const override
    {
        Record change{};
        for (int a = 0; a < dim; ++a)
            change[row.trial + a] = row.dt * g_[a];
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
        for (int a = 0; a < dim; ++a)
        {
            const double both = momentum[row.velocity + a] + momentum[row.trial + a];
            row.sums->gravityWork += 0.5 * row.dt * g_[a] * both;
            row.sums->gravityImpulse[a] += row.dt * g_[a] * mass;
        }
    }

  private:
    Vector3 g_;
};
} // namespace mpm::nodal

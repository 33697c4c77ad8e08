// The work of ExplicitStepper on nodes: the equations of motion, walls, and the velocities strains are taken from.
#pragma once
#include "base/clock.hpp"
#include "stepping/explicitStepper.hpp"

#include <tuple>

namespace mpm::stepping
{
template <int dim, class Shape>
template <class Body>
void ExplicitStepper<dim, Shape>::forEachRow(Body&& body)
{
    const Index rows = grid_.common.rows();
#pragma omp parallel
    {
        typename nodal::NodeRow<dim>::WallScratch walls;
        std::vector<Record> projected;
#pragma omp for schedule(static)
        for (Index r = 0; r < rows; ++r)
        {
            nodal::NodeRow<dim> row;
            row.j = grid_.common.lo[1] + r % grid_.common.n[1];
            row.k = grid_.common.lo[2] + r / grid_.common.n[1];
            std::tie(row.begin, row.end) = grid_.touched(row.j, row.k);
            row.node = grid_.common.row(row.j, row.k) - grid_.common.lo[0];
            row.smallestMass = smallestMass_;
            row.sums = &rowSums_[std::size_t(r)];
            walls.clear();
            row.walls = &walls;
            row.projected = &projected;
            body(row);
        }
    }
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::applyWalls(nodal::NodeRow<dim>& row) const
{
    for (const auto& wall : walls_)
        wall.push(row);
    for (const auto& wall : walls_)
        wall.rub(row);
}

/// Sums the slabs, then m a = f with body and boundary effects; books their work. Leaves v* and a at the nodes.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::solveNodes(double dt)
{
    Clock clock(times_.nodal);
    forEachRow([&](nodal::NodeRow<dim>& row) { grid_.sumRow(row.j, row.k); });
    for (std::size_t k = 0; k < tractions_.size(); ++k)
        tractions_[k].scatter(state_.patches[tractionPatch_[k]], state_.grid, grid_.common, smallestMass_);
    forEachRow([&](nodal::NodeRow<dim>& row) {
        row.dt = dt;
        row.projected->assign(row.node + row.begin, row.node + row.end);
        nodal::beginRow(row);
        for (const auto& effect : effects_)
            effect->apply(row);
        applyWalls(row);
        for (const auto& effect : effects_)
            effect->book(row);
        nodal::endRow(row, 1 / dt);
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
                row.sums->forceWork +=
                    dt * (*row.projected)[std::size_t(i - row.begin)][1 + dim + a] * row.node[i][1 + a];
    });
    nodal::NodeSums sums;
    for (const auto& row : rowSums_)
        sums += row;
    auto& ledger = state_.ledger;
    ledger.pendingForceWork = sums.forceWork;
    for (const auto& traction : tractions_)
        ledger.pendingForceWork -= traction.book(grid_.common, dt, ledger.tractionWork, ledger.tractionImpulse);
    ledger.gravityWork += sums.gravityWork;
    ledger.frictionDissipation += sums.frictionLoss;
    ledger.wallLoss += sums.wallLoss;
    ledger.wallContacts += sums.contacts;
    ledger.transferLoss += sums.kineticAfter - sums.kineticBefore;
    for (int a = 0; a < dim; ++a)
    {
        ledger.gravityImpulse[a] += sums.gravityImpulse[a];
        ledger.wallImpulse[a] += sums.wallImpulse[a];
    }
}

/// Velocities w that strains are taken from, walls applied: the projected v_i (USF), or the second projection
/// sum m_p v_p(new) N_ip / m_i (MUSL). They go to lanes 1 + dim; lanes 1.. keep v* in the second case.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::strainVelocities(double dt, bool secondProjection)
{
    Clock clock(times_.nodal);
    forEachRow([&](nodal::NodeRow<dim>& row) {
        if (!secondProjection)
            grid_.sumRow(row.j, row.k);
        else
        {
            for (Index i = row.begin; i < row.end; ++i)
                for (int a = 0; a < dim; ++a)
                    row.node[i][1 + dim + a] = 0;
            for (const auto& s : grid_.slabs)
                if (s.n[0] > 0 && row.j >= s.lo[1] && row.j < s.lo[1] + s.n[1] && row.k >= s.lo[2] &&
                    row.k < s.lo[2] + s.n[2])
                {
                    const Record* in = s.row(row.j, row.k) - s.lo[0];
                    for (Index i = s.lo[0]; i < s.lo[0] + s.n[0]; ++i)
                        for (int a = 0; a < dim; ++a)
                            row.node[i][1 + dim + a] += in[i][1 + a];
                }
        }
        row.dt = dt;
        for (Index i = row.begin; i < row.end; ++i)
        {
            const double inverse = row.carries(i) ? 1 / row.node[i][0] : 0;
            for (int a = 0; a < dim; ++a)
                row.node[i][1 + dim + a] = inverse * row.node[i][(secondProjection ? 1 + dim : 1) + a];
        }
        nodal::NodeSums unbooked;
        row.sums = &unbooked;
        applyWalls(row);
    });
}
} // namespace mpm::stepping

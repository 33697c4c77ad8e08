// The steps of nodal/contact.hpp between those of the nodal equations.
#pragma once
#include "base/clock.hpp"
#include "stepping/explicitStepper.hpp"

namespace mpm::stepping
{
template <int dim, class Shape>
nodal::ParticleReach ExplicitStepper<dim, Shape>::particleReach()
{
    return {Shape::hasDomain, 0.5 * Shape::nodes};
}

/// For tiles just cut. Those that another body reaches do not sleep.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::sizeContact()
{
    contact_->arrange(grid_);
    kept_.projected.resize(contact_->blocks().empty() ? 0 : contact_->impulses().size());
    kept_.byWalls.resize(!bounded() ? 0 : kept_.projected.size());
}

/// Nodes where bodies meet, and what they do to each other's trial velocities.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::meetBodies()
{
    contact_->find(grid_, state_.particles, state_.grid, smallestMass_);
    contact_->push(grid_, kick_);
}

/// What the second half of the nodal equations needs of the first.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::keepRow(const nodal::NodeRow<dim>& row, const state::Block& block)
{
    const std::size_t at = block.start + std::size_t(block.box.offset(row.begin, row.j, row.k));
    std::copy(row.projected->begin(), row.projected->end(), kept_.projected.begin() + std::ptrdiff_t(at));
    if (bounded())
        kept_.byWalls[at] = *row.walls;
}

/// Walls push what contact has pushed into them, and rub for that; then the books of both.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::finishSharedRows()
{
    const auto equations = this->equations(kick_);
    forEachRow(contact_->blocks(), [&](nodal::NodeRow<dim>& row, const state::Block& block) {
        const std::size_t at = block.start + std::size_t(block.box.offset(row.begin, row.j, row.k));
        const auto from = kept_.projected.begin() + std::ptrdiff_t(at);
        row.dt = kick_;
        row.projected->assign(from, from + (row.end - row.begin));
        row.contact = contact_->impulses().data() + at - row.begin;
        if (!prescribed(row.body))
            applyWalls(row);
        if (bounded() && !kept_.byWalls[at].pushed.empty())
            row.walls->add(kept_.byWalls[at]);
        finishRow(row, equations);
    });
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::bookContact(nodal::NodeSums& sums)
{
    const auto done = contact_->book(grid_, kept_.projected, kick_);
    sums.forceWorkBefore -= done.held;
    state_.ledger.contactFriction += done.friction;
    state_.ledger.contactLoss += done.loss;
    state_.ledger.contactNodes += done.nodes;
}

/// The velocities strains are taken from, in blocks that bodies share: contact as the nodal equations decided it, or in
/// USF as a trial step foresees it.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::strainTogether(bool secondProjection)
{
    if (!secondProjection)
    {
        meetBodies();
        forEachRow(contact_->blocks(), [&](nodal::NodeRow<dim>& row, const state::Block&) {
            nodal::swapTrial(row);
            if (prescribed(row.body))
                contact_->followDrive(row);
        });
    }
    contact_->follow(grid_, 0);
    forEachRow(contact_->blocks(), [&](nodal::NodeRow<dim>& row, const state::Block&) {
        if (prescribed(row.body))
            return;
        for (const auto& wall : walls_)
            wall.follow(row);
        for (const auto& body : bodies_)
            body.follow(row);
    });
}
} // namespace mpm::stepping

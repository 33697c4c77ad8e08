// Walls, bodies and absorbing planes in a step of ExplicitStepper: where they are, what they do to nodes, what they
// met.
#pragma once
#include "stepping/explicitStepper.hpp"

namespace mpm::stepping
{
/// Where moving walls and bodies are in the coming step, and how fast.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::placeActors(double dt)
{
    for (auto& wall : walls_)
        if (wall.wall().motion)
            wall.place(state_.time, dt, state_.grid);
    for (auto& body : bodies_)
        body.place(state_.time, dt, state_.grid);
    for (auto& plane : absorbing_)
        plane.place(state_.time, dt);
    actorSums_.assign(grid_.blocks().size() * std::size_t(actors_), {});
    heldRows_.resize(bodies_.empty() ? 0 : grid_.blocks().size());
    for (auto& rows : heldRows_)
        rows.clear();
}

/// What each of them met, summed over blocks in their order.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::reportActors(double dt)
{
    report_.actors.assign(std::size_t(actors_), {});
    std::vector<nodal::ActorSums> sums(std::size_t(actors_), nodal::ActorSums{});
    for (std::size_t n = 0; n < actorSums_.size(); ++n)
        sums[n % std::size_t(actors_)] += actorSums_[n];
    const auto finish = [&](ActorReport& report, const nodal::ActorSums& sum) {
        for (std::size_t a = 0; a < 3; ++a)
        {
            report.force[a] = -sum.impulse[a] / kick_;
            report.torque[a] = -sum.moment[a] / kick_;
        }
        report.contacts = sum.contacts;
    };
    std::size_t n = 0;
    for (const auto& wall : walls_)
        if (wall.wall().motion)
        {
            auto& report = report_.actors[n];
            report.name = wall.wall().name;
            report.position = wall.wall().motion->displacement(state_.time + dt);
            report.velocity = wall.velocity();
            finish(report, sums[n++]);
        }
    for (auto& contact : bodies_)
    {
        auto& report = report_.actors[n];
        auto& body = contact.body();
        report.name = contact.name();
        report.position = contact.positionAt(state_.time + dt);
        if (const auto* rigid = contact.rigid())
        {
            report.velocity = rigid->twist().velocity;
            report.angularVelocity = rigid->twist().angularVelocity;
        }
        state_.ledger.bodyContacts += sums[n].contacts;
        body.impulses = std::move(sums[n].impulses);
        finish(report, sums[n++]);
        body.force = report.force;
        body.torque = report.torque;
    }
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::applyWalls(nodal::NodeRow<dim>& row) const
{
    for (const auto& wall : walls_)
        wall.push(row);
    for (const auto& body : bodies_)
        body.push(row);
    for (const auto& wall : walls_)
        wall.rub(row);
    for (const auto& body : bodies_)
        body.rub(row);
    if (wallsMove_ || !bodies_.empty())
        for (const auto& wall : walls_)
            wall.pushAgain(row);
}

template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::driven() const
{
    return wallsMove_ || !bodies_.empty() || !absorbing_.empty() || scene_.gravityRamp.has_value();
}
} // namespace mpm::stepping

// The work of ExplicitStepper on nodes: the equations of motion, walls, and the velocities strains are taken from.
#pragma once
#include "base/clock.hpp"
#include "nodal/gravity.hpp"
#include "stepping/explicitStepper.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace mpm::stepping
{
/// Calls body(row, block) for all rows of the blocks; sums go to the block's place.
template <int dim, class Shape>
template <class Body>
void ExplicitStepper<dim, Shape>::forEachRow(const std::vector<Index>& blocks, Body&& body, bool inPart)
{
    const int count = int(blocks.size());
    blockSums_.assign(grid_.blocks().size(), {});
#pragma omp parallel
    {
        typename nodal::NodeRow<dim>::WallScratch walls;
        std::vector<Record> projected;
#pragma omp for schedule(dynamic, 1)
        for (int n = 0; n < count; ++n)
        {
            const auto b = std::size_t(blocks[std::size_t(n)]);
            const state::Block& block = grid_.blocks()[b];
            const auto& box = inPart ? parts_[b] : block.box;
            nodal::NodeRow<dim> row;
            row.time = state_.time;
            row.smallestMass = smallestMass_;
            row.sums = &blockSums_[b];
            row.walls = &walls;
            row.actors = actors_ > 0 && !actorSums_.empty() ? &actorSums_[b * std::size_t(actors_)] : nullptr;
            row.held = heldRows_.empty() ? nullptr : &heldRows_[b];
            row.projected = &projected;
            row.body = block.body;
            row.begin = box.lo[0];
            row.end = box.lo[0] + box.n[0];
            for (row.k = box.lo[2]; row.k < box.lo[2] + box.n[2]; ++row.k)
                for (row.j = box.lo[1]; row.j < box.lo[1] + box.n[1]; ++row.j)
                {
                    row.node = grid_.nodes(block) + block.box.offset(row.begin, row.j, row.k) - row.begin;
                    walls.clear();
                    body(row, block);
                }
        }
    }
}

/// sum[i - row.begin] += the records of node i in the windows of all tiles, in the order of the tiles.
template <int dim, class Shape>
template <class Node>
void ExplicitStepper<dim, Shape>::sumWindows(const nodal::NodeRow<dim>& row, const state::Block& block, Node* sum)
{
    grid_.template forEachWindow<Node>(block, row.j, row.k, [&](Index begin, Index end, const Node* in) {
        const Index first = std::max(begin, row.begin), last = std::min(end, row.end);
        Node* out = sum - row.begin;
        for (Index i = first; i < last; ++i)
            out[i] += in[i - begin];
    });
}

template <int dim, class Shape>
template <class Body>
void ExplicitStepper<dim, Shape>::forEachRow(Body&& body)
{
    forEachRow(reached_, body, !parts_.empty());
}

/// The row's nodes: (m, p, f) summed over the windows of tiles.
template <int dim, class Shape>
template <class What>
void ExplicitStepper<dim, Shape>::sumNodes(nodal::NodeRow<dim>& row, const state::Block& block)
{
    using Node = typename What::Node;
    Node sum[1 << state::TileLayout::bitsOf(dim)] = {};
    sumWindows(row, block, sum);
    for (Index i = row.begin; i < row.end; ++i)
        row.node[i] = transfer::finishNode<dim>(sum[i - row.begin]);
}

/// (m, p, f) summed over windows, then solved at once.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::solveFreeRow(nodal::NodeRow<dim>& row, const state::Block& block,
                                               const Equations& equations)
{
    Record sum[1 << state::TileLayout::bitsOf(dim)] = {};
    sumWindows(row, block, sum);
    nodal::solveFreeRow(row, equations, [&](Index i) { return transfer::finishNode<dim>(sum[i - row.begin]); });
}

/// Those of a step of dt at nodes that are free to move.
template <int dim, class Shape>
typename ExplicitStepper<dim, Shape>::Equations ExplicitStepper<dim, Shape>::equations(double dt) const
{
    Vector3 g{};
    if (scene_.gravity)
        g = nodal::meanGravity(*scene_.gravity, scene_.gravityRamp, state_.time, dt);
    return {dt, smallestMass_, g};
}

/// (m, p, f) -> (v_i, u) by forces, body effects and walls.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::solveRow(nodal::NodeRow<dim>& row, const Equations& equations)
{
    nodal::beginRow(row, equations);
    if (prescribed(row.body))
        return contact_->drive(row, state_.grid);
    for (const auto& effect : effects_)
        effect->apply(row);
    if (bounded_)
    {
        for (const auto& plane : absorbing_)
            plane.absorb(row);
        applyWalls(row);
    }
}

/// (v_i, u) -> (v*, a); books what was done.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::finishRow(nodal::NodeRow<dim>& row, const Equations& equations)
{
    if (prescribed(row.body))
    {
        contact_->bookDrive(row);
        return nodal::endRow<dim>(row, {kick_, smallestMass_, {}}); // no work of gravity
    }
    if (scene_.localDamping)
        localDamping_->apply(row);
    for (const auto& effect : effects_)
        effect->book(row);
    nodal::endRow(row, equations);
}

/// m a = f with body and boundary effects; books their work. Leaves v* and a at the nodes. Nodes of blocks that bodies
/// share wait between the two halves for what contact decides.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::solveNodes()
{
    Clock clock(times_.nodal);
    for (auto& rows : heldRows_) // USF has foreseen contact, which now is decided
        rows.clear();
    work_.ofForcesBefore = work_.ofForces = 0;
    report_.lightestNode = std::numeric_limits<double>::infinity();
    report_.unbalancedForce = report_.appliedForce = report_.nodalKineticEnergy = 0;
    const bool look = rests() && state_.step % scene_.sortInterval == 0;
    if (report_.resting == 0)
    {
        solveNodes(reached_);
        if (look)
            lookForRest();
        return;
    }
    std::vector<Index> blocks = reached_;
    inPart_ = !parts_.empty() && !look && !disturbsEverywhere();
    if (!inPart_ && (look || disturbsEverywhere()))
    {
        blocks.resize(grid_.blocks().size());
        std::iota(blocks.begin(), blocks.end(), Index(0));
    }
    std::vector<char> solved(grid_.blocks().size());
    std::vector<Index> all;
    for (; !blocks.empty(); blocks = wake(solved))
    {
        solveNodes(blocks);
        for (const Index b : blocks)
            solved[std::size_t(b)] = 1;
        all.insert(all.end(), blocks.begin(), blocks.end());
    }
    if (look)
        lookForRest();
    holdResting(all);
    inPart_ = false;
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::solveNodes(const std::vector<Index>& blocks)
{
    bool loaded = !tractions_.empty();
    for (const auto& surface : carriers_)
        loaded = loaded || surface.loads();
    if (loaded)
    {
        forEachRow(
            blocks, [&](auto& row, const auto& block) { sumNodes<transfer::Forces>(row, block); }, inPart_);
        for (std::size_t k = 0; k < tractions_.size(); ++k)
            tractions_[k].scatter(state_.patches[tractionPatch_[k]], state_.grid, grid_, smallestMass_);
        for (auto& surface : carriers_)
            surface.scatter(state_.grid, grid_, smallestMass_);
    }
    const bool plain =
        !loaded && effects_.empty() && bodies_.empty() && absorbing_.empty() && !scene_.localDamping.has_value();
    const auto feelsWall = [&](const auto& row) {
        return std::any_of(walls_.begin(), walls_.end(), [&](const auto& wall) { return wall.meets(row); });
    };
    const auto equations = this->equations(kick_);
    forEachRow(
        blocks,
        [&](nodal::NodeRow<dim>& row, const state::Block& block) {
            row.dt = kick_;
            if (plain && !shared(block) && !prescribed(row.body) && !feelsWall(row))
                return solveFreeRow(row, block, equations);
            if (!loaded)
                sumNodes<transfer::Forces>(row, block);
            solveRow(row, equations);
            if (shared(block))
                keepRow(row, block);
            else
                finishRow(row, equations);
        },
        inPart_);
    nodal::NodeSums sums;
    for (const auto& block : blockSums_)
        sums += block;
    if (std::any_of(blocks.begin(), blocks.end(), [&](Index b) { return shared(grid_.blocks()[std::size_t(b)]); }))
    {
        meetBodies();
        finishSharedRows();
        for (const auto& block : blockSums_)
            sums += block;
        bookContact(sums);
    }
    sums.gather<dim>();
    auto& ledger = state_.ledger;
    work_.ofForcesBefore -= sums.forceWorkBefore;
    work_.ofForces -= sums.forceWork;
    const auto bookLoad = [&](const auto& load) {
        const auto [before, after] = load.book(kick_, ledger.tractionWork, ledger.tractionImpulse);
        work_.ofForcesBefore += before;
        work_.ofForces += after;
    };
    for (const auto& traction : tractions_)
        bookLoad(traction);
    for (const auto& surface : carriers_)
        bookLoad(surface);
    report_.lightestNode = std::min(report_.lightestNode, sums.lightest);
    report_.unbalancedForce += sums.unbalancedForce;
    report_.appliedForce += sums.appliedForce;
    report_.nodalKineticEnergy += sums.kineticBefore;
    ledger.gravityWork += sums.gravityWork;
    ledger.frictionDissipation += sums.frictionLoss;
    ledger.wallLoss += sums.wallLoss;
    ledger.motionWork += sums.motionWork;
    ledger.motionSupply += std::max(0.0, sums.motionWork);
    ledger.dampingDissipation += sums.dampingLoss;
    ledger.absorbedEnergy += sums.absorbed;
    ledger.wallContacts += sums.contacts;
    ledger.transferLoss += sums.kineticAfter - sums.kineticBefore;
    for (int a = 0; a < dim; ++a)
    {
        ledger.gravityImpulse[a] += sums.gravityImpulse[a];
        ledger.wallImpulse[a] += sums.wallImpulse[a];
        ledger.dampingImpulse[a] += sums.dampingImpulse[a];
    }
}

/// Velocities w that strains are taken from: the projected v_i (USF), or the second projection sum m_p v_p(new) N_ip /
/// m_i (MUSL), held where walls hold v*. They go to lanes 1 + dim; lanes 1.. keep v*, in USF that of the stress at
/// hand.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::strainVelocities(double dt, bool secondProjection)
{
    Clock clock(times_.nodal);
    if (secondProjection && !touches() && !contact_)
        return forEachRow([&](nodal::NodeRow<dim>& row, const state::Block& block) { projectAgainToRow(row, block); });
    const auto equations = this->equations(dt);
    forEachRow([&](nodal::NodeRow<dim>& row, const state::Block& block) {
        row.dt = dt;
        if (secondProjection)
            projectAgainToRow(row, block);
        else if (!touches() && !contact_ && !rests())
        {
            sumNodes<transfer::Momentum>(row, block);
            for (Index i = row.begin; i < row.end; ++i)
                nodal::setStrainVelocity(row, i, shuffle<0, 1, 2, 3>(row.node[i], row.node[i]));
        }
        else
        {
            foreseeContact(row, block, equations);
            if (!shared(block))
                nodal::swapTrial(row);
        }
        if (prescribed(block.body) && (secondProjection || !shared(block)))
            contact_->followDrive(row);
        if (shared(block) || prescribed(block.body))
            return;
        for (const auto& wall : walls_)
            wall.follow(row);
        for (const auto& body : bodies_)
            body.follow(row);
    });
    if (contact_)
        strainTogether(secondProjection);
}

/// w of a row of nodes from the second projection.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::projectAgainToRow(const nodal::NodeRow<dim>& row, const state::Block& block)
{
    HalfRecord sum[1 << state::TileLayout::bitsOf(dim)] = {};
    sumWindows(row, block, sum);
    for (Index i = row.begin; i < row.end; ++i)
        nodal::setStrainVelocity(row, i, sum[i - row.begin]);
}

/// USF takes strains before it knows the forces: contact is that of a trial step with the stress at hand.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::foreseeContact(nodal::NodeRow<dim>& row, const state::Block& block,
                                                 const Equations& equations)
{
    sumNodes<transfer::Forces>(row, block);
    nodal::NodeSums unbooked;
    auto* const booked = row.sums;
    row.sums = &unbooked;
    row.actors = nullptr;
    solveRow(row, equations);
    row.sums = booked;
}
} // namespace mpm::stepping

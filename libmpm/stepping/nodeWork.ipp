// The work of ExplicitStepper on nodes: the equations of motion, walls, and the velocities strains are taken from.
#pragma once
#include "base/clock.hpp"
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

/// Do the row's nodes feel nothing but forces and gravity?
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::free(const nodal::NodeRow<dim>& row, const state::Block& block) const
{
    if (!effects_.empty() || !bodies_.empty() || !absorbing_.empty() || scene_.localDamping || shared(block) ||
        prescribed(row.body))
        return false;
    for (const auto& wall : walls_)
        if (wall.meets(row))
            return false;
    return true;
}

/// Those of a step of dt at nodes that are free to move.
template <int dim, class Shape>
nodal::NodeEquations<dim> ExplicitStepper<dim, Shape>::equations(double dt) const
{
    Vector3 g{};
    if (scene_.gravity)
        g = nodal::meanGravity(*scene_.gravity, scene_.gravityRamp, state_.time, dt);
    return {dt, smallestMass_, g};
}

/// (m, p, f) -> (v_i, u) by forces, body effects and walls.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::solveRow(nodal::NodeRow<dim>& row, const nodal::NodeEquations<dim>& equations)
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
void ExplicitStepper<dim, Shape>::finishRow(nodal::NodeRow<dim>& row, const nodal::NodeEquations<dim>& equations)
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
    const auto equations = this->equations(kick_);
    forEachRow(
        blocks,
        [&](nodal::NodeRow<dim>& row, const state::Block& block) {
            if (!loaded)
                sumNodes<transfer::Forces>(row, block);
            row.dt = kick_;
            if (free(row, block))
                return nodal::solveFreeRow(row, equations);
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
                setStrainVelocity(row, i, shuffle<0, 1, 2, 3>(row.node[i], row.node[i]));
        }
        else
        {
            foreseeContact(row, block, equations);
            if (!shared(block))
                swapTrial(row);
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
        setStrainVelocity(row, i, sum[i - row.begin]);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::setStrainVelocity(const nodal::NodeRow<dim>& row, Index i, const HalfRecord& momentum)
{
    Record& r = row.node[i];
    const double inverse = row.carries(i) ? 1 / r[0] : 0;
    const HalfRecord w = inverse * momentum;
    r = select(nodal::NodeLanes<dim>::trial(), nodal::NodeLanes<dim>::toTrial(join(w, w)), r);
}

/// USF takes strains before it knows the forces: contact is that of a trial step with the stress at hand.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::foreseeContact(nodal::NodeRow<dim>& row, const state::Block& block,
                                                 const nodal::NodeEquations<dim>& equations)
{
    sumNodes<transfer::Forces>(row, block);
    nodal::NodeSums unbooked;
    auto* const booked = row.sums;
    row.sums = &unbooked;
    row.actors = nullptr;
    solveRow(row, equations);
    row.sums = booked;
}

/// (v_i, u) -> (u, v_i), the lanes as a second projection leaves them.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::swapTrial(nodal::NodeRow<dim>& row) const
{
    for (Index i = row.begin; i < row.end; ++i)
        for (int a = 0; a < dim; ++a)
        {
            const double velocity = row.node[i][row.velocity + a]; // no std::swap: clang has no references to lanes
            row.node[i][row.velocity + a] = row.node[i][row.trial + a];
            row.node[i][row.trial + a] = velocity;
        }
}
} // namespace mpm::stepping

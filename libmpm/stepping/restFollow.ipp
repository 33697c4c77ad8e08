// Sleeping soil that follows slowly (rest.hpp): one long step of all that sleeps at every look.
#pragma once
#include "base/clock.hpp"
#include "stepping/explicitStepper.hpp"

#include <cmath>
#include <omp.h>

namespace mpm::stepping
{
inline void rouse(state::Particles& particles, const state::Tile& tile)
{
    std::fill_n(particles.quietLooks.begin() + tile.first, tile.count, 0.0);
}

inline std::vector<Index> sleepingTiles(const state::TileGrid& grid)
{
    std::vector<Index> sleeping;
    for (std::size_t t = 0; t < grid.tiles().size(); ++t)
        if (grid.tiles()[t].resting)
            sleeping.push_back(Index(t));
    return sleeping;
}

/// Of nodes that some tiles reach.
inline std::vector<Index> blocksOf(const state::TileGrid& grid, const std::vector<Index>& tiles)
{
    std::vector<char> reached(grid.blocks().size());
    for (const Index t : tiles)
        for (const auto& overlap : grid.tiles()[std::size_t(t)].blocks)
            reached[std::size_t(overlap.block)] = 1;
    std::vector<Index> blocks;
    for (std::size_t b = 0; b < reached.size(); ++b)
        if (reached[b])
            blocks.push_back(Index(b));
    return blocks;
}

/// Before a step: at a look all that sleeps does what it was to do since the last; then it is sorted with the rest.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::catchUp()
{
    if (state_.step == 0 || state_.step % scene_.sortInterval != 0)
        return;
    if (!arranged_)
        buildTiles();
    const auto sleepers = sleepingTiles(grid_);
    if (sleepers.empty())
        return;
    if (!projected_ || stray_)
        projectAgain(firstProjection());
    followMotion(sleepers, double(scene_.sortInterval) * state_.deltaT, false);
    for (const Index t : waking_)
        rouse(state_.particles, grid_.tiles()[std::size_t(t)]);
    waking_.clear();
}

/// In a step whose particles are projected: at a look the forces of this moment set what sleeps in motion; at other
/// steps tiles that the last step disturbed wake where they ought to be by now.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::keepUp(double dt)
{
    const Index since = state_.step % scene_.sortInterval;
    if (since == 0)
        return kickSleepers(dt);
    if (waking_.empty())
        return;
    const bool stray = followMotion(waking_, double(since) * state_.deltaT, true);
    for (const Index t : waking_)
    {
        grid_.setResting(t, false);
        rouse(state_.particles, grid_.tiles()[std::size_t(t)]);
        const auto& tile = grid_.tiles()[std::size_t(t)];
        restingEnergy_ -= energyOf(tile);
    }
    waking_.clear();
    choosePlaces();
    motionKnown_.assign(grid_.blocks().size(), 0);
    resting_ = motionOfSleepers();
    if (!stray)
        return;
    sortAnew(false);
    projectAgain(firstProjection());
    projected_ = false;
    if (stray_)
        failOutside();
}

template <int dim, class Shape>
MotionOfSleepers ExplicitStepper<dim, Shape>::motionOfSleepers() const
{
    const auto& p = state_.particles;
    MotionOfSleepers m;
    for (const auto& tile : grid_.tiles())
        for (Index i = tile.first; tile.resting && i < tile.first + tile.count; ++i)
            for (int a = 0; a < dim; ++a)
            {
                const double v = p.v[a][std::size_t(i)], momentum = p.mass[std::size_t(i)] * v;
                m.kinetic += 0.5 * momentum * v;
                m.momentum[a] += momentum;
            }
    return m;
}

/// A pass over some tiles on its own; its sums, in the order of the tiles.
template <int dim, class Shape>
std::vector<TileSums> ExplicitStepper<dim, Shape>::passOverSleepers(const std::vector<Index>& which, double dt,
                                                                    const Pass& pass)

{
    Clock clock(particleSeconds_);
    std::vector<TileSums> sums(which.size());
    const int count = int(which.size());
#pragma omp parallel
    {
        auto& ws = workspaces_[std::size_t(omp_get_thread_num())];
        if (!ws)
            ws = std::make_unique<Workspace>();
        ws->timed = false;
#pragma omp for schedule(dynamic, 1)
        for (int n = 0; n < count; ++n)
        {
            ws->sums = {};
            passOverTile(*ws, grid_.tiles()[std::size_t(which[std::size_t(n)])], dt, pass);
            sums[std::size_t(n)] = ws->sums;
        }
    }
    return sums;
}

/// Forces of this moment over the inertia K^2 m and K dt: the velocities up to the next look.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::kickSleepers(double dt)
{
    const auto sleepers = sleepingTiles(grid_);
    if (sleepers.empty())
        return;
    const double longer = double(scene_.sortInterval);
    kick_ = dt / longer;
    const auto equations = this->equations(kick_);
    forEachRow(blocksOf(grid_, sleepers), [&](nodal::NodeRow<dim>& row, const state::Block& block) {
        sumNodes<transfer::Forces>(row, block);
        nodal::NodeSums unbooked;
        row.sums = &unbooked;
        row.actors = nullptr;
        row.dt = kick_;
        solveRow(row, equations);
        finishRow(row, equations);
    });
    for (auto& rows : heldRows_)
        rows.clear();
    Pass pass = completed({.velocity = true, .then = Project::forces});
    pass.alpha = scene_.picRate > 0 ? -std::expm1(-scene_.picRate * longer * dt) : 0;
    const MotionOfSleepers before = resting_;
    passOverSleepers(sleepers, 0, pass);
    const MotionOfSleepers after = motionOfSleepers();
    state_.ledger.restLoss -= after.kinetic - before.kinetic;
    state_.ledger.kineticEnergy += after.kinetic - before.kinetic;
    for (int a = 0; a < dim; ++a)
        state_.ledger.restImpulse[a] += after.momentum[a] - before.momentum[a];
    resting_ = after;
    motionKnown_.assign(grid_.blocks().size(), 0);
}

/// Moves and strains tiles that sleep over a time T by the velocity field they have had. Is any particle a stray then?
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::followMotion(const std::vector<Index>& which, double T, bool projects)
{
    auto& p = state_.particles;
    kick_ = 0;
    forEachRow(blocksOf(grid_, which), [&](nodal::NodeRow<dim>& row, const state::Block& block) {
        const Record* motion = restingMotion(row, block);
        for (Index i = row.begin; i < row.end; ++i)
        {
            Record& r = row.node[i];
            r = Record{motion[i][0], 0.0};
            for (int a = 0; a < dim; ++a)
                r[1 + a] = motion[i][1 + dim + a];
        }
    });
    Pass pass = completed({.velocity = true,
                           .strain = true,
                           .gradientLane = 1,
                           .moves = true,
                           .then = projects ? Project::forces : Project::nothing});
    pass.alpha = 0;
    pass.blends = pass.byStrainVelocity = false;
    auto& ledger = state_.ledger;
    bool stray = false;
    for (const TileSums& s : passOverSleepers(which, T, pass))
    {
        if (s.badParticle >= 0)
            fail(s.badParticle, "is turned inside out or no longer finite (det F <= 0) as it follows in its sleep");
        const double work = 0.5 * (s.strainWorkBefore + s.strainWork);
        ledger.plasticDissipation += s.plasticWork;
        ledger.finiteStrainWork += s.finiteStrainWork;
        ledger.restLoss -= work;
        restingEnergy_ += work - s.plasticWork + s.finiteStrainWork;
        ledger.apexVolume += s.apexVolume;
        ledger.apexReturns += s.apexReturns;
        stray = stray || s.stray;
    }
    double fall = 0, drag = 0;
    for (const Index t : which)
    {
        const auto& tile = grid_.tiles()[std::size_t(t)];
        for (Index i = tile.first; i < tile.first + tile.count; ++i)
            for (int a = 0; a < dim; ++a)
            {
                auto& x = p.x[a][std::size_t(i)];
                const auto next = next_[a][std::size_t(i)];
                if (scene_.gravity)
                    fall += p.mass[std::size_t(i)] * (*scene_.gravity)[std::size_t(a)] * (next - x);
                if (scene_.relaxationTime)
                {
                    const double v = p.v[a][std::size_t(i)];
                    drag += p.mass[std::size_t(i)] * v * v * T / *scene_.relaxationTime;
                }
                x = next;
            }
    }
    ledger.gravityWork += fall;
    ledger.dampingDissipation += drag;
    ledger.restLoss += fall - drag;
    p.padLastChunk();
    return stray;
}

/// motion[i] = mass, momentum, velocity and (last) power of the internal forces of what sleeps at node i of a row; null
/// where nothing does. Kept until tiles fall asleep, wake or are set in motion.
template <int dim, class Shape>
const Record* ExplicitStepper<dim, Shape>::restingMotion(const nodal::NodeRow<dim>& row, const state::Block& block)
{
    char& known = motionKnown_[std::size_t(&block - grid_.blocks().data())];
    if (known == 0)
    {
        known = 2;
        for (const auto& overlap : block.tiles)
            if (grid_.tiles()[std::size_t(overlap.tile)].resting)
                known = 1;
        nodal::NodeRow<dim> each = row;
        const auto& box = block.box;
        each.begin = box.lo[0];
        each.end = box.lo[0] + box.n[0];
        for (each.k = box.lo[2]; known == 1 && each.k < box.lo[2] + box.n[2]; ++each.k)
            for (each.j = box.lo[1]; each.j < box.lo[1] + box.n[1]; ++each.j)
                sumRestingMotion(each, block,
                                 restingMotion_.data() + block.start + box.offset(each.begin, each.j, each.k));
    }
    if (known == 2)
        return nullptr;
    return restingMotion_.data() + block.start + block.box.offset(row.begin, row.j, row.k) - row.begin;
}

/// Walls hold what sleeps.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::sumRestingMotion(nodal::NodeRow<dim> row, const state::Block& block, Record* motion)
{
    std::fill_n(motion, row.end - row.begin, Record{});
    for (const auto& overlap : block.tiles)
    {
        const auto& tile = grid_.tiles()[std::size_t(overlap.tile)];
        const auto box = tile.window.moved(overlap.move);
        const Index begin = std::max(row.begin, box.lo[0]), end = std::min(row.end, box.lo[0] + box.n[0]);
        if (!tile.resting || begin >= end || !box.contains(begin, row.j, row.k))
            continue;
        const Record* own = grid_.template window<Record>(tile) + box.offset(begin, row.j, row.k);
        for (Index i = begin; i < end; ++i)
        {
            const Record node = transfer::finishNode<dim>(own[i - begin]);
            for (int n = 0; n <= 2 * dim; ++n)
                motion[i - row.begin][n] += node[n];
        }
    }
    if (!follows())
    {
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
                motion[i - row.begin][1 + dim + a] = 0;
        return;
    }
    Record nodes[1 << state::TileLayout::bitsOf(dim)];
    row.node = nodes - row.begin;
    for (Index i = row.begin; i < row.end; ++i)
    {
        const Record& m = motion[i - row.begin];
        row.node[i] = Record{m[0], 0.0};
        for (int a = 0; a < dim && m[0] > smallestMass_; ++a)
            row.node[i][row.trial + a] = m[1 + a] / m[0];
    }
    for (const auto& wall : walls_)
        if (!wall.wall().motion)
            wall.follow(row);
    for (Index i = row.begin; i < row.end; ++i)
    {
        Record& m = motion[i - row.begin];
        for (int a = 0; a < dim; ++a)
        {
            m[7] += m[1 + dim + a] * row.node[i][row.trial + a];
            m[1 + dim + a] = row.node[i][row.trial + a];
        }
    }
}

/// Strain energy of a tile, chunk by chunk.
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::energyOf(const state::Tile& tile)
{
    if (hyperelastic())
        return strainEnergy(state_, scene_.materials, tile.first, tile.count);
    auto& own = workspaces_.front();
    if (!own)
        own = std::make_unique<Workspace>();
    Workspace& ws = *own;
    alignas(64) double density[lanes];
    double energy = 0;
    for (Index first = tile.first; first < tile.first + tile.count; first += lanes)
    {
        const int count = int(std::min<Index>(lanes, tile.first + tile.count - first));
        for (int k = 0; k < stressSize<dim>; ++k)
            transfer::loadLanes(state_.particles.stress[k].data() + first, count, ws.law.stress[k]);
        transfer::loadLanesOrZero(state_.particles.volume.data() + first, count, ws.volume);
        loadModuli(ws, first, count);
        elasticEnergy(ws.law, ws.halfOverBulk, ws.quarterOverShear, density);
        energy += transfer::sumOfProducts(ws.volume, density);
    }
    return energy;
}
} // namespace mpm::stepping

// Who sleeps (rest.hpp), which tiles and blocks a step goes over, and what wakes.
#pragma once
#include "stepping/energyBudget.hpp"
#include "stepping/explicitStepper.hpp"
#include "stepping/timeStep.hpp"

#include <cmath>
#include <numeric>

namespace mpm::stepping
{
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::prepareRest()
{
    state_.particles.keep(&state::Particles::quietLooks, rests());
    if (!rests())
        return;
    restWave_ = std::numeric_limits<double>::infinity();
    for (const auto& material : scene_.materials)
        if (!material.law->rigid() && material.waveSpeed() < restWave_)
        {
            restWave_ = material.waveSpeed();
            restStress_ = scene_.rest->tolerance * material.density * restWave_ * restWave_;
        }
    restSpeed_ = scene_.rest->tolerance * restWave_;
}

/// The tiles of particles that take part in a step, and the blocks of nodes they reach: all, but for those at rest.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::choosePlaces()
{
    const auto& tiles = grid_.tiles();
    awake_.clear();
    Index sleeping = 0;
    for (std::size_t t = 0; t < tiles.size(); ++t)
        if (tiles[t].resting)
            sleeping += tiles[t].count;
        else
            awake_.push_back(Index(t));
    report_.resting = sleeping;
    reached_.clear();
    if (sleeping == 0)
    {
        reached_.resize(grid_.blocks().size());
        std::iota(reached_.begin(), reached_.end(), Index(0));
        return;
    }
    std::vector<char> reached(grid_.blocks().size());
    for (const Index t : awake_)
        for (const auto& overlap : tiles[std::size_t(t)].blocks)
            reached[std::size_t(overlap.block)] = 1;
    for (std::size_t b = 0; b < reached.size(); ++b)
        if (reached[b])
            reached_.push_back(Index(b));
}

/// Largest speed of a tile's particles, squared.
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::fastestOf(const state::Tile& tile) const
{
    double fastest = 0;
    for (Index i = tile.first; i < tile.first + tile.count; ++i)
    {
        double vv = 0;
        for (int a = 0; a < dim; ++a)
            vv += double(state_.particles.v[a][std::size_t(i)]) * double(state_.particles.v[a][std::size_t(i)]);
        fastest = vv > fastest || vv != vv ? vv : fastest;
    }
    return fastest;
}

/// Is a wall or gravity about to disturb a tile by itself?
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::isDriven(const state::Tile& tile) const
{
    for (const auto& effect : walls_)
    {
        const auto& wall = effect.wall();
        if (!wall.motion)
            continue;
        const Index plane = nodal::wallPlane(wall, state_.grid, state_.time), reach = 2;
        const Index low = tile.window.lo[wall.axis], high = low + tile.window.n[wall.axis] - 1;
        if (wall.side < 0 ? low <= plane + reach : high >= plane - reach)
            return true;
    }
    for (const auto& body : bodies_)
    {
        bool near = true;
        for (int a = 0; a < dim; ++a)
        {
            const double h = state_.grid.h, low = state_.grid.origin[a] + h * double(tile.window.lo[a] - 2);
            near =
                near && body.body().high()[a] >= low && body.body().low()[a] <= low + h * double(tile.window.n[a] + 3);
        }
        if (near)
            return true;
    }
    return scene_.gravityRamp && state_.time < scene_.gravityRamp->duration;
}

/// Tiles quiet at `looks` looks in a row fall asleep; in the first step those that do not move.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::lookForRest()
{
    auto& quiet = state_.particles.quietLooks;
    const double slow = Rest::quietShare * restSpeed_;
    for (const auto& tile : grid_.tiles())
    {
        const double vv = fastestOf(tile);
        const bool first = state_.step == 0 && vv == 0, driven = isDriven(tile);
        for (Index i = tile.first; i < tile.first + tile.count; ++i)
        {
            double& looks = quiet[std::size_t(i)];
            looks = driven ? 0 : first ? double(scene_.rest->looks) : vv <= slow * slow ? looks + 1 : 0;
        }
    }
}

/// Tiles just cut: those whose particles have all been quiet long enough are laid to rest.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::layToRest()
{
    auto& p = state_.particles;
    restingEnergy_ = 0;
    for (std::size_t t = 0; t < grid_.tiles().size(); ++t)
    {
        const auto& tile = grid_.tiles()[t];
        const auto touched = [&](const auto& o) { return shared(grid_.blocks()[std::size_t(o.block)]); };
        if (prescribed(tile.body) || (contact_ && std::any_of(tile.blocks.begin(), tile.blocks.end(), touched)))
            continue;
        const auto* looks = p.quietLooks.data() + tile.first;
        if (!std::all_of(looks, looks + tile.count, [&](double n) { return n >= double(scene_.rest->looks); }))
            continue;
        grid_.setResting(Index(t), true);
        double taken = 0;
        for (Index i = tile.first; i < tile.first + tile.count; ++i)
            for (int a = 0; a < dim; ++a)
            {
                auto& v = p.v[a][std::size_t(i)];
                const double momentum = p.mass[std::size_t(i)] * double(v);
                taken += 0.5 * momentum * double(v);
                state_.ledger.restImpulse[a] -= momentum;
                v = 0;
                next_[a][std::size_t(i)] = p.x[a][std::size_t(i)];
            }
        state_.ledger.restLoss += taken;
        state_.ledger.kineticEnergy -= taken;
        restingEnergy_ += strainEnergy(state_, scene_.materials, tile.first, tile.count);
    }
    p.padLastChunk();
    choosePlaces();
}

/// Wakes the tiles at rest that nodes solved so far disturb. Returns the blocks that then are to be solved too.
template <int dim, class Shape>
std::vector<Index> ExplicitStepper<dim, Shape>::wake(const std::vector<char>& solved)
{
    const auto& tiles = grid_.tiles();
    const Index count = Index(tiles.size());
    std::vector<char> disturbed(tiles.size());
    std::vector<double> left(tiles.size());
#pragma omp parallel for schedule(dynamic, 4) if (count > 100)
    for (Index t = 0; t < count; ++t)
        if (tiles[std::size_t(t)].resting)
        {
            const double unbalanced = disturbance(tiles[std::size_t(t)], solved);
            disturbed[std::size_t(t)] = !(unbalanced <= 1);
            left[std::size_t(t)] = unbalanced <= 1 ? unbalanced : 0;
        }
    report_.restingStress = restStress_ * (count > 0 ? *std::max_element(left.begin(), left.end()) : 0);
    bool any = false;
    for (Index t = 0; t < count; ++t)
        if (disturbed[std::size_t(t)])
        {
            const auto& tile = tiles[std::size_t(t)];
            any = true;
            grid_.setResting(t, false);
            std::fill_n(state_.particles.quietLooks.begin() + tile.first, tile.count, 0.0);
            restingEnergy_ -= strainEnergy(state_, scene_.materials, tile.first, tile.count);
            state_.ledger.wakes += 1;
        }
    std::vector<Index> more;
    if (!any)
        return more;
    choosePlaces();
    if (report_.resting == 0)
        restingEnergy_ = 0;
    for (const Index b : reached_)
        if (!solved[std::size_t(b)])
            more.push_back(b);
    return more;
}

/// The largest of |v*|/(eps c_p) and |a| h/(eps c_p^2) over the solved nodes a tile has mass at.
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::disturbance(const state::Tile& tile, const std::vector<char>& solved)
{
    const double perSpeed = 1 / (restSpeed_ * restSpeed_);
    const double perAcceleration = std::pow(state_.grid.h / (restSpeed_ * restWave_), 2);
    double largest = 0;
    const Record* window = grid_.template window<Record>(tile); // as the tile was projected last
    for (const auto& overlap : tile.blocks)
    {
        if (!solved[std::size_t(overlap.block)])
            continue;
        const auto& block = grid_.blocks()[std::size_t(overlap.block)];
        const auto box = tile.window.moved(overlap.move), both = box.common(block.box);
        for (Index k = both.lo[2]; k < both.lo[2] + both.n[2]; ++k)
            for (Index j = both.lo[1]; j < both.lo[1] + both.n[1]; ++j)
                for (Index i = both.lo[0]; i < both.lo[0] + both.n[0]; ++i)
                {
                    const Record& own = window[box.offset(i, j, k)];
                    const Record& node = grid_.nodes(block)[block.box.offset(i, j, k)];
                    if (!(own[0] > smallestMass_))
                        continue;
                    double vv = 0, aa = 0;
                    for (int a = 0; a < dim; ++a)
                    {
                        vv += node[1 + a] * node[1 + a];
                        aa += node[1 + dim + a] * node[1 + dim + a];
                    }
                    const double most = std::max(perSpeed * vv, perAcceleration * aa);
                    largest = most > largest || most != most ? most : largest;
                }
    }
    return std::sqrt(largest);
}

/// Momentum that comes from, or goes to, what sleeps: its share of the acceleration of solved nodes and of what PIC
/// makes of v_i; and the internal forces at solved nodes, which are those at nodes not solved with the sign turned.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::bookResting(const std::vector<Index>& blocks)
{
    const double alpha = scene_.picRate > 0 ? -std::expm1(-scene_.picRate * kick_) : 0;
    forEachRow(blocks, [&](nodal::NodeRow<dim>& row, const state::Block& block) { bookResting(row, block, alpha); });
    for (const auto& block : blockSums_)
        for (int a = 0; a < dim; ++a)
            state_.ledger.restImpulse[a] += block.restImpulse[a];
    state_.ledger.restingSteps += report_.resting;
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::bookResting(const nodal::NodeRow<dim>& row, const state::Block& block, double alpha)
{
    Record sum[1 << state::TileLayout::bitsOf(dim)] = {};
    sumWindows(row, block, sum);
    for (Index i = row.begin; i < row.end; ++i)
    {
        const Record all = transfer::finishNode<dim>(sum[i - row.begin]);
        for (int a = 0; a < dim; ++a)
            row.sums->restImpulse[a] += kick_ * all[1 + dim + a];
    }
    for (const auto& overlap : block.tiles)
    {
        const auto& tile = grid_.tiles()[std::size_t(overlap.tile)];
        const auto box = tile.window.moved(overlap.move);
        const Index begin = std::max(row.begin, box.lo[0]), end = std::min(row.end, box.lo[0] + box.n[0]);
        if (!tile.resting || begin >= end || !box.contains(begin, row.j, row.k))
            continue;
        const Record* own = grid_.template window<Record>(tile) + box.offset(begin, row.j, row.k);
        for (Index i = begin; i < end; ++i)
            for (int a = 0; a < dim; ++a)
            {
                const double change = kick_ * row.node[i][1 + dim + a];
                row.sums->restImpulse[a] -= own[i - begin][0] * (change + alpha * (row.node[i][1 + a] - change));
            }
    }
}
} // namespace mpm::stepping

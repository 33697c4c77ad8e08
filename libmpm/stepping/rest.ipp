// Who sleeps (rest.hpp), which tiles and blocks a step goes over, and what wakes.
#pragma once
#include "base/error.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/explicitStepper.hpp"
#include "stepping/timeStep.hpp"

#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace mpm::stepping
{
/// Of each block the box of nodes that some tiles reach.
inline std::vector<state::NodeBox> partsOf(const state::TileGrid& grid, const std::vector<Index>& tiles)
{
    std::vector<state::NodeBox> parts(grid.blocks().size());
    for (const Index t : tiles)
    {
        const auto& tile = grid.tiles()[std::size_t(t)];
        for (const auto& overlap : tile.blocks)
        {
            auto& part = parts[std::size_t(overlap.block)];
            const auto own = tile.window.moved(overlap.move).common(grid.blocks()[std::size_t(overlap.block)].box);
            if (own.size() > 0)
                part = part.size() == 0 ? own : part.around(own);
        }
    }
    return parts;
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::prepareRest()
{
    state_.particles.keep(&state::Particles::quietLooks, rests());
    if (!rests())
        return;
    if (follows() && !scene_.carried.empty())
        throw InputError(
            fmt::format("system/mpmSchemes: rest.follow: found yes beside the surface '{}', which may carry "
                        "loads; allowed: no, as what these do is known step by step only",
                        scene_.carried.front()->name));
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
    parts_.clear();
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
    if (follows()) // nothing wakes within a step
        parts_ = partsOf(grid_, awake_);
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

/// May nodes that no tile awake reaches be disturbed in this very step? Walls and bodies keep awake what is near them.
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::disturbsEverywhere() const
{
    bool incoming = false;
    for (const auto& plane : scene_.absorbing)
        incoming = incoming || plane.incoming;
    return incoming || !tractions_.empty() || !carriers_.empty() ||
           (scene_.gravityRamp && state_.time < scene_.gravityRamp->duration);
}

/// In solved nodes of a step in which the particles are sorted: which of the tiles awake are quiet?
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::lookForRest()
{
    const std::vector<char> solved(grid_.blocks().size(), 1);
    for (const Index t : awake_)
    {
        const auto& tile = grid_.tiles()[std::size_t(t)];
        const bool quiet =
            !isDriven(tile) && disturbance(tile, solved) <=
                                   (follows() ? Rest::quietShare / double(scene_.sortInterval) : Rest::quietShare);
        for (Index i = tile.first; i < tile.first + tile.count; ++i)
        {
            double& looks = state_.particles.quietLooks[std::size_t(i)];
            looks = quiet ? std::min(looks + 1, double(scene_.rest->looks)) : 0;
        }
    }
}

/// Tiles just sorted fall asleep that were quiet at the last looks; in the first step those whose particles do not
/// move.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::fallAsleep()
{
    auto& p = state_.particles;
    for (const auto& tile : grid_.tiles())
    {
        bool quiet = true;
        for (Index i = tile.first; i < tile.first + tile.count && quiet; ++i)
        {
            double vv = 0;
            for (int a = 0; a < dim; ++a)
                vv += std::abs(double(p.v[a][std::size_t(i)]));
            quiet = p.quietLooks[std::size_t(i)] >= double(scene_.rest->looks) || (state_.step == 0 && vv == 0);
        }
        if (quiet && !isDriven(tile))
            std::fill_n(p.quietLooks.begin() + tile.first, tile.count, asleep());
    }
}

/// Tiles just cut: those whose particles all sleep are at rest.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::layToRest()
{
    auto& p = state_.particles;
    restingEnergy_ = 0;
    waking_.clear();
    for (std::size_t t = 0; t < grid_.tiles().size(); ++t)
    {
        const auto& tile = grid_.tiles()[t];
        const auto touched = [&](const auto& o) { return shared(grid_.blocks()[std::size_t(o.block)]); };
        if (prescribed(tile.body) || (contact_ && std::any_of(tile.blocks.begin(), tile.blocks.end(), touched)))
            continue;
        const auto* looks = p.quietLooks.data() + tile.first;
        if (!std::all_of(looks, looks + tile.count, [&](double n) { return n >= asleep(); }))
            continue;
        grid_.setResting(Index(t), true);
        if (*looks > asleep())
            waking_.push_back(Index(t));
        double taken = 0;
        for (Index i = tile.first; i < tile.first + tile.count; ++i)
            for (int a = 0; a < dim; ++a)
            {
                auto& v = p.v[a][std::size_t(i)];
                const double momentum = follows() ? 0 : p.mass[std::size_t(i)] * double(v);
                taken += 0.5 * momentum * double(v);
                state_.ledger.restImpulse[a] -= momentum;
                if (!follows())
                    v = 0;
                next_[a][std::size_t(i)] = p.x[a][std::size_t(i)];
            }
        state_.ledger.restLoss += taken;
        state_.ledger.kineticEnergy -= taken;
        restingEnergy_ += energyOf(tile);
    }
    p.padLastChunk();
    choosePlaces();
    motionKnown_.assign(grid_.blocks().size(), 0);
    resting_ = follows() ? motionOfSleepers() : MotionOfSleepers{};
    restingMotion_.resize(
        grid_.blocks().empty() ? 0 : grid_.blocks().back().start + std::size_t(grid_.blocks().back().box.size()));
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
    if (count > 0)
        report_.restingStress =
            std::max(report_.restingStress, restStress_ * *std::max_element(left.begin(), left.end()));
    bool any = false;
    for (Index t = 0; t < count; ++t)
        if (disturbed[std::size_t(t)])
        {
            const auto& tile = tiles[std::size_t(t)];
            if (follows())
            {
                if (std::find(waking_.begin(), waking_.end(), t) == waking_.end())
                {
                    waking_.push_back(t);
                    std::fill_n(state_.particles.quietLooks.begin() + tile.first, tile.count, asleep() + 1);
                    state_.ledger.wakes += 1;
                }
                continue;
            }
            any = true;
            grid_.setResting(t, false);
            std::fill_n(state_.particles.quietLooks.begin() + tile.first, tile.count, 0.0);
            restingEnergy_ -= energyOf(tile);
            state_.ledger.wakes += 1;
        }
    std::vector<Index> more;
    if (!any)
        return more;
    choosePlaces();
    motionKnown_.assign(grid_.blocks().size(), 0);
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
    // what follows may move, but by a small part of a cell from look to look
    const double fastest = follows() ? 0.05 * state_.grid.h / (kick_ * double(scene_.sortInterval)) : restSpeed_;
    const double perSpeed = 1 / (fastest * fastest);
    const double perAcceleration = std::pow(state_.grid.h / (restSpeed_ * restWave_), 2);
    double largest = 0;
    const Record* window = grid_.template window<Record>(tile); // as the tile was projected last
    for (const auto& overlap : tile.blocks)
    {
        if (!solved[std::size_t(overlap.block)])
            continue;
        const auto& block = grid_.blocks()[std::size_t(overlap.block)];
        const auto box = tile.window.moved(overlap.move);
        const auto both = box.common(inPart_ ? parts_[std::size_t(overlap.block)] : block.box);
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

/// Holds the solved nodes that sleeping particles have mass at, and books the momentum this takes: of nodes held, of
/// what sleeps at the others, and the internal forces at solved nodes, which are those at nodes not solved with the
/// sign turned.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::holdResting(const std::vector<Index>& blocks)
{
    const double alpha = scene_.picRate > 0 ? -std::expm1(-scene_.picRate * kick_) : 0;
    forEachRow(
        blocks,
        [&](nodal::NodeRow<dim>& row, const state::Block& block) {
            Record sum[1 << state::TileLayout::bitsOf(dim)] = {};
            sumWindows(row, block, sum);
            const Record* motion = restingMotion(row, block);
            for (Index i = row.begin; i < row.end; ++i)
            {
                Record& r = row.node[i];
                const Record projected = transfer::finishNode<dim>(sum[i - row.begin]);
                const Record sleeping = motion ? motion[i] : Record{};
                const double resting = sleeping[0];
                const bool held = resting > smallestMass_;
                if (held && r[0] - resting > smallestMass_)
                    row.sums->restWork -= kick_ * sleeping[7];
                for (int a = 0; a < dim; ++a)
                {
                    const double after = r[1 + a], change = kick_ * r[1 + dim + a], own = sleeping[1 + dim + a];
                    row.sums->restImpulse[a] += kick_ * projected[1 + dim + a] - resting * change -
                                                alpha * (resting * (after - change) - sleeping[1 + a]) -
                                                (held ? (r[0] - resting) * (after - own) : 0);
                    if (held)
                    {
                        r[1 + a] = own;
                        r[1 + dim + a] = (own + change - after) / kick_;
                    }
                }
            }
        },
        inPart_);
    for (const auto& block : blockSums_)
        for (int a = 0; a < dim; ++a)
            state_.ledger.restImpulse[a] += block.restImpulse[a];
    double given = 0;
    for (const auto& block : blockSums_)
        given += block.restWork;
    state_.ledger.restLoss += given; // and takes it as it follows
    state_.ledger.transferLoss -= given;
    state_.ledger.restingSteps += report_.resting;
}

/// Nodes that are held do not strain what is awake.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::holdStrainVelocities()
{
    if (report_.resting == 0)
        return;
    forEachRow([&](nodal::NodeRow<dim>& row, const state::Block& block) {
        const Record* motion = restingMotion(row, block);
        for (Index i = row.begin; motion && i < row.end; ++i)
            for (int a = 0; a < dim && motion[i][0] > smallestMass_; ++a)
                row.node[i][row.trial + a] = motion[i][1 + dim + a];
    });
}
} // namespace mpm::stepping

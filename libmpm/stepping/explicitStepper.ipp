// Definitions of ExplicitStepper, included by the files that instantiate it.
#pragma once
#include "base/clock.hpp"
#include "base/error.hpp"
#include "stepping/actorWork.ipp"
#include "stepping/books.ipp"
#include "stepping/bulkViscosity.ipp"
#include "stepping/chunkWork.ipp"
#include "stepping/contactWork.ipp"
#include "stepping/lawWork.ipp"
#include "stepping/nodeWork.ipp"
#include "stepping/rest.ipp"
#include "stepping/restFollow.ipp"
#include "stepping/stepReports.ipp"
#include "stepping/stressTreatment.ipp"
#include "stepping/velocityFilter.ipp"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <omp.h>

namespace mpm::stepping
{
template <int dim, class Shape>
ExplicitStepper<dim, Shape>::ExplicitStepper(state::State& state, const Scene& scene)
    : state_(state), scene_(scene), barriers_(wallBarriers(scene, state.grid)),
      layout_(state.grid, scene.contact ? scene.contact->bodyOf : std::vector<int>{},
              scene.tileBits.value_or(state::TileLayout::bitsOf(dim, scene.rest.has_value())))
{
    if (scene.relaxationTime) // last: it needs what all others do
        effects_.push_back(std::make_unique<nodal::Damping<dim>>(*scene.relaxationTime));
    if (scene.localDamping)
        localDamping_ = std::make_unique<nodal::LocalDamping<dim>>(*scene.localDamping);
    for (const auto& wall : scene.walls)
    {
        walls_.emplace_back(wall, wall.motion ? actors_++ : -1);
        wallsMove_ = wallsMove_ || wall.motion;
        if (!wall.motion || wall.motion->stillAlong(std::size_t(wall.axis)))
            wallPlanes_[std::size_t(wall.axis)].push_back(std::int32_t(wall.plane));
    }
    if (scene.contact)
        contact_ = std::make_unique<nodal::Contact<dim>>(*scene.contact, particleReach());
    for (const auto& body : scene.bodies)
        bodies_.emplace_back(body, state.grid, actors_++);
    for (const auto& plane : scene.absorbing)
        absorbing_.emplace_back(plane);
    bounded_ = bounded();
    for (const auto& load : scene.loads)
        for (std::size_t k = 0; k < state.patches.size(); ++k)
            if (state.patches[k].name == load.patch)
            {
                tractions_.emplace_back(load, nodal::bodyUnder(state.patches[k].centres(), state.particles, layout_));
                tractionPatch_.push_back(k);
            }
    for (const auto& surface : scene.carried)
        carriers_.emplace_back(*surface, nodal::bodyUnder(surface->points, state.particles, layout_));
    for (const auto& material : scene.materials)
    {
        moduli_.push_back({0.5 / material.law->bulkModulus(), 0.25 / material.law->shearModulus()});
        anyHistory_ = anyHistory_ || material.law->usesHistory();
        anyHyperelastic_ = anyHyperelastic_ || material.law->hyperelastic();
        anyPlastic_ = anyPlastic_ || material.law->plastic();
    }
    state.particles.keep(&state::Particles::plasticStrain, anyHistory_);
    if (affine() && !state.particles.hasAffine())
        state.particles.enableAffine();
    if (!affine() && state.particles.hasAffine()) // the state of a run with another transfer
        state.particles.disableAffine();
    prepareTreatment();
    prepareRest();
    if (!plain)
        state.particles.keep(&state::Particles::family, scene.merging.has_value());
    if (keysNameBodies(state, layout_))
        sortByStoredKeys(state);
    else // the state of a run with other bodies
        sortByPosition(state, layout_, Narrow::nodes);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::particlesChanged()
{
    arranged_ = projected_ = stray_ = false;
}

// One step ------------------------------------------------------------------------------------------------------------

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::step(double dt)
{
    if (follows())
        catchUp();
    arrange();
    project();
    if (driven())
        placeActors(dt);
    if (contact_)
        contact_->place(state_.time, dt);
    if (follows())
        keepUp(dt);
    kick_ = scene_.staggeredStart && state_.step == 0 ? 0.5 * dt : dt;
    switch (scene_.stressUpdate)
    {
    case StressUpdate::MUSL:
        solveNodes();
        filterVelocities();
        particlePass(dt, {.velocity = true, .reproject = true});
        moveSurfaces(dt);
        strainVelocities(dt, true);
        if (rests())
            holdStrainVelocities();
        strainPass(dt, 1 + dim, true);
        break;
    case StressUpdate::USL:
        solveNodes();
        filterVelocities();
        moveSurfaces(dt);
        if (scene_.treatment.any())
        {
            particlePass(dt, {.velocity = true});
            strainPass(dt, 1, true);
        }
        else
            particlePass(dt, {.velocity = true,
                              .strain = true,
                              .gradientLane = 1,
                              .moves = true,
                              .then = sortsNext() ? Project::nothing : Project::forces});
        break;
    case StressUpdate::USF:
        strainVelocities(dt, false);
        if (rests())
            holdStrainVelocities();
        strainPass(dt, 1 + dim, false);
        if (conjugate())
            projectAgain(Project::forces);
        solveNodes();
        filterVelocities();
        moveSurfaces(dt);
        particlePass(dt, {.velocity = true, .moves = true, .then = sortsNext() ? Project::nothing : firstProjection()});
        break;
    }
    bookStressWork(dt);
    if (actors_ > 0)
        reportActors(dt);
    state_.time += dt;
    state_.deltaT = dt;
    ++state_.step;
}

/// Merging, splitting and sorting at their intervals, and a sort where a particle has left its window; then tiles are
/// cut anew. What is done here follows from the state alone, so a continued run does the same.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::arrange()
{
    bool merged = false;
    if (scene_.merging && state_.step % scene_.merging->interval == 0)
    {
        Clock clock(times_.split);
        merged = splitting::mergeParticles(state_, *scene_.merging, scene_.materials) > 0;
    }
    if (splitsNow())
        split(arranged_ && !merged);
    if (const bool turn = state_.step % scene_.sortInterval == 0; turn || stray_ || merged)
        sortAnew(turn);
    else if (!arranged_)
    {
        Clock clock(times_.sort);
        buildTiles();
    }
}

/// Where the last strain pass saw long edges, if tiles are still what they were (`known`); else everywhere.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::split(bool known)
{
    Clock clock(times_.split);
    if (wallsMove_)
        barriers_ = wallBarriers(scene_, state_.grid, state_.time);
    std::vector<splitting::Range> where;
    for (std::size_t t = 0; known && t < longEdges_.size(); ++t)
        if (const auto& tile = grid_.tiles()[t]; longEdges_[t])
            where.push_back({tile.first, tile.first + tile.count});
    if (splitting::splitParticles(state_, *scene_.splitting, barriers_, known ? &where : nullptr).added > 0)
    {
        sortLoose(state_, layout_, Narrow::nodes);
        arranged_ = false;
    }
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::sortAnew(bool look)
{
    Clock clock(times_.sort);
    wrapPositions(state_);
    sortByPosition(state_, layout_, Narrow::nodes);
    buildTiles(look);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::buildTiles(bool look)
{
    const auto& p = state_.particles;
    grid_.build(p, layout_, Shape::nodes - Narrow::nodes, Shape::nodes - 1);
    tileSums_.assign(grid_.tiles().size(), {});
    longEdges_.assign(grid_.tiles().size(), 1);
    workspaces_.resize(std::size_t(std::max(1, omp_get_max_threads())));
    for (int a = 0; a < dim; ++a)
        next_[a].resize(p.mass.size());
    smallestMass_ = largestMass(p) * 1e-60; // below it 1/m could overflow; far under any weight that matters
    if constexpr (Shape::hasDomain)
    {
        auto ws = std::make_unique<Workspace>();
        constexpr bool needsF = Shape::followsStretch || hasCorners;
        for (int a = 0; a < dim && Shape::followsStretch; ++a)
            domain_[a].resize(p.mass.size());
        for (Index first = 0; first < p.size(); first += lanes)
        {
            const int count = int(std::min<Index>(lanes, p.size() - first));
            for (int k = 0; k < dim * dim && needsF; ++k)
                transfer::loadLanes(p.F[k].data() + first, count, ws->F[k]);
            updateDomains(*ws, first, count);
        }
        report_.cappedDomains = ws->sums.cappedDomains;
    }
    arranged_ = true;
    projected_ = false;
    if (contact_)
        sizeContact();
    choosePlaces();
    if (rests())
    {
        if (look)
            fallAsleep();
        layToRest();
    }
    if (scene_.treatment.any())
        sizeTreatment();
}

/// The first projection of a step, unless the pass that ended the last one has made it.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::project()
{
    const Project what = firstProjection();
    if (!projected_ || stray_)
        projectAgain(what);
    if (stray_) // particles have moved on since they were sorted
    {
        sortAnew(false);
        projectAgain(what);
        if (stray_)
            failOutside();
    }
    projected_ = false;
}

/// A projection on its own; forces with the pressure of the averages they are conjugate to.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::projectAgain(Project what)
{
    if (conjugate() && what == Project::forces)
    {
        averagePressure();
        if (stray_)
            return;
    }
    particlePass(0, {.then = what, .everyone = true});
}

/// Strain and stress, with what is done against erratic stresses; then the next projection, where it can be made yet.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::strainPass(double dt, int gradientLane, bool moves)
{
    if (relaxes())
        correctStress();
    if (averages())
        averageVolumeChange(dt, gradientLane);
    particlePass(dt, {.strain = true,
                      .gradientLane = gradientLane,
                      .moves = moves,
                      .then = conjugate() || (moves && sortsNext()) ? Project::nothing : Project::forces});
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::particlePass(double dt, const Pass& wanted)
{
    const Pass pass = completed(wanted);
    Clock clock(particleSeconds_);
    const bool timed = state_.step % 16 == 0;
    const auto& tiles = grid_.tiles();
    const bool all = pass.everyone || awake_.size() == tiles.size();
    const int count = int(all ? tiles.size() : awake_.size());
    for (auto& ws : workspaces_)
        if (ws)
            ws->times = {};
#pragma omp parallel
    {
        auto& ws = workspaces_[std::size_t(omp_get_thread_num())];
        if (!ws)
            ws = std::make_unique<Workspace>();
        ws->timed = timed;
#pragma omp for schedule(dynamic, 1)
        for (int n = 0; n < count; ++n)
        {
            const Index t = all ? n : awake_[std::size_t(n)];
            ws->sums = {};
            passOverTile(*ws, tiles[std::size_t(t)], dt, pass);
            tileSums_[std::size_t(t)] = ws->sums;
            if (pass.strain && splitsNext())
                longEdges_[std::size_t(t)] = ws->sums.longEdges;
        }
    }
    if (timed)
        for (const auto& ws : workspaces_)
            if (ws)
                sampled_ += ws->times;
    if (pass.moves)
        for (int a = 0; a < dim; ++a)
            std::swap(state_.particles.x[a], next_[a]);
    book(pass);
    if (pass.moves && stray_)
        wrapPositions(state_);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::moveSurfaces(double dt)
{
    for (std::size_t k = 0; k < tractions_.size(); ++k)
        nodal::movePatch<dim>(state_.patches[tractionPatch_[k]], state_.grid, grid_, tractions_[k].body(),
                              smallestMass_, dt);
    for (auto& surface : carriers_)
        surface.move(state_.grid, grid_, smallestMass_, dt);
}

template <int dim, class Shape>
std::unique_ptr<Stepper> makeExplicitStepper(state::State& state, const Scene& scene)
{
    return std::make_unique<ExplicitStepper<dim, Shape>>(state, scene);
}
} // namespace mpm::stepping

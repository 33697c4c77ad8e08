// The work of a particle pass on one tile and one chunk: weights, velocity, strain, stress, domains, projection.
#pragma once
#include "base/clock.hpp"
#include "stepping/affineWork.ipp"
#include "stepping/explicitStepper.hpp"
#include "stepping/extraWork.ipp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace mpm::stepping
{
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::lap(Workspace& ws, double PassTimes::*part)
{
    if (!ws.timed)
        return;
    const double time = now();
    ws.times.*part += time - ws.lapStart;
    ws.lapStart = time;
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::passOverTile(Workspace& ws, const state::Tile& tile, double dt, const Pass& pass)
{
    using Values = transfer::ValueNode<dim>;
    if (ws.timed)
        ws.lapStart = now();
    if (ws.values.size() < std::size_t(grid_.largestWindow()))
    {
        ws.values.resize(std::size_t(grid_.largestWindow()));
        ws.gradients.resize(std::size_t(grid_.largestWindow()));
    }
    openTreatment(ws, tile, pass);
    // Where no particle has a weight its gradient is zero too, but for shapes with kinks.
    constexpr bool inReach = Narrow::nodes > 2 && !hasCorners;
    if (pass.velocity || pass.byStrainVelocity)
        grid_.copyToWindow(
            tile, ws.values.data(), [](const Record& r) { return Values::pack(r); }, 0, inReach);
    if (pass.filtered || pass.filter)
    {
        ws.filteredValues.resize(ws.values.size());
        grid_.copyToWindow(
            tile, ws.filteredValues.data(), [](const Record& r) { return Values::pack(r); }, filterLayer, inReach);
    }
    if ((pass.gathers && pass.gradientLane == 1) || (pass.velocity && pass.affine))
        grid_.copyToWindow(
            tile, ws.gradients.data(), [](const Record& r) { return transfer::GradientNode<dim, 1>::pack(r); },
            movesFiltered() ? filterLayer : 0, inReach);
    if (pass.gathers && pass.gradientLane != 1)
        grid_.copyToWindow(
            tile, ws.gradients.data(), [](const Record& r) { return transfer::GradientNode<dim, 1 + dim>::pack(r); }, 0,
            inReach);
    lap(ws, &PassTimes::toParticles);
    if (pass.reproject || pass.filter || pass.then == Project::momentum)
        grid_.template clearWindow<HalfRecord>(tile, pass.reproject);
    else if (pass.then == Project::forces)
        grid_.template clearWindow<Record>(tile);
    lap(ws, &PassTimes::toGrid);
    listColumns(ws.ahead, pass);
    ws.laneSums = {};
    for (Index first = tile.first, end = tile.first + tile.count; first < end;)
    {
        const int count = int(std::min(lanes - first % 8, end - first));
        passOverChunk(ws, tile, first, count, dt, pass);
        first += count;
    }
    ws.laneSums.addTo(ws.sums);
    if (pass.then == Project::forces)
        grid_.template findReach<Record>(tile);
    else if (pass.then == Project::momentum)
        grid_.template findReach<HalfRecord>(tile);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::passOverChunk(Workspace& ws, const state::Tile& tile, Index first, int count,
                                                double dt, const Pass& pass)
{
    ws.ahead.begin(first + lanes);
    if (pass.prepares)
        return prepareOverChunk(ws, tile, first, count, pass);
    auto& p = state_.particles;
    const auto prefetch = [&] { ws.ahead.some(2); };
    for (int a = 0; a < dim; ++a)
    {
        transfer::loadLanes(p.x[a].data() + first, count, ws.x[a]);
        transfer::loadLanes(p.v[a].data() + first, count, ws.v[a]);
    }
    transfer::loadLanesOrZero(p.mass.data() + first, count, ws.mass);
    loadDomains(ws, first, count);

    if (pass.velocity || pass.gathers || pass.byStrainVelocity)
        withWeights(
            ws, ws.x, [&](auto& w) __attribute__((always_inline)) {
                w.locate(tile.window); // as when these particles were projected
                lap(ws, &PassTimes::weights);
                if (pass.velocity)
                {
                    if (pass.filtered)
                        gatherValues(w, ws.filteredValues.data(), tile.window, ws.filtered, prefetch);
                    gatherValues(w, ws.values.data(), tile.window, ws.value, prefetch);
                    advanceVelocity(ws, first, count, dt, pass);
                    if (pass.affine)
                        advanceAffine(ws, w, tile, first, count);
                    lap(ws, &PassTimes::toParticles);
                }
                if (pass.reproject)
                {
                    ws.momentum.build(ws.mass, ws.v);
                    projectMomentum(ws, w, tile, ws.x, first, count, pass.affine);
                }
                if (pass.byStrainVelocity)
                {
                    gatherValues(w, ws.values.data(), tile.window, ws.value, prefetch); // v* and w
                    moveByStrainVelocity(ws, first, count, dt);
                }
                if (pass.gathers)
                {
                    gatherGradient(w, ws.gradients.data(), tile.window, ws.L, prefetch);
                    lap(ws, &PassTimes::toParticles);
                }
            });
    if (pass.strain)
    {
        updateStress(ws, tile, first, count, dt);
        lap(ws, &PassTimes::law);
    }
    if (pass.then == Project::nothing)
        return;

    if (pass.moves && !pass.velocity && !pass.byStrainVelocity) // an earlier pass has left the new positions
        for (int a = 0; a < dim; ++a)
            transfer::loadLanes(next_[a].data() + first, count, ws.xNew[a]);
    const Vectors& x = pass.moves ? ws.xNew : ws.x;
    checkInside(ws, x);
    withWeights(
        ws, x, [&](auto& w) __attribute__((always_inline)) {
            const bool reached = w.locate(tile.window);
            lap(ws, &PassTimes::weights);
            ws.sums.stray = ws.sums.stray || !reached;
            if (ws.sums.stray)
                return;
            if (pass.then == Project::momentum)
            {
                ws.momentum.build(ws.mass, ws.v);
                projectMomentum(ws, w, tile, x, first, count, pass.affine);
                return;
            }
            if (!pass.strain)
            {
                transfer::loadLanesOrZero(p.volume.data() + first, count, ws.volume);
                for (int k = 0; k < stressSize<dim>; ++k)
                    transfer::loadLanes(p.stress[k].data() + first, count, ws.law.stress[k]);
            }
            if (pass.addsStress)
                addStressOfForces(ws, tile, x, first, count, pass);
            ws.forces.build(ws.mass, ws.v, ws.volume, ws.law.stress);
            projectChunk(w, ws.forces, count, grid_.template window<Record>(tile), tile.window, [] {});
            if (pass.addsForce)
                addForces(ws, w, tile, x, first, count, dt, pass);
            lap(ws, &PassTimes::toGrid);
        });
}

/// The columns a pass reads, in about the order it reads them.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::listColumns(transfer::Prefetch& ahead, const Pass& pass) const
{
    const auto& p = state_.particles;
    ahead.clear();
    for (int a = 0; a < dim; ++a)
    {
        ahead.add(p.x[a].data());
        if (!pass.prepares)
            ahead.add(p.v[a].data());
        if constexpr (Shape::hasDomain) // CPDI: F with it, below
            ahead.add(Shape::followsStretch ? domain_[a].data() : p.length0[a].data());
        if (pass.velocity || pass.moves)
            ahead.add(next_[a].data());
    }
    if (!pass.gradient && !pass.pressure)
        ahead.add(p.mass.data());
    if (pass.gradient || pass.pressure)
        ahead.add(p.volume.data());
    for (int k = 0; k < stressSize<dim> && pass.round == Round::finish; ++k)
        ahead.add(correction_[k].data());
    for (int k = 0; k < dim * dim && (pass.strain || hasCorners); ++k)
        ahead.add(p.F[k].data());
    if (pass.strain)
    {
        ahead.add(p.volume0.data());
        ahead.add(p.material.data());
        for (int k = 0; k < dim * dim && averages(); ++k)
            ahead.add(gradient_[k].data());
    }
    const bool stresses = pass.strain || pass.then == Project::forces;
    for (int k = 0; k < stressSize<dim> && (stresses || pass.round == Round::project || pass.round == Round::again);
         ++k)
        ahead.add(p.stress[k].data());
    if (stresses)
        ahead.add(p.volume.data());
}

/// Weights at x by the shape, or by its narrow form where no domain of the chunk needs more nodes.
template <int dim, class Shape>
template <class Body>
void ExplicitStepper<dim, Shape>::withWeights(Workspace& ws, const Vectors& x, Body&& body) const
{
    bool narrow = true;
    if constexpr (Shape::followsStretch)
    {
        for (int a = 0; a < dim; ++a)
            narrow = narrow && transfer::allWithin(ws.half[a], 0, 0.5);
    }
    if (narrow)
    {
        ws.narrow.evaluate(x, ws.half, state_.grid, wallPlanes_);
        body(ws.narrow);
    }
    else if constexpr (Shape::followsStretch)
    {
        ws.wide.evaluate(x, ws.half, state_.grid, wallPlanes_);
        body(ws.wide);
    }
}

/// Half lengths of the domains over h: initial edges (uGIMP), or following the stretch (cpGIMP).
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::loadDomains(Workspace& ws, Index first, int count) const
{
    if constexpr (!Shape::hasDomain)
        return;
    if constexpr (hasCorners)
    {
        for (int k = 0; k < dim * dim; ++k)
            transfer::loadLanes(state_.particles.F[k].data() + first, count, ws.F[k]);
        cornerDomains(ws, first, count);
        return;
    }
    for (int a = 0; a < dim; ++a)
    {
        if constexpr (Shape::followsStretch)
            transfer::loadLanes(domain_[a].data() + first, count, ws.half[a]);
        else
        {
            transfer::loadLanes(state_.particles.length0[a].data() + first, count, ws.half[a]);
            const double scale = 0.5 / state_.grid.h;
            for (int l = 0; l < lanes; ++l)
                ws.half[a][l] = scale * ws.half[a][l] < 0.5 ? scale * ws.half[a][l] : 0.5;
        }
    }
}

/// Half edges of the domains in cells, from ws.F; returns how many domains are held at their widest.
template <int dim, class Shape>
int ExplicitStepper<dim, Shape>::cornerDomains(Workspace& ws, Index first, int count) const
{
    alignas(64) double half[lanes];
    const double scale = 0.5 / state_.grid.h;
    for (int k = 0; k < dim; ++k)
    {
        transfer::loadLanes(state_.particles.length0[k].data() + first, count, half);
        for (int a = 0; a < dim; ++a)
            for (int l = 0; l < lanes; ++l)
                ws.half[a * dim + k][l] = scale * half[l] * ws.F[a * dim + k][l];
    }
    return shape::CPDI::holdWithin<dim>(ws.half, count);
}

/// Domains after F has changed (in ws.F). Those wider than the shape's support allows are held there and counted.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::updateDomains(Workspace& ws, Index first, int count)
{
    if constexpr (hasCorners)
    {
        ws.sums.cappedDomains += cornerDomains(ws, first, count);
        return;
    }
    const auto& p = state_.particles;
    const double scale = 0.5 / state_.grid.h;
    constexpr double widest = Shape::followsStretch ? 1.0 : 0.5;
    constexpr double rounding = std::is_same_v<state::Stored, double> ? 1e-12 : 1e-6; // of length0 and F
    alignas(64) double U[dim][lanes];
    if constexpr (Shape::followsStretch)
        constitutive::stretchDiagonal(ws.F, U);
    for (int a = 0; a < dim; ++a)
    {
        transfer::loadLanes(p.length0[a].data() + first, count, ws.half[a]);
        for (int l = 0; l < lanes; ++l)
        {
            double half = scale * ws.half[a][l];
            if constexpr (Shape::followsStretch)
                half *= U[a][l];
            const bool wide = half > widest * (1 + rounding);
            ws.sums.cappedDomains += wide && l < count;
            ws.half[a][l] = half > widest ? widest : half;
        }
        if constexpr (Shape::followsStretch)
            transfer::storeLanes(domain_[a].data() + first, count, ws.half[a]);
    }
}

/// Particles outside the grid, or nowhere, are strays too.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::checkInside(Workspace& ws, const Vectors& x) const
{
    for (int a = 0; a < dim; ++a)
        if (!transfer::allWithin(x[a], state_.grid.origin[a], state_.grid.upper(a)))
            ws.sums.stray = true;
}

/// FLIP: v_p += dt sum N a, and with a PIC rate r, v_p <- (1 - alpha) v_p + alpha sum N v*, alpha = 1 - exp(-r dt).
/// Other transfers: v_p = sum N v*, XPIC and FMPM with v* filtered. New positions x + dt sum N v* go to ws.xNew and to
/// next_.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::advanceVelocity(Workspace& ws, Index first, int count, double dt, const Pass& pass)
{
    auto& p = state_.particles;
    if (pass.blends)
        blendVelocity(ws, dt, pass);
    else
        for (int a = 0; a < dim; ++a)
            for (int l = 0; l < lanes; ++l)
            {
                ws.v[a][l] += kick_ * ws.value.a[a][l];
                ws.xNew[a][l] = ws.x[a][l] + dt * ws.value.v[a][l];
            }
    for (int a = 0; a < dim; ++a)
    {
        transfer::storeLanes(p.v[a].data() + first, count, ws.v[a]);
        transfer::storeLanes(next_[a].data() + first, count, ws.xNew[a]);
    }
    auto& sums = ws.laneSums;
    for (int g = 0; g < lanes; g += 8)
    {
        const Record mass = load(ws.mass + g);
        Record square{};
        for (int a = 0; a < dim; ++a)
        {
            const Record v = load(ws.v[a] + g);
            square += v * v;
            sums.momentum[a] += mass * v;
        }
        sums.kinetic += 0.5 * mass * square;
        sums.fastest = largerOf(square, sums.fastest);
    }
    if (scene_.bodyForce)
    {
        alignas(64) double b[3][lanes];
        scene_.bodyForce->acceleration(p, first, count, state_.time, b);
        for (int a = 0; a < dim; ++a)
            for (int l = 0; l < count; ++l)
            {
                const double end = kick_ * ws.mass[l] * b[a][l] * ws.value.v[a][l];
                ws.sums.bodyForceEnd += end;
                ws.sums.bodyForceWork += end - 0.5 * kick_ * kick_ * ws.mass[l] * b[a][l] * ws.value.a[a][l];
            }
    }
}

} // namespace mpm::stepping

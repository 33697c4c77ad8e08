// What effects add to a pass over a chunk. None of it runs, or is asked for chunk by chunk, where a scene has none of
// them (tests/effects/instructions.py).
#pragma once
#include "stepping/explicitStepper.hpp"

#include <cmath>

namespace mpm::stepping
{
/// What the scene adds to a pass, asked once: chunks are many.
template <int dim, class Shape>
auto ExplicitStepper<dim, Shape>::completed(Pass pass) const -> Pass
{
    pass.prepares = pass.pressure || pass.gradient || pass.relaxes() || pass.filter;
    pass.gathers = pass.gradient || (pass.strain && !averages());
    pass.filtered = filters() && pass.velocity;
    pass.byStrainVelocity = scene_.moveByStrainVelocity && pass.strain && pass.moves;
    pass.affine = affine();
    pass.replaces = scene_.transfer != Transfer::FLIP && !scene_.filterRate;
    pass.alpha = shareOfGridVelocity();
    pass.blends = pass.replaces || pass.alpha > 0;
    pass.addsStress = conjugate() || viscous() || bulkViscous();
    pass.addsForce = affine() || scene_.bodyForce;
    return pass;
}

/// Passes whose results others need: filters of velocity, means over cells, rounds of a relaxation.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::prepareOverChunk(Workspace& ws, const state::Tile& tile, Index first, int count,
                                                   const Pass& pass)
{
    auto& p = state_.particles;
    const auto prefetch = [&] { ws.ahead.some(); };
    for (int a = 0; a < dim; ++a)
        transfer::loadLanes(p.x[a].data() + first, count, ws.x[a]);
    if (!pass.gradient && !pass.pressure)
        transfer::loadLanesOrZero(p.mass.data() + first, count, ws.mass);
    loadDomains(ws, first, count);
    if (pass.pressure)
        return addPressure(ws, tile, first, count);
    withWeights(ws, ws.x, [&](auto& w) {
        w.locate(tile.window);
        lap(ws, &PassTimes::weights);
        if (pass.relaxes())
            return relaxationRound(ws, w, tile, first, count, pass.round);
        if (pass.filter)
        {
            gatherValues(w, ws.filteredValues.data(), tile.window, ws.filtered, prefetch);
            ws.momentum.build(ws.mass, ws.filtered.v);
            projectMomentum(ws, w, tile, ws.x, first, count, false);
            return;
        }
        gatherGradient(w, ws.gradients.data(), tile.window, ws.L, prefetch);
        lap(ws, &PassTimes::toParticles);
    });
    if (pass.gradient)
        addVolumeChange(ws, tile, first, count);
}

/// New positions x + dt w.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::moveByStrainVelocity(Workspace& ws, Index first, int count, double dt)
{
    for (int a = 0; a < dim; ++a)
    {
        for (int l = 0; l < lanes; ++l)
            ws.xNew[a][l] = ws.x[a][l] + dt * ws.value.a[a][l];
        transfer::storeLanes(next_[a].data() + first, count, ws.xNew[a]);
    }
    lap(ws, &PassTimes::toParticles);
}

/// What forces see of stress beside that of the particle.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::addStressOfForces(Workspace& ws, const state::Tile& tile, const Vectors& x,
                                                    Index first, int count, const Pass& pass)
{
    const auto& p = state_.particles;
    if (!pass.strain)
    {
        if (conjugate())
            takeAveragePressure(ws, tile, x);
        if (viscous())
            transfer::loadLanes(p.viscousStress.data() + first, count, ws.viscous);
        if (bulkViscous())
            transfer::loadLanes(p.bulkViscousStress.data() + first, count, ws.bulkViscous);
    }
    const auto add = [&](const double(&pressure)[lanes]) {
        for (int a = 0; a < dim; ++a)
            for (int l = 0; l < lanes; ++l)
                ws.law.stress[a][l] += pressure[l];
    };
    if (bulkViscous())
        add(ws.bulkViscous);
    if (viscous())
        add(ws.viscous);
}

/// What is projected with the forces: affine fields, body forces.
template <int dim, class Shape>
template <class W>
void ExplicitStepper<dim, Shape>::addForces(Workspace& ws, const W& w, const state::Tile& tile, const Vectors& x,
                                            Index first, int count, double dt, const Pass& pass)
{
    if (pass.affine)
        projectAffine<Record>(ws, w, tile, x, first, count);
    if (scene_.bodyForce)
        projectBodyForce(ws, w, tile, first, count, pass.moves ? dt : 0, pass.moves);
}

/// m b at the place and time of the coming step.
template <int dim, class Shape>
template <class W>
void ExplicitStepper<dim, Shape>::projectBodyForce(Workspace& ws, const W& w, const state::Tile& tile, Index first,
                                                   int count, double dt, bool moves)
{
    auto& p = state_.particles;
    alignas(64) double b[3][lanes];
    for (int a = 0; a < dim && moves; ++a) // the old positions are not needed any more
        transfer::storeLanes(p.x[a].data() + first, count, ws.xNew[a]);
    scene_.bodyForce->acceleration(p, first, count, state_.time + dt, b);
    transfer::projectBodyForce<dim>(w, ws.mass, b, count, grid_.template window<Record>(tile), tile.window);
}

/// alpha of a PIC rate, or of a filter that is mixed in at a rate; 0 where there is none in this step.
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::shareOfGridVelocity() const
{
    if (scene_.filterRate)
        return filters() ? -std::expm1(-*scene_.filterRate * double(scene_.filterInterval) * kick_) : 0;
    return scene_.picRate > 0 ? -std::expm1(-scene_.picRate * kick_) : 0;
}

/// Velocities and new positions where the grid's velocity takes part.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::blendVelocity(Workspace& ws, double dt, const Pass& pass) const
{
    for (int a = 0; a < dim; ++a)
    {
        const auto& vGrid = pass.filtered ? ws.filtered.v[a] : ws.value.v[a];
        const auto& moving = pass.replaces ? vGrid : ws.value.v[a];
        for (int l = 0; l < lanes; ++l)
        {
            const double kicked = ws.v[a][l] + kick_ * ws.value.a[a][l];
            ws.v[a][l] = pass.replaces ? vGrid[l] : kicked + pass.alpha * (vGrid[l] - kicked);
            ws.xNew[a][l] = ws.x[a][l] + dt * moving[l];
        }
    }
}
} // namespace mpm::stepping

// Projection of momentum, and the affine field of APIC and TPIC (transfer/affine.hpp), of one chunk.
#pragma once
#include "stepping/explicitStepper.hpp"

namespace mpm::stepping
{
/// Mass and momentum in ws.momentum, and the affine field where particles carry one.
template <int dim, class Shape>
template <class W>
void ExplicitStepper<dim, Shape>::projectMomentum(Workspace& ws, const W& w, const state::Tile& tile, const Vectors& x,
                                                  Index first, int count, bool withAffine)
{
    projectChunk(w, ws.momentum, count, grid_.template window<HalfRecord>(tile), tile.window, [] {});
    if (withAffine)
        projectAffine<HalfRecord>(ws, w, tile, x, first, count);
    lap(ws, &PassTimes::toGrid);
}

template <int dim, class Shape>
template <class Node, class W>
void ExplicitStepper<dim, Shape>::projectAffine(Workspace& ws, const W& w, const state::Tile& tile, const Vectors& x,
                                                Index first, int count)
{
    for (int k = 0; k < dim * dim; ++k)
        transfer::loadLanes(state_.particles.affine[k].data() + first, count, ws.affine[k]);
    transfer::projectAffine<dim>(w, ws.mass, ws.affine, x, state_.grid, count, grid_.template window<Node>(tile),
                                 tile.window);
}

/// C of APIC or TPIC from v*.
template <int dim, class Shape>
template <class W>
void ExplicitStepper<dim, Shape>::advanceAffine(Workspace& ws, const W& w, const state::Tile& tile, Index first,
                                                int count)
{
    if (scene_.transfer == Transfer::TPIC)
        gatherGradient(w, ws.gradients.data(), tile.window, ws.affine, [] {});
    else
        transfer::gatherAffine<dim>(w, ws.gradients.data(), ws.x, state_.grid, count, tile.window, ws.affine);
    for (int k = 0; k < dim * dim; ++k)
        transfer::storeLanes(state_.particles.affine[k].data() + first, count, ws.affine[k]);
}
} // namespace mpm::stepping

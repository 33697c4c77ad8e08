// Passes of treatment/stressRelaxation.hpp.
#pragma once
#include "base/clock.hpp"
#include "smoothing/stressTargets.hpp"
#include "stepping/explicitStepper.hpp"
#include "stepping/lawWork.ipp"

#include <cmath>

namespace mpm::stepping
{
/// T sigma - sigma into the particles' correction.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::correctStress()
{
    const auto target = scene_.treatment.relaxation->target;
    if (target == smoothing::StressTarget::leastSquares)
        return leastSquaresCorrection();
    grid_.openLayer();
    particlePass(0, {.round = Round::project});
    sumStress();
    particlePass(0, {.round = Round::again});
    if (target == smoothing::StressTarget::smoothed)
        return;
    sumStress();
    particlePass(0, {.round = Round::finish});
}

/// Nodal stress (Eq. 11) into the nodes' second layer.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::sumStress()
{
    filterRow([&](nodal::NodeRow<dim>& row, const state::Block& block, Record* out) {
        Record sum[1 << state::TileLayout::bitsOf(dim)] = {};
        sumWindows(row, block, sum);
        for (Index i = row.begin; i < row.end; ++i)
            out[i] = transfer::nodalStress(sum[i - row.begin], smallestMass_);
    });
}

/// smoothed: S sigma - sigma. filtered: with r = sigma - S sigma, T sigma - sigma = S r - r.
template <int dim, class Shape>
template <class W>
void ExplicitStepper<dim, Shape>::relaxationRound(Workspace& ws, const W& w, const state::Tile& tile, Index first,
                                                  int count, Round round)
{
    const auto prefetch = [&] { ws.ahead.some(); };
    auto& stress = ws.law.stress;
    for (int k = 0; k < stressSize<dim>; ++k)
        if (round == Round::finish)
            transfer::loadLanes(correction_[k].data() + first, count, stress[k]);
        else
            transfer::loadLanes(state_.particles.stress[k].data() + first, count, stress[k]);
    if (round != Round::project)
    {
        transfer::gatherStress<dim>(w, ws.stressNodes.data(), tile.window, ws.smooth, prefetch);
        const bool last =
            round == Round::finish || scene_.treatment.relaxation->target == smoothing::StressTarget::smoothed;
        for (int k = 0; k < stressSize<dim>; ++k)
        {
            for (int l = 0; l < lanes; ++l)
                stress[k][l] = last ? ws.smooth[k][l] - stress[k][l] : stress[k][l] - ws.smooth[k][l];
            transfer::storeLanes(correction_[k].data() + first, count, stress[k]);
        }
        lap(ws, &PassTimes::toParticles);
        if (last)
            return;
    }
    ws.stresses.build(ws.mass, stress);
    projectChunk(w, ws.stresses, count, grid_.template window<Record>(tile), tile.window, prefetch);
    lap(ws, &PassTimes::toGrid);
}

/// By the tables of smoothing/, slow: for comparison.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::leastSquaresCorrection()
{
    Clock clock(times_.toGrid);
    const auto& p = state_.particles;
    const auto table = smoothing::weightTable(state_, Shape::word);
    smoothing::StressColumns target;
    smoothing::stressTarget(smoothing::StressTarget::leastSquares, p, table, target);
    for (int k = 0; k < stressSize<dim>; ++k)
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            correction_[k][i] = target[std::size_t(k)][i] - p.stress[k][i];
}

/// ws.law.stress goes part of the way; what the forces did on `strain` with the stress before counts as lost.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::relaxStress(Workspace& ws, Index first, int count, double dt,
                                              const constitutive::StressLanes<dim>& strain)
{
    alignas(64) double flow[lanes], share[lanes], before[lanes], after[lanes], work[lanes], workAfter[lanes];
    elasticEnergy(ws.law, ws.halfOverBulk, ws.quarterOverShear, before);
    workOfStrain<dim>(ws.law.stress, strain, work);
    if (scene_.treatment.followsFlow())
        transfer::loadLanes(state_.particles.flowMemory.data() + first, count, flow);
    else
        std::fill_n(flow, lanes, 1.0);
    for (int l = 0; l < lanes; ++l)
    {
        double square = 0;
        for (int k = 0; k < stressSize<dim>; ++k)
            square += (k < 3 ? 1 : 2) * strain[k][l] * strain[k][l];
        share[l] = treatment::relaxedShare(*scene_.treatment.relaxation, relaxationRate_,
                                           flow[l] * std::sqrt(square) / dt, dt);
    }
    if (hyperelastic())
        forHyperelastic(first, count, [&](const constitutive::Hyperelastic&, auto mine) {
            for (int l = 0; l < lanes; ++l)
                share[l] = mine(l) ? 0 : share[l];
        });
    for (int k = 0; k < stressSize<dim>; ++k)
    {
        transfer::loadLanes(correction_[k].data() + first, count, ws.smooth[k]);
        for (int l = 0; l < lanes; ++l)
            ws.law.stress[k][l] += share[l] * ws.smooth[k][l];
    }
    elasticEnergy(ws.law, ws.halfOverBulk, ws.quarterOverShear, after);
    workOfStrain<dim>(ws.law.stress, strain, workAfter);
    for (int l = 0; l < lanes; ++l)
        before[l] += 0.5 * (work[l] - workAfter[l]) - after[l];
    ws.sums.relaxationLoss += transfer::sumOfProducts(ws.volumeBefore, before);
}
} // namespace mpm::stepping

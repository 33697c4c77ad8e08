// Passes of the remedies for erratic stresses: treatment/{volumetricAveraging,stressRelaxation,tensionGap}.hpp have the
// equations. Absent, they cost nothing.
#pragma once
#include "smoothing/stressTargets.hpp"
#include "stepping/explicitStepper.hpp"
#include "stepping/timeStep.hpp"

#include <cmath>

namespace mpm::stepping
{
/// Columns of the state that belong to the treatment; those of another run's go.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::prepareTreatment()
{
    state_.particles.keepTensionGap(scene_.treatment.tensionGap);
    state_.particles.keepDilationRate(scene_.treatment.averagesElasticPart());
    state_.particles.keepViscousStress(viscous());
    for (const auto& material : scene_.materials)
        if (viscous())
            viscosities_.push_back(scene_.treatment.averaging->viscosity * material.density * state_.grid.h *
                                   material.waveSpeed());
    if (scene_.treatment.relaxation)
        relaxationRate_ = treatment::relaxationRate(*scene_.treatment.relaxation,
                                                    fastestWave(state_, scene_.materials), state_.grid.h);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::sizeTreatment()
{
    if (averages())
    {
        cells_.build(grid_);
        for (auto& column : gradient_)
            column.resize(state_.particles.mass.size());
    }
    if (scene_.treatment.relaxation)
        for (auto& column : correction_)
            column.resize(state_.particles.mass.size());
}

/// Windows a pass reads and writes.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::openTreatment(Workspace& ws, const state::Tile& tile, const Pass& pass)
{
    const auto nodes = std::size_t(grid_.largestWindow());
    if (pass.gradient || pass.pressure)
        grid_.template clearWindow<HalfRecord>(tile);
    if ((pass.strain && averages()) || (pass.then == Project::forces && conjugate()))
    {
        ws.cells.resize(nodes);
        grid_.copyToWindow(tile, cells_.content(), ws.cells.data());
    }
    if (pass.round == Round::again || pass.round == Round::finish)
    {
        ws.stressNodes.resize(nodes);
        grid_.copyToWindow(
            tile, ws.stressNodes.data(), [](const Record& r) { return r; }, filterLayer);
    }
    if (pass.round == Round::project || pass.round == Round::again)
        grid_.template clearWindow<Record>(tile);
}

// Volumetric averaging ------------------------------------------------------------------------------------------------

/// Mean rates of volume change of the cells; L of the particles in columns.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::averageVolumeChange(double dt, int gradientLane)
{
    particlePass(dt, {.gradient = true, .gradientLane = gradientLane});
    sumCells();
    cells_.average(scene_.treatment.averaging->hats());
}

/// Pressures of the cells as forces are to meet them.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::averagePressure()
{
    particlePass(0, {.pressure = true});
    if (stray_)
        return;
    sumCells();
    cells_.averageAdjoint(scene_.treatment.averaging->hats());
}

/// sum V and sum V q of each cell over the windows of tiles.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::sumCells()
{
    Clock clock(times_.nodal);
    forEachRow([&](nodal::NodeRow<dim>& row, const state::Block& block) {
        HalfRecord sum[1 << state::TileLayout::bitsOf(dim)] = {};
        sumWindows(row, block, sum);
        const std::size_t at = block.start + std::size_t(block.box.offset(row.begin, row.j, row.k));
        for (Index i = row.begin; i < row.end; ++i)
        {
            cells_.volume()[at + std::size_t(i - row.begin)] = sum[i - row.begin][0];
            cells_.content()[at + std::size_t(i - row.begin)] = sum[i - row.begin][1];
        }
    });
}

/// Each lane's cell as a place in the window of nodes; false if one of `count` lies outside.
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::locateCells(Workspace& ws, const Vectors& x, const state::NodeBox& box,
                                              int count) const
{
    const double invH = 1 / state_.grid.h;
    std::int32_t stride = 1, outside = 0;
    std::fill_n(ws.cell, lanes, 0);
    for (int a = 0; a < dim; ++a)
    {
        const double origin = state_.grid.origin[a], low = double(box.lo[a]), high = double(box.n[a] - 1);
        for (int l = 0; l < lanes; ++l)
        {
            const double i = std::floor((x[a][l] - origin) * invH) - low;
            const bool inside = i >= 0 && i <= high;
            outside |= !inside && l < count;
            ws.cell[l] += stride * std::int32_t(inside ? i : 0);
        }
        stride *= std::int32_t(box.n[a]);
    }
    return outside == 0;
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::addToCells(Workspace& ws, const state::Tile& tile, Index first, int count,
                                             const double (&value)[lanes])
{
    const double* volume = state_.particles.volume.data() + first;
    auto* cells = reinterpret_cast<double*>(grid_.template window<HalfRecord>(tile));
    for (int l = 0; l < count; ++l)
    {
        double* cell = cells + 4 * ws.cell[l];
        cell[0] += volume[l];
        cell[1] += volume[l] * value[l];
    }
}

/// Keeps ws.L for the strain pass, and adds what is averaged of tr L to the cells.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::addVolumeChange(Workspace& ws, const state::Tile& tile, Index first, int count)
{
    alignas(64) double change[lanes];
    locateCells(ws, ws.x, tile.window, count); // where the nodes are, the cells are too
    for (int k = 0; k < dim * dim; ++k)
        transfer::storeLanes(gradient_[k].data() + first, count, ws.L[k]);
    volumeChange(ws, first, count, change);
    addToCells(ws, tile, first, count, change);
    lap(ws, &PassTimes::toGrid);
}

/// tr L, or what is left of it without the plastic part of the last step.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::volumeChange(Workspace& ws, Index first, int count, double (&change)[lanes]) const
{
    alignas(64) double plastic[lanes];
    const bool elastic = scene_.treatment.averagesElasticPart();
    if (elastic)
        transfer::loadLanes(state_.particles.dilationRate.data() + first, count, plastic);
    for (int l = 0; l < lanes; ++l)
    {
        double trace = ws.L[0][l];
        for (int a = 1; a < dim; ++a)
            trace += ws.L[a * dim + a][l];
        change[l] = elastic ? trace - plastic[l] : trace;
    }
}

/// L <- L + (mean - own) I/d.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::takeAverage(Workspace& ws, const state::Tile& tile, Index first, int count)
{
    alignas(64) double own[lanes];
    locateCells(ws, ws.x, tile.window, count);
    volumeChange(ws, first, count, own);
    for (int l = 0; l < lanes; ++l)
        ws.spread[l] = (ws.cells[std::size_t(ws.cell[l])] - own[l]) * (1.0 / dim);
    for (int a = 0; a < dim; ++a)
        for (int l = 0; l < lanes; ++l)
            ws.L[a * dim + a][l] += ws.spread[l];
}

/// work, sigma : e of the forces, becomes that of the strain after the average; half of the difference is lost at either
/// end of the step.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::loseToAverage(Workspace& ws, double dt, const double (&volume)[lanes],
                                                double (&work)[lanes])
{
    alignas(64) double lost[lanes];
    for (int l = 0; l < lanes; ++l)
    {
        double normal = 0;
        for (int a = 0; a < dim; ++a)
            normal += ws.law.stress[a][l];
        lost[l] = -0.5 * dt * ws.spread[l] * normal;
        work[l] += dt * ws.spread[l] * normal;
    }
    ws.sums.averagingLoss += transfer::sumOfProducts(volume, lost);
}

/// eta of each lane's material.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::loadViscosity(Workspace& ws, Index first, int count) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    for (int l = 0; l < lanes; ++l)
        ws.viscosity[l] = viscosities_[std::size_t(material[l < count ? l : 0])];
}

/// sum V q tr e.
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::viscousWork(Workspace& ws, const constitutive::StressLanes<dim>& strain,
                                                const double (&volume)[lanes]) const
{
    alignas(64) double work[lanes];
    for (int l = 0; l < lanes; ++l)
    {
        double trace = 0;
        for (int a = 0; a < dim; ++a)
            trace += strain[a][l];
        work[l] = ws.viscous[l] * trace;
    }
    return transfer::sumOfProducts(volume, work);
}

/// Adds the mean of the d normal stresses to the cells.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::addPressure(Workspace& ws, const state::Tile& tile, Index first, int count)
{
    const auto& p = state_.particles;
    if (!locateCells(ws, ws.x, tile.window, count))
    {
        ws.sums.stray = true;
        return;
    }
    alignas(64) double mean[lanes] = {};
    for (int a = 0; a < dim; ++a)
    {
        transfer::loadLanes(p.stress[a].data() + first, count, ws.law.stress[a]);
        for (int l = 0; l < lanes; ++l)
            mean[l] += ws.law.stress[a][l] * (1.0 / dim);
    }
    addToCells(ws, tile, first, count, mean);
}

/// ws.law.stress <- sigma + (A* s - s) I.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::takeAveragePressure(Workspace& ws, const state::Tile& tile, const Vectors& x)
{
    locateCells(ws, x, tile.window, 0); // strays have called for a sort before
    for (int l = 0; l < lanes; ++l)
    {
        double mean = 0;
        for (int a = 0; a < dim; ++a)
            mean += ws.law.stress[a][l] * (1.0 / dim);
        const double spread = ws.cells[std::size_t(ws.cell[l])] - mean;
        for (int a = 0; a < dim; ++a)
            ws.law.stress[a][l] += spread;
    }
}

// Stress relaxation ---------------------------------------------------------------------------------------------------

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
    alignas(64) double share[lanes], before[lanes], after[lanes], work[lanes], workAfter[lanes];
    elasticEnergy(ws.law, ws.halfOverBulk, ws.quarterOverShear, before);
    workOfStrain<dim>(ws.law.stress, strain, work);
    for (int l = 0; l < lanes; ++l)
    {
        double square = 0;
        for (int k = 0; k < stressSize<dim>; ++k)
            square += (k < 3 ? 1 : 2) * strain[k][l] * strain[k][l];
        share[l] = treatment::relaxedShare(*scene_.treatment.relaxation, relaxationRate_, std::sqrt(square) / dt, dt);
    }
    if (anyHyperelastic_)
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

// Around the law ------------------------------------------------------------------------------------------------------

/// The laws with tension gaps, and the plastic volume change they leave.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::callTreatedLaws(Workspace& ws, Index first, int count, double dt)
{
    auto& p = state_.particles;
    auto& chunk = ws.law;
    alignas(64) double mean[lanes];
    for (int l = 0; l < lanes; ++l)
        mean[l] = treatment::meanStress(chunk, l);
    bool open = false;
    if (scene_.treatment.tensionGap)
    {
        transfer::loadLanes(p.tensionGap.data() + first, count, ws.gap.gap);
        open = !transfer::allWithin(ws.gap.gap, 0, 0);
        treatment::openGap(chunk, ws.gap, open);
    }
    callLaws(first, count, chunk);
    if (scene_.treatment.tensionGap && (open || chunk.apexReturns > 0))
    {
        treatment::closeGap(chunk, ws.gap);
        transfer::storeLanes(p.tensionGap.data() + first, count, ws.gap.gap);
        ws.sums.gapWork += transfer::sumOfProducts(ws.volumeMiddle, ws.gap.work);
    }
    if (scene_.treatment.averagesElasticPart())
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double trace = chunk.dStrain[0][l] + chunk.dStrain[1][l] + chunk.dStrain[2][l];
            const double elastic = (treatment::meanStress(chunk, l) - mean[l]) * 2 * ws.halfOverBulk[l];
            mean[l] = (trace - elastic) / dt;
        }
        if (anyHyperelastic_)
            forHyperelastic(first, count, [&](const constitutive::Hyperelastic&, auto mine) {
                for (int l = 0; l < lanes; ++l)
                    mean[l] = mine(l) ? 0 : mean[l];
            });
        transfer::storeLanes(p.dilationRate.data() + first, count, mean);
    }
}
} // namespace mpm::stepping

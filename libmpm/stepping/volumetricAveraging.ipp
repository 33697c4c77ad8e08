// Passes of treatment/volumetricAveraging.hpp.
#pragma once
#include "base/clock.hpp"
#include "stepping/explicitStepper.hpp"

#include <cmath>

namespace mpm::stepping
{
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
    cells_.average(scene_.treatment.averaging->hats());
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

/// work, sigma : e of the forces, becomes that of the strain after the average; half of the difference is lost at
/// either end of the step.
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

/// eta of each lane's material; where relaxation follows flow, so does the viscosity.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::loadViscosity(Workspace& ws, Index first, int count) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    for (int l = 0; l < lanes; ++l)
        ws.viscosity[l] = viscosities_[std::size_t(material[l < count ? l : 0])];
    if (!scene_.treatment.followsFlow())
        return;
    alignas(64) double flow[lanes];
    transfer::loadLanes(state_.particles.flowMemory.data() + first, count, flow);
    for (int l = 0; l < lanes; ++l)
        ws.viscosity[l] *= flow[l];
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
} // namespace mpm::stepping

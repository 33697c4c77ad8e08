// What the remedies for erratic stresses share: treatment/{volumetricAveraging,stressRelaxation,tensionGap}.hpp have
// the equations. Absent, they cost nothing.
#pragma once
#include "stepping/lawWork.ipp"
#include "stepping/stressRelaxation.ipp"
#include "stepping/timeStep.hpp"
#include "stepping/volumetricAveraging.ipp"

#include <cmath>

namespace mpm::stepping
{
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::relaxes() const
{
    return scene_.treatment.relaxation && state_.step % scene_.treatment.relaxation->interval == 0;
}

/// Columns of the state that belong to the treatment; those of another run's go.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::prepareTreatment()
{
    treated_ = scene_.treatment.any() || scene_.bulkViscosity;
    state_.particles.keep(&state::Particles::tensionGap, scene_.treatment.tensionGap);
    state_.particles.keep(&state::Particles::dilationRate, scene_.treatment.averagesElasticPart());
    state_.particles.keep(&state::Particles::flowMemory, scene_.treatment.followsFlow());
    state_.particles.keep(&state::Particles::viscousStress, viscous());
    prepareBulkViscosity();
    for (const auto& material : scene_.materials)
        if (viscous())
            viscosities_.push_back(scene_.treatment.averaging->viscosity * material.density * state_.grid.h *
                                   material.waveSpeed());
    if (const auto& relaxation = scene_.treatment.relaxation)
    {
        const double fastest = fastestWave(state_, scene_.materials);
        relaxationRate_ = treatment::relaxationRate(*relaxation, fastest, state_.grid.h);
        flowMemory_ = treatment::flowMemory(*relaxation, fastest, state_.grid.h);
    }
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

/// The velocity gradients a pass of its own has left, as an average changes them for forces and strains alike.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::takeAveragedGradient(Workspace& ws, const state::Tile& tile, Index first, int count)
{
    if (averages())
        for (int k = 0; k < dim * dim; ++k)
            transfer::loadLanes(gradient_[k].data() + first, count, ws.L[k]);
    if (conjugate())
        takeAverage(ws, tile, first, count);
}

/// What is done before the law: work of viscosities, relaxation, averages of the strain alone.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::treatBefore(Workspace& ws, const state::Tile& tile, Index first, int count, double dt,
                                              const constitutive::StressLanes<dim>& strainOfForces,
                                              double (&trace)[lanes], double (&workOfForces)[lanes])
{
    auto& p = state_.particles;
    auto& sums = ws.sums;
    if (viscous() || bulkViscous())
        traceOfForces(ws, dt, strainOfForces, trace);
    if (viscous())
    {
        transfer::loadLanes(p.viscousStress.data() + first, count, ws.viscous);
        const double work = viscousWork(ws.viscous, trace, ws.volumeBefore);
        sums.strainWorkBefore += work;
        sums.viscosityLoss += 0.5 * work;
    }
    if (bulkViscous())
    {
        transfer::loadLanes(p.bulkViscousStress.data() + first, count, ws.bulkViscous);
        const double work = viscousWork(ws.bulkViscous, trace, ws.volumeBefore);
        sums.strainWorkBefore += work;
        sums.bulkViscosityLoss += 0.5 * work;
    }
    if (relaxes())
    {
        relaxStress(ws, first, count, dt, strainOfForces);
        workOfStrain<dim>(ws.law.stress, strainOfForces, workOfForces);
    }
    if (averages() && !conjugate())
    {
        takeAverage(ws, tile, first, count);
        loseToAverage(ws, dt, ws.volumeBefore, workOfForces);
    }
}

/// What is done after the law: viscosities of the next forces, what averages lost.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::treatAfter(Workspace& ws, Index first, int count, double dt,
                                             const double (&trace)[lanes], double (&workOfForcesAfter)[lanes])
{
    auto& sums = ws.sums;
    if (viscous())
    {
        loadViscosity(ws, first, count);
        for (int l = 0; l < lanes; ++l)
            ws.viscous[l] = -dim * ws.viscosity[l] * ws.spread[l];
        transfer::storeLanes(state_.particles.viscousStress.data() + first, count, ws.viscous);
        const double work = viscousWork(ws.viscous, trace, ws.volume);
        sums.strainWork += work;
        sums.viscosityLoss += 0.5 * work;
    }
    if (bulkViscous())
    {
        renewBulkViscosity(ws, first, count, dt, trace);
        const double work = viscousWork(ws.bulkViscous, trace, ws.volume);
        sums.strainWork += work;
        sums.bulkViscosityLoss += 0.5 * work;
    }
    if (averages() && !conjugate())
        loseToAverage(ws, dt, ws.volume, workOfForcesAfter);
}

/// The laws with histories and tension gaps; what they leave of plastic volume change, and that they yielded.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::callTreatedLaws(Workspace& ws, Index first, int count, double dt, bool oneMaterial)
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
    if (hasHistory())
        transfer::loadLanes(p.plasticStrain.data() + first, count, chunk.plasticStrain);
    callLaws(first, count, chunk, oneMaterial);
    if (hasHistory())
        transfer::storeLanes(p.plasticStrain.data() + first, count, chunk.plasticStrain);
    if (scene_.treatment.tensionGap && (open || chunk.apexReturns > 0))
    {
        treatment::closeGap(chunk, ws.gap);
        transfer::storeLanes(p.tensionGap.data() + first, count, ws.gap.gap);
        ws.sums.gapWork += 0.5 * (transfer::sumOfProducts(ws.volumeBefore, ws.gap.work) +
                                  transfer::sumOfProducts(ws.volume, ws.gap.work));
    }
    if (scene_.treatment.followsFlow())
    {
        alignas(64) double flow[lanes];
        const double fade = std::exp(-dt / flowMemory_);
        transfer::loadLanes(p.flowMemory.data() + first, count, flow);
        for (int l = 0; l < lanes; ++l)
            flow[l] = chunk.region[l] != constitutive::Region::elastic ? 1 : fade * flow[l];
        transfer::storeLanes(p.flowMemory.data() + first, count, flow);
    }
    if (scene_.treatment.averagesElasticPart())
    {
        for (int l = 0; l < lanes; ++l)
        {
            const double trace = chunk.dStrain[0][l] + chunk.dStrain[1][l] + chunk.dStrain[2][l];
            const double elastic = (treatment::meanStress(chunk, l) - mean[l]) * 2 * ws.halfOverBulk[l];
            mean[l] = (trace - elastic) / dt;
        }
        if (hyperelastic())
            forHyperelastic(first, count, [&](const constitutive::Hyperelastic&, auto mine) {
                for (int l = 0; l < lanes; ++l)
                    mean[l] = mine(l) ? 0 : mean[l];
            });
        transfer::storeLanes(p.dilationRate.data() + first, count, mean);
    }
}
} // namespace mpm::stepping

// What ExplicitStepper does to one chunk between its velocity gradient and its stress: deformation, the law, and the
// sums of the energy budget (energyBudget.hpp).
#pragma once
#include "stepping/explicitStepper.hpp"

#include <algorithm>
#include <limits>

namespace mpm::stepping
{
/// sigma : dEps in every lane.
template <int dim>
void workOfStrain(const constitutive::StressLanes<dim>& stress, const constitutive::StressLanes<dim>& dStrain,
                  double (&density)[lanes])
{
    for (int l = 0; l < lanes; ++l)
        density[l] = stress[0][l] * dStrain[0][l];
    for (int k = 1; k < stressSize<dim>; ++k)
        for (int l = 0; l < lanes; ++l)
            density[l] += (k < 3 ? 1 : 2) * stress[k][l] * dStrain[k][l];
}

/// Elastic energy density 1/2 sigma : C^-1 : sigma = p^2/(2 K) + s : s/(4 G) in every lane, from 1/(2 K) and 1/(4 G).
template <int dim>
void elasticEnergy(const constitutive::Chunk<dim>& chunk, const double (&halfOverBulk)[lanes],
                   const double (&quarterOverShear)[lanes], double (&energy)[lanes])
{
    const auto& sigma = chunk.stress;
    for (int l = 0; l < lanes; ++l)
    {
        const double p = (sigma[0][l] + sigma[1][l] + sigma[2][l]) * (1.0 / 3);
        double ss = 0;
        for (int k = 0; k < 3; ++k)
            ss += (sigma[k][l] - p) * (sigma[k][l] - p);
        for (int k = 3; k < stressSize<dim>; ++k)
            ss += 2 * sigma[k][l] * sigma[k][l];
        energy[l] = p * p * halfOverBulk[l] + ss * quarterOverShear[l];
    }
}

/// body(law, mine) for each hyperelastic law in a chunk; mine(lane): is the lane of it?
template <int dim, class Shape>
template <class Body>
void ExplicitStepper<dim, Shape>::forHyperelastic(Index first, int count, Body&& body) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    const auto [low, high] = std::minmax_element(material, material + count);
    for (std::int32_t m = *low; m <= *high; ++m)
        if (const auto* law = scene_.materials[std::size_t(m)].law->hyperelastic())
            if (std::find(material, material + count, m) != material + count)
                body(*law, [=](int lane) { return lane < count && material[lane] == m; });
}

/// W(F) of hyperelastic lanes.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::storedEnergy(const Workspace& ws, Index first, int count,
                                               double (&stored)[lanes]) const
{
    forHyperelastic(first, count, [&](const constitutive::Hyperelastic& law, auto mine) {
        alignas(64) double own[lanes];
        law.strainEnergy(ws.F, own);
        for (int l = 0; l < lanes; ++l)
            if (mine(l))
                stored[l] = own[l];
    });
}

/// F, V and stress from the velocity gradient.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::updateStress(Workspace& ws, const state::Tile& tile, Index first, int count,
                                               double dt)
{
    auto& p = state_.particles;
    auto& sums = ws.sums;
    auto& chunk = ws.law;
    chunk.count = count;
    for (int k = 0; k < dim * dim; ++k)
        transfer::loadLanes(p.F[k].data() + first, count, ws.F[k]);
    for (int k = 0; k < stressSize<dim>; ++k)
        transfer::loadLanes(p.stress[k].data() + first, count, chunk.stress[k]);
    transfer::loadLanesOrZero(p.volume.data() + first, count, ws.volumeBefore);
    loadModuli(ws, first, count);
    // What the grid's forces do work on is L as it is; what the law sees is L over the mid-step configuration.
    alignas(64) double workOfForces[lanes], workOfForcesAfter[lanes];
    constitutive::StressLanes<dim> strainOfForces;
    if (treated())
        takeAveragedGradient(ws, tile, first, count);
    constitutive::strainIncrement(ws.L, dt, strainOfForces);
    workOfStrain<dim>(chunk.stress, strainOfForces, workOfForces);
    sums.strainWorkBefore += transfer::sumOfProducts(ws.volumeBefore, workOfForces);
    alignas(64) double trace[lanes]; // of the strain forces work on, where a viscosity asks
    if (treated())
        treatBefore(ws, tile, first, count, dt, strainOfForces, trace, workOfForces);
    constitutive::toMidStep(scene_.stressUpdate == StressUpdate::USF ? constitutive::TakenOver::end
                                                                     : constitutive::TakenOver::start,
                            dt, ws.L);
    constitutive::strainIncrement(ws.L, dt, chunk.dStrain);
    alignas(64) double energyBefore[lanes], energy[lanes], workTurned[lanes], workAfter[lanes];
    elasticEnergy(chunk, ws.halfOverBulk, ws.quarterOverShear, energyBefore);
    ws.ahead.some(4);
    if (hyperelastic())
        storedEnergy(ws, first, count, ws.storedBefore);
    constitutive::advanceDeformation(ws.L, dt, ws.F);
    ws.ahead.some(4);
    constitutive::determinant(ws.F, ws.J);
    constitutive::rotateStress(ws.L, dt, chunk.stress);
    constitutive::rotateStress(ws.L, 0.5 * dt, chunk.dStrain); // from the middle of the step to its end
    ws.ahead.some(5);
    workOfStrain<dim>(chunk.stress, chunk.dStrain, workTurned);
    chunk.F = &ws.F;
    chunk.L = &ws.L;
    chunk.dt = dt;
    transfer::loadLanesOrZero(p.volume0.data() + first, count, ws.volume);
    for (int l = 0; l < lanes; ++l)
    {
        ws.volume[l] *= ws.J[l];
        ws.volumeMiddle[l] = 0.5 * (ws.volumeBefore[l] + ws.volume[l]);
    }
    if (treated() || hasHistory())
        callTreatedLaws(ws, first, count, dt);
    else
        callLaws(first, count, chunk);
    ws.ahead.some(5);

    constexpr double none = std::numeric_limits<double>::min(), immense = 1e30;
    if (!transfer::allWithin(ws.J, none, immense) && sums.badParticle < 0)
        for (int l = 0; l < count; ++l)
            if (!(ws.J[l] >= none && ws.J[l] <= immense))
            {
                sums.badParticle = first + l;
                break;
            }
    sums.smallestJacobian = std::min(sums.smallestJacobian, transfer::smallest(ws.J));
    if (splitsNext())
        sums.longEdges = sums.longEdges || longEdges(ws, first, count);
    transfer::storeLanes(p.volume.data() + first, count, ws.volume);
    for (int k = 0; k < dim * dim; ++k)
        transfer::storeLanes(p.F[k].data() + first, count, ws.F[k]);
    for (int k = 0; k < stressSize<dim>; ++k)
        transfer::storeLanes(p.stress[k].data() + first, count, chunk.stress[k]);

    if (hyperelastic() || plastic())
        findStiffest(ws, first, count);
    else
        sums.largestJacobian = std::max(sums.largestJacobian, transfer::largest(ws.J));
    workOfStrain<dim>(chunk.stress, chunk.dStrain, workAfter);
    workOfStrain<dim>(chunk.stress, strainOfForces, workOfForcesAfter);
    sums.strainWork += transfer::sumOfProducts(ws.volume, workOfForcesAfter);
    if (treated())
        treatAfter(ws, first, count, dt, trace, workOfForcesAfter);
    elasticEnergy(chunk, ws.halfOverBulk, ws.quarterOverShear, energy);
    if (hyperelastic())
    {
        storedEnergy(ws, first, count, ws.stored); // of F as it is stored
        forHyperelastic(first, count, [&](const constitutive::Hyperelastic&, auto mine) {
            for (int l = 0; l < lanes; ++l)
                if (mine(l))
                    energy[l] = ws.stored[l] / ws.J[l];
        });
    }
    sums.strainEnergy += transfer::sumOfProducts(ws.volume, energy);
    for (int l = 0; l < lanes; ++l)
    {
        const double grown = ws.volume[l] - ws.volumeBefore[l];
        energyBefore[l] = 0.5 * (energyBefore[l] + energy[l]) * grown +
                          0.25 * (ws.volumeBefore[l] + ws.volume[l]) * (workTurned[l] + workAfter[l]) -
                          0.5 * (ws.volumeBefore[l] * workOfForces[l] + ws.volume[l] * workOfForcesAfter[l]);
    }
    if (hyperelastic())
        forHyperelastic(first, count, [&](const constitutive::Hyperelastic&, auto mine) {
            for (int l = 0; l < lanes; ++l)
                if (mine(l))
                    energyBefore[l] =
                        ws.volume[l] / ws.J[l] * (ws.stored[l] - ws.storedBefore[l]) -
                        0.5 * (ws.volumeBefore[l] * workOfForces[l] + ws.volume[l] * workOfForcesAfter[l]);
        });
    sums.finiteStrainWork += transfer::sumOfLanes(energyBefore);
    if (plastic())
    {
        sums.plasticWork += transfer::sumOfProducts(ws.volumeMiddle, chunk.plasticWork);
        sums.apexVolume += transfer::sumOfProducts(ws.volume, chunk.apexStrain);
        sums.apexReturns += chunk.apexReturns;
        sums.maxYield = std::max(sums.maxYield, transfer::largest(chunk.yield));
    }
    if constexpr (Shape::followsStretch || hasCorners)
        updateDomains(ws, first, count);
}

/// May a particle have to be split (splitting/splitParticles.hpp)? Looks with some room, for the rounding of what is
/// stored; the look itself decides.
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::longEdges(Workspace& ws, Index first, int count) const
{
    alignas(64) double over[lanes] = {}, length[lanes];
    for (int k = 0; k < dim; ++k)
    {
        const double longest = scene_.splitting->threshold * state_.seedSpacing[std::size_t(k)];
        const double allowed = (1 - 1e-6) * longest * longest;
        transfer::loadLanes(state_.particles.length0[std::size_t(k)].data() + first, count, length);
        for (int l = 0; l < lanes; ++l)
        {
            double square = 0;
            for (int a = 0; a < dim; ++a)
                square += ws.F[a * dim + k][l] * ws.F[a * dim + k][l];
            const double beyond = square * length[l] * length[l] - allowed;
            over[l] = beyond > over[l] ? beyond : over[l];
        }
    }
    return transfer::largest(over) > 0;
}

/// For the wave speed: det F of what carries stress, and waveFactor of hyperelastic laws.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::findStiffest(Workspace& ws, Index first, int count) const
{
    alignas(64) double stiffJ[lanes];
    for (int l = 0; l < lanes; ++l)
        stiffJ[l] = ws.law.region[l] == constitutive::Region::apex ? 1 : ws.J[l];
    forHyperelastic(first, count, [&](const constitutive::Hyperelastic& law, auto mine) {
        alignas(64) double own[lanes];
        law.waveFactor(ws.F, own);
        for (int l = 0; l < lanes; ++l)
            if (mine(l))
                stiffJ[l] = own[l];
    });
    ws.sums.largestJacobian = std::max(ws.sums.largestJacobian, transfer::largest(stiffJ));
}

/// 1/(2 K) and 1/(4 G) of each lane's material.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::loadModuli(Workspace& ws, Index first, int count) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    std::fill_n(ws.halfOverBulk, lanes, moduli_[std::size_t(material[0])][0]);
    std::fill_n(ws.quarterOverShear, lanes, moduli_[std::size_t(material[0])][1]);
    for (int l = 1; l < count; ++l)
        if (material[l] != material[0])
        {
            ws.halfOverBulk[l] = moduli_[std::size_t(material[l])][0];
            ws.quarterOverShear[l] = moduli_[std::size_t(material[l])][1];
        }
}

/// One call for a chunk of one material; in a mixed chunk each law works on a copy and its own lanes are kept.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::callLaws(Index first, int count, constitutive::Chunk<dim>& chunk) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    std::int32_t different = 0;
    for (int l = 0; l < count; ++l)
        different |= material[l] ^ material[0];
    if (different == 0)
    {
        scene_.materials[std::size_t(material[0])].law->update(chunk);
        return;
    }
    const auto [low, high] = std::minmax_element(material, material + count);
    const constitutive::Chunk<dim> before = chunk; // lanes of laws without history keep theirs, zero
    for (std::int32_t m = *low; m <= *high; ++m)
    {
        if (std::find(material, material + count, m) == material + count)
            continue;
        constitutive::Chunk<dim> own = before;
        scene_.materials[std::size_t(m)].law->update(own);
        for (int l = 0; l < count; ++l)
            if (material[l] == m)
            {
                for (int k = 0; k < stressSize<dim>; ++k)
                    chunk.stress[k][l] = own.stress[k][l];
                chunk.plasticStrain[l] = own.plasticStrain[l];
                chunk.plasticWork[l] = own.plasticWork[l];
                chunk.apexStrain[l] = own.apexStrain[l];
                chunk.yield[l] = own.yield[l];
                chunk.region[l] = own.region[l];
            }
    }
    chunk.apexReturns = int(std::count(chunk.region, chunk.region + count, constitutive::Region::apex));
}
} // namespace mpm::stepping

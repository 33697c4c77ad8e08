// What ExplicitStepper does to one chunk between its velocity gradient and its stress: deformation, the law, and the
// sums of the energy budget (energyBudget.hpp). What all scenes do is in strainSweep.hpp.
#pragma once
#include "constitutive/motion.hpp"
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
    {
        double sigma[stressSize<dim>], e[stressSize<dim>];
        for (int k = 0; k < stressSize<dim>; ++k)
        {
            sigma[k] = stress[k][l];
            e[k] = dStrain[k][l];
        }
        density[l] = constitutive::work(sigma, e);
    }
}

/// Elastic energy density in every lane.
template <int dim>
void elasticEnergy(const constitutive::Chunk<dim>& chunk, const double (&halfOverBulk)[lanes],
                   const double (&quarterOverShear)[lanes], double (&energy)[lanes])
{
    for (int l = 0; l < lanes; ++l)
    {
        double sigma[stressSize<dim>];
        for (int k = 0; k < stressSize<dim>; ++k)
            sigma[k] = chunk.stress[k][l];
        energy[l] = constitutive::elasticEnergy(sigma, halfOverBulk[l], quarterOverShear[l]);
    }
}

/// body(law, mine) for each hyperelastic law in a chunk; mine(lane): is the lane of it, or a copy of one that is?
template <int dim, class Shape>
template <class Body>
void ExplicitStepper<dim, Shape>::forHyperelastic(Index first, int count, Body&& body) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    const auto [low, high] = std::minmax_element(material, material + count);
    for (std::int32_t m = *low; m <= *high; ++m)
        if (const auto* law = scene_.materials[std::size_t(m)].law->hyperelastic())
            if (std::find(material, material + count, m) != material + count)
                body(*law, [=](int lane) { return material[std::min(lane, count - 1)] == m; });
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

/// The chunk's columns for the sweeps (lanesInPlace).
template <int dim, class Shape>
StrainColumns<dim> ExplicitStepper<dim, Shape>::openColumns(Workspace& ws, Index first, int count)
{
    auto& p = state_.particles;
    StrainColumns<dim> columns;
    for (int k = 0; k < dim * dim; ++k)
        columns.F[k] = transfer::lanesInPlace(p.F[k].data() + first, count, ws.F[k]);
    for (int k = 0; k < stressSize<dim>; ++k)
        columns.stress[k] = transfer::lanesInPlace(p.stress[k].data() + first, count, ws.law.stress[k]);
    columns.volume = p.volume.data() + first;
    columns.volume0 = p.volume0.data() + first;
    if (count < lanes) // zero beyond
    {
        transfer::loadLanesOrZero(p.volume.data() + first, count, ws.volume);
        transfer::loadLanesOrZero(p.volume0.data() + first, count, ws.volume0);
        columns.volume = ws.volume;
        columns.volume0 = ws.volume0;
    }
    return columns;
}

/// F, V and stress from the velocity gradient.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::updateStress(Workspace& ws, const state::Tile& tile, Index first, int count,
                                               double dt)
{
    auto& chunk = ws.law;
    chunk.count = count;
    const StrainColumns<dim> columns = openColumns(ws, first, count);
    const StrainStep step{scene_.stressUpdate == StressUpdate::USF ? constitutive::TakenOver::end
                                                                   : constitutive::TakenOver::start,
                          dt, treated(), treated() || hyperelastic(), plastic()};
    const bool oneMaterial = loadModuli(ws, first, count);
    alignas(64) double trace[lanes]; // of the strain forces work on, where a viscosity asks
    if (treated())
        prepareTreated(ws, tile, first, count, dt, columns, trace);
    const auto copyOfF = [&] {
        for (int k = 0; k < dim * dim; ++k)
            if (columns.F[k] != ws.F[k])
                std::copy_n(columns.F[k], lanes, ws.F[k]);
    };
    if (hyperelastic())
    {
        copyOfF();
        storedEnergy(ws, first, count, ws.storedBefore);
    }
    strainSweep<dim>(ws, columns, step, ws.ahead);
    if (hyperelastic() || Shape::followsStretch || hasCorners || splitsNext())
        copyOfF();
    chunk.F = &ws.F;
    chunk.L = &ws.L;
    chunk.dt = dt;
    if (treated() || hasHistory())
        callTreatedLaws(ws, first, count, dt, oneMaterial);
    else
        callLaws(first, count, chunk, oneMaterial);
    ws.ahead.some(5);
    putBack(ws, first, count);
    if (!ws.inRange)
        findBadParticle(ws, first, count);
    if (splitsNext())
        ws.sums.longEdges = ws.sums.longEdges || longEdges(ws, first, count);
    bookSweep<dim>(ws, columns, step);
    findStiffest(ws, first, count);
    if (step.keeps)
        bookKept(ws, first, count, dt, trace);
    ws.sums.apexReturns += plastic() ? chunk.apexReturns : 0;
    if constexpr (Shape::followsStretch || hasCorners)
        updateDomains(ws, first, count);
}

/// Copies of columns go back, the stress as the law has left it: floats are rounded before their work is booked.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::putBack(Workspace& ws, Index first, int count)
{
    constexpr bool inPlace = std::is_same_v<state::Stored, double>;
    if (inPlace && count == lanes)
        return;
    auto& p = state_.particles;
    for (int k = 0; k < dim * dim; ++k)
        transfer::storeLanes(p.F[k].data() + first, count, ws.F[k]);
    for (int k = 0; k < stressSize<dim>; ++k)
        transfer::storeLanes(p.stress[k].data() + first, count, ws.law.stress[k]);
    transfer::storeLanes(p.volume.data() + first, count, ws.volume);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::findBadParticle(Workspace& ws, Index first, int count) const
{
    for (int l = 0; l < count && ws.sums.badParticle < 0; ++l)
        if (!(ws.J[l] >= smallestVolumeRatio && ws.J[l] <= largestVolumeRatio))
            ws.sums.badParticle = first + l;
}

/// The work that treatments start from: sigma : dt sym L of the averaged velocity gradient.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::prepareTreated(Workspace& ws, const state::Tile& tile, Index first, int count,
                                                 double dt, const StrainColumns<dim>& columns, double (&trace)[lanes])
{
    for (int k = 0; k < stressSize<dim>; ++k)
        if (columns.stress[k] != ws.law.stress[k])
            std::copy_n(columns.stress[k], lanes, ws.law.stress[k]);
    transfer::loadLanesOrZero(state_.particles.volume.data() + first, count, ws.volumeBefore);
    takeAveragedGradient(ws, tile, first, count);
    constitutive::strainIncrement(ws.L, dt, ws.strainOfForces);
    workOfStrain<dim>(ws.law.stress, ws.strainOfForces, ws.workOfForces);
    ws.sums.strainWorkBefore += transfer::sumOfProducts(ws.volumeBefore, ws.workOfForces);
    treatBefore(ws, tile, first, count, dt, ws.strainOfForces, trace, ws.workOfForces);
}

/// Sums that treatments and hyperelastic laws change first.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::bookKept(Workspace& ws, Index first, int count, double dt,
                                           const double (&trace)[lanes])
{
    if (treated())
        treatAfter(ws, first, count, dt, trace, ws.workOfForcesAfter);
    for (int l = 0; l < lanes; ++l)
        ws.missed[l] -= 0.5 * ws.volume[l] * ws.workOfForcesAfter[l];
    if (hyperelastic())
    {
        storedEnergy(ws, first, count, ws.stored); // of F as it is stored
        forHyperelastic(first, count, [&](const constitutive::Hyperelastic&, auto mine) {
            for (int l = 0; l < lanes; ++l)
                if (mine(l))
                {
                    ws.energy[l] = ws.stored[l] / ws.J[l];
                    ws.missed[l] =
                        ws.volume[l] / ws.J[l] * (ws.stored[l] - ws.storedBefore[l]) -
                        0.5 * (ws.volumeBefore[l] * ws.workOfForces[l] + ws.volume[l] * ws.workOfForcesAfter[l]);
                }
        });
    }
    ws.sums.strainEnergy += transfer::sumOfProducts(ws.volume, ws.energy);
    ws.sums.finiteStrainWork += transfer::sumOfLanes(ws.missed);
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
    auto& most = ws.laneSums.largestJacobian;
    const auto look = [&](const double(&ratio)[lanes]) {
        for (int g = 0; g < lanes; g += 8)
            most = largerOf(load(ratio + g), most);
    };
    if (!hyperelastic() && !(plastic() && ws.law.apexReturns > 0))
        return look(ws.J);
    alignas(64) double stiffJ[lanes];
    for (int l = 0; l < lanes; ++l)
        stiffJ[l] = plastic() && ws.law.region[l] == constitutive::Region::apex ? 1 : ws.J[l];
    if (hyperelastic())
        forHyperelastic(first, count, [&](const constitutive::Hyperelastic& law, auto mine) {
            alignas(64) double own[lanes];
            law.waveFactor(ws.F, own);
            for (int l = 0; l < lanes; ++l)
                if (mine(l))
                    stiffJ[l] = own[l];
        });
    look(stiffJ);
}

/// 1/(2 K) and 1/(4 G) of each lane's material. Are they all of one?
template <int dim, class Shape>
bool ExplicitStepper<dim, Shape>::loadModuli(Workspace& ws, Index first, int count) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    std::int32_t different = 0;
    for (int l = 0; l < count; ++l)
        different |= material[l] ^ material[0];
    std::fill_n(ws.halfOverBulk, lanes, moduli_[std::size_t(material[0])][0]);
    std::fill_n(ws.quarterOverShear, lanes, moduli_[std::size_t(material[0])][1]);
    for (int l = 1; l < count && different != 0; ++l)
    {
        ws.halfOverBulk[l] = moduli_[std::size_t(material[l])][0];
        ws.quarterOverShear[l] = moduli_[std::size_t(material[l])][1];
    }
    return different == 0;
}

/// One call for a chunk of one material; in a mixed chunk each law works on a copy and its own lanes are kept, and
/// copies of the last particle with it: sums look at all lanes.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::callLaws(Index first, int count, constitutive::Chunk<dim>& chunk,
                                           bool oneMaterial) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    if (oneMaterial)
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
        for (int l = 0; l < lanes; ++l)
            if (material[std::min(l, count - 1)] == m)
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

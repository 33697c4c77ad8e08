#include "stepping/strainSweep.hpp"

#include "constitutive/motion.hpp"

#include <algorithm>

namespace mpm::stepping
{
namespace
{
/// `isSmall`: short series do.
template <bool isSmall, int dim>
void sweepStrain(StrainLanes<dim>& c, const StrainColumns<dim>& columns, const StrainStep& step,
                 transfer::Prefetch& ahead)
{
    constexpr int nc = stressSize<dim>;
    constexpr bool inOne = isSmall && dim == 3; // L over mid-step and its exponential from the same products
    const double dt = step.dt, half = step.takenOver == constitutive::TakenOver::start ? 0.5 * dt : -0.5 * dt;
    const Record lowest = splat<Record>(smallestVolumeRatio), highest = splat<Record>(largestVolumeRatio);
    auto within = lowest == lowest;
    Record smallest = c.laneSums.smallestJacobian, workBefore{};
    for (int g = 0; g < lanes; g += 8)
    {
        ahead.some(dim == 2 ? 2 : 4); // most columns of the next chunk, before its turn comes
        Record L[dim * dim], stress[nc], strain[nc];
        loadRow(c.L, g, L);
        const Record before = loadAnywhere(columns.volume + g);
        Record workOfForces;
        if (step.prepared)
        {
            loadRow(c.law.stress, g, stress);
            workOfForces = load(c.workOfForces + g);
        }
        else
        {
            MPM_UNROLL
            for (int k = 0; k < nc; ++k)
                stress[k] = loadAnywhere(columns.stress[k] + g);
            constitutive::strainOf(dt, L, strain);
            workOfForces = constitutive::work(stress, strain);
            storeRow(c.strainOfForces, g, strain);
            if (step.keeps)
                store(c.workOfForces + g, workOfForces);
            workBefore += before * workOfForces;
        }
        const Record energy =
            constitutive::elasticEnergy(stress, load(c.halfOverBulk + g), load(c.quarterOverShear + g));
        Record change[dim * dim];
        if constexpr (inOne)
            constitutive::toMidStep(dt, half, L, change);
        else
            constitutive::toMidStep(half, L);
        storeRow(c.L, g, L);
        constitutive::strainOf(dt, L, strain);
        constitutive::rotate<isSmall>(0.5 * dt, L, strain); // from the middle of the step to its end
        constitutive::rotate<isSmall>(dt, L, stress);
        storeRow(c.law.dStrain, g, strain);
        storeRow(c.law.stress, g, stress);
        const Record workTurned = constitutive::work(stress, strain);

        Record F[dim * dim];
        MPM_UNROLL
        for (int k = 0; k < dim * dim; ++k)
            F[k] = loadAnywhere(columns.F[k] + g);
        if constexpr (inOne)
        {
            Record before[dim * dim];
            std::copy_n(F, dim * dim, before);
            constitutive::multiply3(change, before, F);
        }
        else
            constitutive::advance<isSmall>(dt, L, F);
        MPM_UNROLL
        for (int k = 0; k < dim * dim; ++k)
            storeAnywhere(columns.F[k] + g, F[k]);
        const Record J = constitutive::determinant(F), volume = loadAnywhere(columns.volume0 + g) * J;
        within &= (J >= lowest) & (J <= highest);
        smallest = smallerOf(J, smallest);
        store(c.J + g, J);
        store(c.volumeBefore + g, before);
        store(c.volume + g, volume);
        storeAnywhere(columns.volume + g, volume);
        store(c.missed + g,
              0.5 * (energy * (volume - before) - before * workOfForces) + 0.25 * ((before + volume) * workTurned));
    }
    c.laneSums.smallestJacobian = smallest;
    c.laneSums.strainWorkBefore += workBefore;
    c.inRange = allOf(within);
}
} // namespace

void LaneSums::addTo(TileSums& tile) const
{
    tile.kinetic += sumOf(kinetic);
    for (std::size_t a = 0; a < 3; ++a)
        tile.momentum[a] += sumOf(momentum[a]);
    tile.fastest = std::max(tile.fastest, largestOf(fastest));
    tile.strainWorkBefore += sumOf(strainWorkBefore);
    tile.strainWork += sumOf(strainWork);
    tile.strainEnergy += sumOf(strainEnergy);
    tile.finiteStrainWork += sumOf(finiteStrainWork);
    tile.plasticWork += sumOf(plasticWork);
    tile.apexVolume += sumOf(apexVolume);
    tile.smallestJacobian = std::min(tile.smallestJacobian, smallestOf(smallestJacobian));
    tile.largestJacobian = std::max(tile.largestJacobian, largestOf(largestJacobian));
    tile.maxYield = std::max(tile.maxYield, largestOf(maxYield));
}

template <int dim>
void strainSweep(StrainLanes<dim>& chunk, const StrainColumns<dim>& columns, const StrainStep& step,
                 transfer::Prefetch& ahead)
{
    if (constitutive::isSmallMotion(chunk.L, 1.05 * step.dt)) // L over mid-step is larger by 4 % at most
        sweepStrain<true>(chunk, columns, step, ahead);
    else
        sweepStrain<false>(chunk, columns, step, ahead);
}

template <int dim>
void bookSweep(StrainLanes<dim>& c, const StrainColumns<dim>& columns, const StrainStep& step)
{
    constexpr int nc = stressSize<dim>;
    auto& law = c.law;
    LaneSums sums = c.laneSums;
    for (int g = 0; g < lanes; g += 8)
    {
        Record stress[nc], strain[nc], strainOfForces[nc];
        loadRow(law.stress, g, stress);
        loadRow(law.dStrain, g, strain);
        loadRow(c.strainOfForces, g, strainOfForces);
        MPM_UNROLL
        for (int k = 0; k < nc; ++k)
            storeAnywhere(columns.stress[k] + g, stress[k]);
        const Record volume = load(c.volume + g), before = load(c.volumeBefore + g);
        const Record work = constitutive::work(stress, strain);
        const Record workOfForces = constitutive::work(stress, strainOfForces);
        const Record energy =
            constitutive::elasticEnergy(stress, load(c.halfOverBulk + g), load(c.quarterOverShear + g));
        const Record missed =
            load(c.missed + g) + (0.5 * (energy * (volume - before)) + 0.25 * ((before + volume) * work));
        sums.strainWork += volume * workOfForces;
        if (step.keeps)
        {
            store(c.workOfForcesAfter + g, workOfForces);
            store(c.energy + g, energy);
            store(c.missed + g, missed);
        }
        else
        {
            sums.strainEnergy += volume * energy;
            sums.finiteStrainWork += missed - 0.5 * (volume * workOfForces);
        }
        if (step.plastic)
        {
            sums.plasticWork += 0.5 * ((before + volume) * load(law.plasticWork + g));
            sums.apexVolume += volume * load(law.apexStrain + g);
            sums.maxYield = largerOf(load(law.yield + g), sums.maxYield);
        }
    }
    c.laneSums = sums;
}

template void strainSweep(StrainLanes<2>&, const StrainColumns<2>&, const StrainStep&, transfer::Prefetch&);
template void strainSweep(StrainLanes<3>&, const StrainColumns<3>&, const StrainStep&, transfer::Prefetch&);
template void bookSweep(StrainLanes<2>&, const StrainColumns<2>&, const StrainStep&);
template void bookSweep(StrainLanes<3>&, const StrainColumns<3>&, const StrainStep&);
} // namespace mpm::stepping

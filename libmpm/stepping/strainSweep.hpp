#pragma once
/// What happens to a chunk around its law, in one sweep on either side that keeps eight particles in registers:
///     strainSweep   L, F, V, sigma at the start -> F, V, and the turned stress and strain increment the law takes
///                   (constitutive/kinematics.hpp), with the work of the stress the step found
///     bookSweep     the stress the law leaves, with its work and energy (energyBudget.hpp)
/// Loops of their own for each of these spent twice the time on moving numbers between registers and cache.
///
/// Compiled once per dimension. Covered by tests/unit/strainSweep.cpp and the scenes of tests/verification.
#include "base/record.hpp"
#include "constitutive/law.hpp"
#include "state/particles.hpp"
#include "stepping/tileSums.hpp"
#include "transfer/chunkColumns.hpp"

namespace mpm::stepping
{
/// Sums of a tile while they still are those of eight lanes; addTo() makes them numbers.
struct LaneSums
{
    Record kinetic{}, momentum[3]{}, fastest{};
    Record strainWorkBefore{}, strainWork{}, strainEnergy{}, finiteStrainWork{}, plasticWork{}, apexVolume{};
    Record smallestJacobian = splat<Record>(1), largestJacobian = splat<Record>(1), maxYield{};

    void addTo(TileSums& sums) const;
};

/// One thread's chunk between velocity gradient and stress.
template <int dim>
struct StrainLanes
{
    alignas(64) constitutive::TensorLanes<dim> L; ///< after strainSweep over the mid-step configuration
    alignas(64) constitutive::TensorLanes<dim> F;
    alignas(64) double J[lanes];
    alignas(64) double volume[lanes], volumeBefore[lanes];
    alignas(64) double halfOverBulk[lanes], quarterOverShear[lanes]; ///< 1/(2 K), 1/(4 G)
    constitutive::Chunk<dim> law;
    /// dt sym L of L as it is, on which the grid's forces do work; the law sees that over the mid-step configuration.
    alignas(64) constitutive::StressLanes<dim> strainOfForces;
    alignas(64) double workOfForces[lanes];      ///< sigma : strainOfForces of the stress the step found
    alignas(64) double workOfForcesAfter[lanes]; ///< and of the one it leaves; kept on request
    alignas(64) double missed[lanes]; ///< what a finite step misses of the change of energy (finiteStrainWork)
    alignas(64) double energy[lanes]; ///< elastic energy density at the end; kept on request
    bool inRange = true;              ///< is det F of all lanes positive and finite?
    LaneSums laneSums;
};

/// Columns of the chunk, changed in place; rows of `lanes` numbers, where they hold fewer particles copies.
template <int dim>
struct StrainColumns
{
    double* F[dim * dim];
    double* stress[stressSize<dim>];
    double* volume;
    const double* volume0;
};

struct StrainStep
{
    constitutive::TakenOver takenOver;
    double dt;
    bool prepared = false; ///< law.stress, strainOfForces and workOfForces hold what the sweep starts from
    bool keeps = false;    ///< are energy, missed and workOfForcesAfter to be kept for changes, their sums left open?
    bool plastic = true;   ///< does the law tell of plastic work?
};

inline constexpr double smallestVolumeRatio = std::numeric_limits<double>::min(), largestVolumeRatio = 1e30;

template <int dim>
void strainSweep(StrainLanes<dim>& chunk, const StrainColumns<dim>& columns, const StrainStep& step,
                 transfer::Prefetch& ahead);

template <int dim>
void bookSweep(StrainLanes<dim>& chunk, const StrainColumns<dim>& columns, const StrainStep& step);

extern template void strainSweep(StrainLanes<2>&, const StrainColumns<2>&, const StrainStep&, transfer::Prefetch&);
extern template void strainSweep(StrainLanes<3>&, const StrainColumns<3>&, const StrainStep&, transfer::Prefetch&);
extern template void bookSweep(StrainLanes<2>&, const StrainColumns<2>&, const StrainStep&);
extern template void bookSweep(StrainLanes<3>&, const StrainColumns<3>&, const StrainStep&);
} // namespace mpm::stepping

#pragma once
/// What one thread works with while it passes over the particles of a tile: a chunk of particles and the windows of
/// nodes around them. Columns of the chunk that only treatments or hyperelastic laws need are not touched by other
/// scenes.
#include "stepping/stepper.hpp"
#include "stepping/strainSweep.hpp"
#include "transfer/gridToParticle.hpp"
#include "transfer/stressTransfer.hpp"
#include "treatment/tensionGap.hpp"

namespace mpm::stepping
{
template <int dim, class Shape>
struct Workspace : StrainLanes<dim>
{
    using Vectors = double[dim][lanes];
    using Domain = typename transfer::ChunkWeights<dim, Shape>::Domain;

    AlignedVector<typename transfer::ValueNode<dim>::Type> values, filteredValues;
    AlignedVector<typename transfer::GradientNode<dim, 1>::Type> gradients;
    alignas(64) Vectors x, xNew, v;
    alignas(64) Domain half;
    alignas(64) constitutive::TensorLanes<dim> affine;
    transfer::Values<dim> filtered;
    std::vector<double> cells;             ///< means over cells, in the order of the window
    AlignedVector<Record> stressNodes;     ///< smoothed stress at nodes
    alignas(64) std::int32_t cell[lanes];  ///< each lane's cell in the window
    constitutive::StressLanes<dim> smooth; ///< S sigma, or the correction
    treatment::OpenGap gap;
    alignas(64) double viscous[lanes], viscosity[lanes]; ///< normal stress of hourglass viscosity; eta
    alignas(64) double bulkViscous[lanes];               ///< normal stress of bulk viscosity
    alignas(64) double spread[lanes];                    ///< what an average adds to each normal rate of L
    alignas(64) double mass[lanes], volume0[lanes];
    alignas(64) double storedBefore[lanes], stored[lanes]; ///< W(F) of hyperelastic lanes
    transfer::Values<dim> value;
    transfer::ChunkWeights<dim, Shape> wide;
    transfer::ChunkWeights<dim, typename Shape::Narrow> narrow;
    transfer::ParticleRecords<dim, transfer::Momentum> momentum;
    transfer::ParticleRecords<dim, transfer::Forces> forces;
    transfer::ParticleRecords<dim, transfer::Stresses> stresses;
    transfer::Prefetch ahead;
    TileSums sums; ///< of the tile, with those of all lanes once it is done
    PassTimes times;
    double lapStart = 0;
    bool timed = false;
};
} // namespace mpm::stepping

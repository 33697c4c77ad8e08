#pragma once
/// Finite motion of one chunk over one step, from the velocity gradient L (METHOD, Geometry and Stress):
///     L <- L (I + dt L/2)^-1              from the configuration L was taken over to that of mid-step
///     F <- exp(dt L) F        V = V0 det F           (det exp(dt L) = exp(dt tr L): no volume drift in rotation)
///     sigma <- dR sigma dR^T  dR = (I - dt W/2)^-1 (I + dt W/2), W = skew L   (Hughes & Winget 1980)
///     dEps = dt D,            D = sym L, then turned by half of dR
///     U of F = R U            for the domains of cpGIMP
/// All as loops over 64 lanes, on 64 bytes, without branches; motion.hpp has the same for one register. Verified in
/// tests/unit/kinematics.cpp.
#include "base/types.hpp"

namespace mpm::constitutive
{
/// A general tensor for each lane, dim x dim row by row.
template <int dim>
using TensorLanes = double[dim * dim][lanes];
template <int dim>
using StressLanes = double[stressSize<dim>][lanes];

/// Which end of the step the configuration belongs to that L was taken over.
enum class TakenOver
{
    start, ///< the velocity that moves particles on from where they are: dx <- (I + dt L) dx
    end    ///< the one that brought them there: dx <- (I - dt L)^-1 dx
};

/// L <- L (I + dt L/2)^-1, or with - at the end: the gradient over the mid-step configuration, which Hughes & Winget
/// ask for. For a turn, dt L = Q - I, its symmetric part vanishes: -2 (1 - cos) a step would otherwise be taken for
/// compression, and a body that turns would grow by half its angle of a step with every radian. Where a step deforms by
/// half or more L is kept.
void toMidStep(TakenOver where, double dt, TensorLanes<2>& L);
void toMidStep(TakenOver where, double dt, TensorLanes<3>& L);

/// F <- exp(dt L) F. Relative error of exp below 1e-13 for |dt L| <= 1/2.
void advanceDeformation(const TensorLanes<2>& L, double dt, TensorLanes<2>& F);
void advanceDeformation(const TensorLanes<3>& L, double dt, TensorLanes<3>& F);

/// Is dt |L| in every component so small that short series are exact to round-off (smallMotion, motion.hpp)?
bool isSmallMotion(const TensorLanes<2>& L, double dt);
bool isSmallMotion(const TensorLanes<3>& L, double dt);

/// sigma <- dR sigma dR^T. Of a strain increment with dt/2: from the middle of the step, where it is taken, to the end,
/// where the turned stress is; without that, shear that turns is of first order in the step.
void rotateStress(const TensorLanes<2>& L, double dt, StressLanes<2>& stress);
void rotateStress(const TensorLanes<3>& L, double dt, StressLanes<3>& stress);

/// dEps = dt sym L; plane strain: zz = 0.
void strainIncrement(const TensorLanes<2>& L, double dt, StressLanes<2>& dStrain);
void strainIncrement(const TensorLanes<3>& L, double dt, StressLanes<3>& dStrain);

void determinant(const TensorLanes<2>& F, double (&J)[lanes]);
void determinant(const TensorLanes<3>& F, double (&J)[lanes]);

/// Diagonal U_kk of the right stretch.
void stretchDiagonal(const TensorLanes<2>& F, double (&U)[2][lanes]);
void stretchDiagonal(const TensorLanes<3>& F, double (&U)[3][lanes]);
} // namespace mpm::constitutive

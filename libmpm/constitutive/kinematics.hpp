#pragma once
/// Finite motion of one chunk over one step, from the velocity gradient L (METHOD, Geometry and Stress):
///     F <- exp(dt L) F        V = V0 det F           (det exp(dt L) = exp(dt tr L): no volume drift in rotation)
///     sigma <- dR sigma dR^T  dR = (I - dt W/2)^-1 (I + dt W/2), W = skew L   (Hughes & Winget 1980)
///     dEps = dt D,            D = sym L
///     U of F = R U            for the domains of cpGIMP
/// All as loops over 64 lanes without branches. Verified in tests/unit/kinematics.cpp.
#include "base/types.hpp"

namespace mpm::constitutive
{
/// A general tensor for each lane, dim x dim row by row.
template <int dim>
using TensorLanes = double[dim * dim][lanes];
template <int dim>
using StressLanes = double[stressSize<dim>][lanes];

/// F <- exp(dt L) F. Relative error of exp below 1e-13 for |dt L| <= 1/2.
void advanceDeformation(const TensorLanes<2>& L, double dt, TensorLanes<2>& F);
void advanceDeformation(const TensorLanes<3>& L, double dt, TensorLanes<3>& F);

/// sigma <- dR sigma dR^T.
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

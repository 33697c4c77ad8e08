#pragma once
/// The checkerboard of the pressure: what of it alternates from cell to cell along every axis, the (-1)^(i+j(+k))
/// pattern that the forces of nodes do not feel (the null space of elements with pressures constant over a cell).
///
/// Looked at are cells inside the material: they and all their neighbours (8 in 2D, 26 in 3D) are full, a cell being
/// full if the particles in it have half of its volume. With p_n the mean pressure of the particles in cell n, weighted
/// by mass, x_n their centre, c_n that of the cell, and g the slope of the linear field that fits the particles of c
/// and its neighbours best (least squares by mass),
///     P_n = p_n - g . (x_n - c_n),   q_c = sum_n prod_axes f(n_a - c_a) P_n,   f(0) = 1/2, f(+-1) = -1/4.
/// q is the signed amplitude of the pattern at c. The filter passes (-1)^(i+j) unchanged and takes away every field
/// linear along one axis, anything of y times (a + b x) included; the slope does the same for particles that lie
/// anyhow in their cells. Of a wave of length l along every axis it leaves sin^2(pi h/l) to the power of dim; of noise
/// that differs from cell to cell at random, (3/8)^dim of the variance.
///     share      sum q^2/(sum q^2 + sum (r - mean r)^2), r = P - q: 0 of a smooth field, 1 of a checkerboard
///     amplitude  RMS q over RMS P: what the pattern is beside the pressure; the share is small where weight makes
///                pressures differ much from top to bottom
/// Both are not a number without a cell inside, and 0 where nothing but round-off differs. Verified in
/// tests/unit/stressMeasures.cpp.
#include "state/state.hpp"

namespace mpm::smoothing
{
struct Checkerboard
{
    double share = 0, amplitude = 0; ///< [-]
    Index cells = 0;                 ///< inside the material
};

/// Of the pressure - tr sigma/3 of the particles. Throws InputError if the state has no grid.
Checkerboard checkerboard(const state::State& state);

/// Of any values, one a particle.
Checkerboard checkerboard(const state::State& state, const std::vector<double>& values);
} // namespace mpm::smoothing

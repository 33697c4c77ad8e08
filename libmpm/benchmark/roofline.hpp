#pragma once
/// What one particle and step must move and compute, by a fixed list, and the time a machine needs for that at least.
///
///     roofline time = max(bytes/triad, flops/fmaPeak)        share = roofline time/(time measured)
///
/// BYTES are those of particle columns in doubles of 8 B (v, F, sigma, l in floats of 4 B where they are stored so,
/// state::Stored): each column that a pass needs is read once and, if it changes, written once. A pass is a sweep over
/// particles between two sweeps over nodes; the one that ends a step also makes the first projection of the next.
/// Nodes, which caches can hold, what is kept from one pass to the next (new positions) and what is moved for sorting
/// are not counted: a step moves more than this list, never less. d: dimension, s: 4 or 6 stress components, l: d half
/// lengths of the domain or 0 (linear, splines), M: the material's index, half a double.
///
///     MUSL   accelerate       read x v m l               write v          3d + 1 + l
///            strain, project  read x v m F sigma V0 M l  write x F sigma V    3d + 2d^2 + 2s + 3.5 + l
///     USL    everything       read x v m F sigma V0 M l  write x v F sigma V  4d + 2d^2 + 2s + 3.5 + l
///     USF    strain, project  read x v m F sigma V0 M l  write F sigma V  2d + 2d^2 + 2s + 3.5 + l
///            move, project    read x v m l               write x v        4d + 1 + l
///     cpGIMP: the strain pass also reads length0 and writes the half lengths, 2d.
///
/// FLOPS are useful ones: additions, multiplications, divisions and roots of the formulas (a fused multiply-add is
/// two), each product over axes summed axis by axis (x innermost), weights and gradients once a step; selections,
/// comparisons, signs, conversions and everything at nodes count nothing. n: nodes of the support an axis.
///
///     weights an axis   linear 5, uGIMP 23, quadraticBSpline 17, cubicBSpline 32 (as in shape/); cpGIMP as uGIMP,
///                       which it is while no domain is wider than a cell
///     projection of c columns               2D n c + 2 n^2 c        3D (n + n^2) c + 2 n^3 c
///     projection of internal forces         2D 2 n d + 4 n^2 d      3D 3 n d + 4 n^2 d + 4 n^3 d
///     interpolation of c columns            2D 2 (n^2 + n) c        3D 2 (n^3 + n^2 + n) c
///     gradient of a vector                  2D 4 (n^2 + n) d        3D 4 n^3 d + 6 (n^2 + n) d
///     m v and V sigma: d and 3 or 6; v += dt a and its energy, x += dt v: 6d + 1; work of strain 2s + 2 (not USL)
///     L over mid-step, dt D, exp(dt L) F, dR sigma dR^T, det F, V (small steps):
///                       2D 16 + 4 + 63 + 28 + 3 + 1     3D 118 + 9 + 220 + 112 + 14 + 1
///     domains of cpGIMP: 2D 22, 3D 1029; linearElastic: 2D 14, 3D 18; mohrCoulomb: 2D 104, 3D 339 (constitutive/, all
///     operations of one lane)
///
/// MUSL projects mass, momentum and forces, then momentum again; interpolates a, v* and grad w. USL: a, grad v* and
/// the outermost sums of v*, 2 n d (the others are those of the gradient). USF projects mass and momentum, then
/// forces; interpolates grad v, a and v*.
///
/// Verified in tests/unit/benchmarkRows.cpp.
#include "stepping/stepper.hpp"

#include <string>

namespace mpm::benchmark
{
struct Work
{
    double bytes = 0, flops = 0; ///< of one particle and step
};

/// The shapes and laws that are counted, the default first.
const std::vector<std::string>& countedShapes();
const std::vector<std::string>& countedLaws();

/// What is counted. Throws InputError for a word the lists do not have. storedBytes: of v, F, sigma and l.
Work countedWork(int dim, const std::string& shape, stepping::StressUpdate update, const std::string& law,
                 std::size_t storedBytes = sizeof(state::Stored));

/// Seconds a particle and step take at least. Rates in bytes and flops per second, of all threads together.
double rooflineSeconds(const Work& work, double triad, double fmaPeak);
} // namespace mpm::benchmark

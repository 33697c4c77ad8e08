#pragma once
/// The field a stress relaxation goes towards: linear operators that make a field of particle values smooth over cells.
///
/// With weights N_ip, masses m_q, m_i = sum_q m_q N_iq and d_ip = x_p - x_i:
///   smoothed      S s = sum_i N_ip s_i,   s_i = sum_q m_q N_iq s_q / m_i
///                 (Andersen & Andersen 2009, Eqs. 11 and 12). A convex average: extremes shrink, so stresses of one
///                 material stay within any convex yield surface they all obey. Bends linear fields at surfaces.
///   filtered      (2 S - S S) s = (I - (I - S)^2) s: what S changes is filtered once more and given back, the filter
///                 of XPIC of order 2 (Hammerquist & Nairn 2017, CMAME 318, there for velocities). The null space of
///                 S, values no node sees, goes as with S; a wave of eigenvalue lambda under S loses (1 - lambda)^2
///                 instead of 1 - lambda. Not convex: S s plus a correction.
///   leastSquares  T s = sum_i N_ip (a_i + b_i . d_ip), at each node the linear field that fits best,
///                 sum_q m_q N_iq (s_q - a_i - b_i . d_iq)^2 = min, or
///                 T_pq = sum_i N_ip [1 d_ip] A_i^-1 [1 d_iq]^T N_iq m_q,  A_i = sum_q m_q N_iq [1 d_iq]^T [1 d_iq].
///                 Linear fields stay, at free surfaces and walls too. Fits at nodes are those of Wallstedt & Guilkey
///                 2011 (IJNME 85, 1687-1704: weighted least squares at grid nodes); here N itself is the weight, and
///                 the fits are blended by N (they sum to one). That such a reconstruction must keep totals to be of
///                 use is from Wobbes, Moeller, Galavi & Vuik 2019 (IJNME 117, 271-290: conservative Taylor least
///                 squares, cell by cell; here it follows from the weights). Not convex.
/// A null space filter in the sense of Gritton & Berzins 2017 (Comput. Part. Mech. 4, 131-142: values that nodes do not
/// see are projected out by singular values) is the limit I - (I - S)^k, k to infinity, of the first two.
///
/// All three: sum_p m_p r_p (O s)_p is symmetric in r and s; 0 <= O <= I, so that sum m s^2 never grows, and relaxing
/// any share of the way takes energy and adds none; constants and sum m s stay. (With <r, s>_i = sum_q m_q N_iq r_q
/// s_q, the sum over i of <r, s>_i is the inner product of masses, and each node's fit is orthogonal projection in
/// <>_i.) A wave of k h << 1 loses O((k h)^2) of itself under `smoothed`, O((k h)^4) under the others (<s, s - O s>/<s,
/// s>), which also leave a ripple of O((k h)^3) within cells. On a lattice of two particles an axis and cell, without
/// surfaces, all three remove the checkerboard of particles entirely.
///
/// Few particles: second moments about the node's centre of mass, per mass, have eigenvalues l >= 0 [m^2]. The slope
/// along such an eigenvector takes 1/l for l >= l_0 = 1e-12 h^2 and l (3 - 2 l/l_0)/l_0^2 below, which joins smoothly
/// and goes to 0: one particle, or a line of them, is fitted along the directions it has and by its mean in the others
/// (l_0: particles within 1e-6 h of a plane are in it). Such a fit lies between two orthogonal projections, so all of
/// the above holds, but linear fields are then changed by up to 1e-6 h |gradient|.
///
/// At a surface least squares cannot tell noise from a slope: stripes from the surface on keep up to 3/4 there, S
/// leaves 3/8, the filter 1/2 (linear shapes).
///
/// Price beside the table, uGIMP, one thread, per particle: in 2D, four columns, 0.07, 0.12 and 0.23 us; in 3D, six
/// columns, 0.15, 0.25 and 0.7 us (2 GHz-class server core, measured under load).
/// Sums are those of one thread bit by bit for any number of threads. Floats (MPM_STORAGE) are widened first.
///
///     const auto table = weightTable(state, "uGIMP");
///     StressColumns target;
///     stressTarget(StressTarget::leastSquares, state.particles, table, target); // its stresses
/// Throws InputError: a table of another number of particles. Verified in tests/unit/stressTargets.cpp,
/// stressTargetFields.cpp.
#include "smoothing/smoothStress.hpp"

namespace mpm::smoothing
{
enum class StressTarget
{
    smoothed,
    filtered,
    leastSquares
};

/// Words of the targets, in the order of the enumerators.
const std::vector<std::string>& stressTargetNames();

/// `out` gets one column a column, of size() values. It may keep the memory of an earlier call, but not be read by
/// `columns`.
void stressTarget(StressTarget target, const std::vector<const double*>& columns, const state::Particles& particles,
                  const WeightTable& table, StressColumns& out);

/// Of the particles' stresses.
void stressTarget(StressTarget target, const state::Particles& particles, const WeightTable& table, StressColumns& out);
} // namespace mpm::smoothing

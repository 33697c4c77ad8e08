#pragma once
/// Nodal and smoothed stress (Andersen & Andersen 2009, Eqs. 11 and 12; METHOD, Smoothing):
///     sigma_i   = sum_p m_p sigma_p N_ip / m_i,   m_i = sum_p m_p N_ip        (11)
///     sigma_p^s = sum_i N_ip sigma_i                                          (12)
/// A convex average: it keeps constants and sum m_p sigma_p (where every row of weights sums to one), creates no new
/// extremes, but does not keep linear fields at boundaries.
///
///     const auto table = weightTable(state, "uGIMP");
///     const auto smoothed = smoothStress(state.particles, table);
///
/// Verified in tests/unit/smoothing.cpp.
#include "smoothing/weightTable.hpp"

namespace mpm::smoothing
{
/// Stress components in storage order, one column each.
using StressColumns = std::vector<std::vector<double>>;

/// The stresses of particles; where floats are stored, copies that `widened` keeps.
std::vector<const double*> stressColumns(const state::Particles& particles, StressColumns& widened);

struct SmoothedStress
{
    std::vector<Vector3> nodePosition; ///< of the nodes that carry mass [m]
    std::vector<double> nodeMass;      ///< m_i [kg]
    StressColumns nodal;               ///< Eq. 11 at those nodes [Pa]
    StressColumns smoothed;            ///< Eq. 12 at the particles [Pa]
};

SmoothedStress smoothStress(const state::Particles& particles, const WeightTable& table);

/// The same for any columns of particle values.
SmoothedStress smoothColumns(const std::vector<const double*>& columns, const state::Particles& particles,
                             const WeightTable& table);
} // namespace mpm::smoothing

#pragma once
/// How physical a stress field is: numbers for nodal, raw (particle) and smoothed vertical stress.
///     N         RMS(raw - smoothed)/RMS(smoothed): 0.1 for an elastic body, above 1 where stresses are erratic
///     N by mass the same with means weighted by mass, so that crumbs of split particles count as little as they weigh
///     N floor   the same for the overburden in place of the raw stress: what Eqs. 11 and 12 alone change in a field
///     that
///               is not erratic at all
///     error, correlation: root mean square difference and Pearson's correlation with overburden
/// Other means run over particles (over nodes that carry mass for nodal), each counted once. A correlation with a
/// constant is not a number.
#include "smoothing/overburden.hpp"
#include "smoothing/smoothStress.hpp"

namespace mpm::smoothing
{
struct FieldQuality
{
    double min = 0;         ///< most compressive value [Pa]
    double max = 0;         ///< [Pa]
    double error = 0;       ///< RMS against overburden [Pa]
    double correlation = 0; ///< Pearson, against overburden [-]
};

struct StressQuality
{
    int axis = 1; ///< of the normal stress looked at
    FieldQuality nodal, raw, smoothed;
    double noise = 0;       ///< N
    double noiseByMass = 0; ///< N by mass
    double noiseFloor = 0;  ///< N floor
    Vector3 worstPlace{};   ///< centre of the particle where smoothed and overburden differ most [m]
    double worstError = 0;  ///< smoothed - overburden there [Pa]
};

FieldQuality fieldQuality(const std::vector<double>& values, const std::vector<double>& overburden);

/// sqrt(mean (a - b)^2) / sqrt(mean b^2); `weight`, one a value, may be null.
double relativeDifference(const std::vector<double>& a, const std::vector<double>& b, const double* weight = nullptr);

/// For the normal stress along gravity. Without gravity along one axis there is no overburden: sigma_yy is taken, and
/// what compares with overburden is not a number. overburden receives that of every particle,
/// if there is one.
StressQuality stressQuality(const state::State& state, const WeightTable& table, const SmoothedStress& smoothed,
                            const Vector3& gravity, std::vector<double>* overburden = nullptr);
} // namespace mpm::smoothing

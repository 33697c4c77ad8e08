#pragma once
/// N of every stress component: how far the stresses of particles are from those Eqs. 11 and 12 make of them,
///     own_c     = RMS(raw_c - smoothed_c)/RMS(smoothed_c)
///     ofMean_c  = RMS(raw_c - smoothed_c)/scale,   scale = RMS of the smoothed mean stress
///     mean      = RMS(raw - smoothed)/scale of the mean stress tr sigma/3
/// over particles, each counted once. A shear component may be near zero all over (a level layer at rest): its own
/// RMS then says nothing, and own_c is large however small the noise is. ofMean_c tells whether the noise of shear
/// matters beside the pressure that carries the load. 0/0 is not a number.
/// Verified in tests/unit/stressMeasures.cpp.
#include "smoothing/smoothStress.hpp"

namespace mpm::smoothing
{
struct ComponentNoise
{
    std::vector<double> own, ofMean; ///< by component, in storage order
    double mean = 0;
    double scale = 0; ///< [Pa]
};

ComponentNoise componentNoise(const state::Particles& particles, const SmoothedStress& smoothed);
} // namespace mpm::smoothing

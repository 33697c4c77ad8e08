#pragma once
/// Noise of sigma_yy beyond what smoothing makes of a field without any. N = RMS(s - S s)/RMS(S s) of a smooth field is
/// not zero: S of Eqs. 11 and 12 bends curved fields, and linear ones at surfaces. With f = (2 S - S S) s, the target
/// `filtered` of stressTargets.hpp,
///     beyondFilter = RMS(s - f)/RMS(S s):    what is no part of f, which keeps waves up to O((k h)^3)
///     floorOfField = RMS(f - S f)/RMS(S s):  the N that is left if nothing but f is
/// over particles, each counted once. floorOfField is taken of the field that is there, and so differs from the floor
/// of stressQuality.hpp, that of the overburden. Both together say how N comes about: s - S s = (s - f) + S (s - S s).
/// At surfaces f itself bends linear fields, so beyondFilter of a linear heap is small and not zero. 0/0 is not a
/// number. Verified in tests/unit/stressMeasures.cpp.
#include "smoothing/smoothStress.hpp"

namespace mpm::smoothing
{
struct FilteredNoise
{
    double beyondFilter = 0, floorOfField = 0;
};

/// `smoothed`: of the same particles and table.
FilteredNoise filteredNoise(const state::Particles& particles, const WeightTable& table,
                            const SmoothedStress& smoothed);
} // namespace mpm::smoothing

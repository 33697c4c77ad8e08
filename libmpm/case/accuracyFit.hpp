#pragma once
/// A field of one run at the material positions of another: a weighted linear least-squares fit to the nearest
/// particles. Of second order in the spacing of the particles it is taken from.
#include "case/accuracyMeasure.hpp"

namespace mpm::cases
{
/// Values at the positions, `from.components` each. Throws InputError where no particle is near.
std::vector<double> fitAt(const Sample& from, const std::vector<Vector3>& positions);
} // namespace mpm::cases

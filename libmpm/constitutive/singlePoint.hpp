#pragma once
/// One material point through a law: a chunk of which one lane counts.
#include "constitutive/law.hpp"

namespace mpm::constitutive
{
/// xx, yy, zz, xy, yz, zx; tensor components.
using SymmetricTensor = std::array<double, 6>;

struct PointStep
{
    SymmetricTensor stress; ///< [Pa]
    Region region;
    double plasticWork;       ///< [J/m^3]
    double apexStrain;        ///< [-]
    double yield;             ///< f/max(|sigma|, strength scale)
    double plasticStrain = 0; ///< history at the end [-] (Law::usesHistory)
};

/// The law's step from `stress` [Pa] over the strain increment `dStrain` [-], in 3D. For a hyperelastic law the axes
/// have not turned since F = I: it gets F = exp(strain + dStrain), `strain` the sum of all increments before.
/// `plasticStrain` is the history at the start.
PointStep updatePoint(const Law& law, const SymmetricTensor& stress, const SymmetricTensor& dStrain,
                      const SymmetricTensor& strain = {}, double plasticStrain = 0);

/// The return of one trial stress [Pa].
PointStep returnMap(const Law& law, const SymmetricTensor& trial);
} // namespace mpm::constitutive

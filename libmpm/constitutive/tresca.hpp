#pragma once
/// Elastic, perfectly plastic Tresca, tension positive: Mohr-Coulomb's law (mohrCoulomb.hpp) without friction,
///
///     f = s1 - s3 - 2 c <= 0,    associated: plastic flow keeps volume
///
/// (Tresca 1864; the return of Clausen, Damkilde & Andersen 2006, exact on the faces and edges of the hexagonal prism.)
/// Undrained clay with the shear strength c.
///
///     law            tresca;
///     E              20e6;   // [Pa] > 0
///     nu             0.45;   // in (-1, 0.5)
///     cohesion       10e3;   // [Pa] >= 0, undrained shear strength
///     tensionCutOff  0;      // [Pa] >= 0, largest principal stress (mohrCoulombCutOff.hpp); absent: none
///     softening      { over 0.1; cohesion 2e3; referenceLength 0.1; }    // absent: none (softening.hpp)
///     substep        { tolerance 1e-4; }     // absent: none (substep.hpp)
///
/// Tests: tests/unit/druckerPrager.cpp, and those of mohrCoulomb with frictionAngle 0. Errors: InputError for values
/// out of bounds.
#include "constitutive/mohrCoulomb.hpp"

namespace mpm::constitutive
{
class Tresca : public MohrCoulomb
{
  public:
    using MohrCoulomb::MohrCoulomb;
    static Tresca read(const dictionary::Dictionary& material);

    std::string name() const override { return "tresca"; }
    std::string describe() const override;
};
} // namespace mpm::constitutive

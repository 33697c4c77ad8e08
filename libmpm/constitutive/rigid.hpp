#pragma once
/// A material that moves as prescribed and carries no stress: its particles are a body of constant/contactProperties
/// (nodal/contact.hpp) that pushes others as an infinite mass.
///
///     blade
///     {
///         law     rigid;
///         density 2000;                       // [kg/m^3] of no effect but on its own kinetic energy
///         motion  { velocity (0.1 0 0); }     // nodal/rigidBody.hpp; a rotation needs its centre
///     }
///
/// Who reads `motion`: case/readContact.hpp. Verified in tests/unit/rigidMaterial.cpp.
#include "constitutive/law.hpp"

namespace mpm::constitutive
{
class Rigid : public Law
{
  public:
    static Rigid read(const dictionary::Dictionary& material);

    std::string name() const override { return "rigid"; }
    std::string describe() const override { return "rigid: moves as prescribed"; }
    void update(Chunk<2>& chunk) const override;
    void update(Chunk<3>& chunk) const override;
    /// Nothing vibrates: too soft to count in any stability limit.
    double bulkModulus() const override { return 1e-6; }
    double shearModulus() const override { return 1e-6; }
    bool rigid() const override { return true; }
};
} // namespace mpm::constitutive

#pragma once
/// Elastic, perfectly plastic von Mises (J2) with the associated flow rule, in rate form:
///
///     yield   f = |s| - R <= 0,   s = dev sigma,  R = sqrt(2/3) yieldStress (uniaxial)
///     return  s = s_trial R/|s_trial| where f(trial) > 0; the mean stress keeps its trial value
///
/// The radial return is the backward Euler step of the flow rule (Wilkins 1964; Krieg & Krieg, "Accuracies of numerical
/// solution methods for the elastic-perfectly plastic model", J. Pressure Vessel Technol. 99 (1977) 510-515, which has
/// the exact solution the tests compare with). In plane strain s_zz takes part.
///
///     law         vonMises;
///     E           1e6;     // [Pa] > 0
///     nu          0.3;     // in (-1, 0.5)
///     yieldStress 20e3;    // [Pa] > 0, in uniaxial tension; undrained clay: sqrt(3) times its shear strength
///     substep     { tolerance 1e-4; }     // absent: none (substep.hpp)
///
/// Tests: tests/unit/vonMises.cpp. Errors: InputError for values out of bounds.
#include "constitutive/substep.hpp"

namespace mpm::constitutive
{
class VonMises : public Law
{
  public:
    VonMises(const ElasticModuli& moduli, double yieldStress, std::optional<Substep> substep = {});
    static VonMises read(const dictionary::Dictionary& material);

    std::string name() const override { return "vonMises"; }
    std::string describe() const override;
    void update(Chunk<2>& chunk) const override;
    void update(Chunk<3>& chunk) const override;
    double bulkModulus() const override { return moduli_.bulk(); }
    double shearModulus() const override { return moduli_.shear(); }
    bool plastic() const override { return true; }
    void reportYield(Chunk<2>& chunk) const override;
    void reportYield(Chunk<3>& chunk) const override;
    const ElasticModuli& moduli() const { return moduli_; }
    double yieldStress() const { return yieldStress_; }
    const std::optional<Substep>& substep() const { return substep_; }

  private:
    ElasticModuli moduli_;
    double yieldStress_;
    std::optional<Substep> substep_;
};
} // namespace mpm::constitutive

#pragma once
/// Compressible neo-Hookean solid, hyperelastic. With J = det F, F_zz = 1 in plane strain, and Lame's lambda, mu of E,
/// nu:
///
///     W     = mu/2 (tr F F^T - 3) - mu ln J + lambda/2 ln^2 J      per initial volume
///     P     = mu (F - F^-T) + lambda ln J F^-T                      P_aa = lambda ln J/F_aa + mu (F_aa - 1/F_aa)
///     sigma = (mu (F F^T - I) + lambda ln J I)/J
///
/// Bonet & Wood, "Nonlinear Continuum Mechanics for Finite Element Analysis", 2nd ed. (2008), section 6.4.3.
/// Its acoustic tensor is rho_0 Q = (lambda (1 - ln J) + mu) n n + mu (n . b . n) I, b = F F^T: it stiffens in
/// compression by -lambda ln J, in tension by mu b.
///
///     law neoHookean;
///     E   1e7;    // [Pa] > 0
///     nu  0.3;    // in (-1, 0.5)
///
/// Tests: tests/unit/hyperelastic.cpp. Errors: InputError for values out of bounds; initial stress is refused
/// (seeding/initialStress.hpp), as there is none where F = I.
#include "constitutive/elasticTrial.hpp"

namespace mpm::constitutive
{
class NeoHookean : public Hyperelastic
{
  public:
    explicit NeoHookean(const ElasticModuli& moduli);
    static NeoHookean read(const dictionary::Dictionary& material);

    std::string name() const override { return "neoHookean"; }
    std::string describe() const override;
    void update(Chunk<2>& chunk) const override;
    void update(Chunk<3>& chunk) const override;
    void strainEnergy(const TensorLanes<2>& F, double (&energy)[lanes]) const override;
    void strainEnergy(const TensorLanes<3>& F, double (&energy)[lanes]) const override;
    void waveFactor(const TensorLanes<2>& F, double (&factor)[lanes]) const override;
    void waveFactor(const TensorLanes<3>& F, double (&factor)[lanes]) const override;
    double bulkModulus() const override { return moduli_.bulk(); }
    double shearModulus() const override { return moduli_.shear(); }

  private:
    ElasticModuli moduli_;
};
} // namespace mpm::constitutive

#pragma once
/// The linear solid of small-strain theory, made objective, hyperelastic: the nominal stress is linear in the stretch,
/// the rotation taken out. With F = R U = V R, J = det F, F_zz = 1 in plane strain:
///
///     W       = lambda/2 (tr(U - I))^2 + mu (U - I) : (U - I)      per initial volume
///     P       = R T,  T = lambda tr(U - I) I + 2 mu (U - I)          T: Biot stress
///     J sigma = V (lambda tr(V - I) I + 2 mu (V - I))
///
/// Where nothing rotates U = F: the first Piola-Kirchhoff (nominal) stress is linear in the displacement gradient,
/// P = C : (F - I), as in small-strain theory, on however large a stretch; the Cauchy stress follows with the current
/// areas. Confined motion along y: sigma_yy = M (l - 1), sigma_xx = lambda (l - 1)/l. (Biot, "Mechanics of Incremental
/// Deformations", 1965; Ogden, "Non-linear Elastic Deformations", 1984, section 3.5.)
/// Nothing resists a collapse to l = 0: keep to moderate strains.
///
///     law smallStrain;
///     E   1e6;    // [Pa] > 0
///     nu  0.3;    // in (-1, 0.5)
///
/// Tests: tests/unit/hyperelastic.cpp. Errors: InputError for values out of bounds; initial stress is refused.
#include "constitutive/elasticTrial.hpp"

namespace mpm::constitutive
{
class SmallStrain : public Hyperelastic
{
  public:
    explicit SmallStrain(const ElasticModuli& moduli);
    static SmallStrain read(const dictionary::Dictionary& material);

    std::string name() const override { return "smallStrain"; }
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

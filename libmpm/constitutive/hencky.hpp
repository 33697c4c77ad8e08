#pragma once
/// Hencky's solid, hyperelastic: Kirchhoff stress linear in the logarithmic (spatial) strain. With V = sqrt(F F^T),
/// J = det F, F_zz = 1 in plane strain:
///
///     W       = lambda/2 (tr ln V)^2 + mu ln V : ln V      per initial volume
///     J sigma = lambda ln J I + 2 mu ln V
///
/// Anand, "On H. Hencky's approximate strain-energy function for moderate deformations", J. Appl. Mech. 46 (1979)
/// 78-82. In confined motion along y: J sigma_yy = M ln l. Principal values in closed form (leftStretch.hpp).
///
///     law hencky;
///     E   1e6;    // [Pa] > 0
///     nu  0.3;    // in (-1, 0.5)
///
/// Tests: tests/unit/hyperelastic.cpp. Errors: InputError for values out of bounds; initial stress is refused.
#include "constitutive/elasticTrial.hpp"

namespace mpm::constitutive
{
class Hencky : public Hyperelastic
{
  public:
    explicit Hencky(const ElasticModuli& moduli);
    static Hencky read(const dictionary::Dictionary& material);

    std::string name() const override { return "hencky"; }
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

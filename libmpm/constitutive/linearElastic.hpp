#pragma once
/// Isotropic linear elasticity in rate form: stress += lambda tr(dStrain) I + 2 G dStrain in the co-rotated frame.
///
/// In confined motion this integrates sigma = M ln F exactly (M = K + 4/3 G).
///
///     law linearElastic;
///     E   20e6;   // [Pa] > 0
///     nu  0.3;    // in (-1, 0.5)
///
/// Tests: tests/unit/linearElastic.cpp. Errors: InputError for values out of bounds.
#include "constitutive/elasticTrial.hpp"

namespace mpm::constitutive
{
class LinearElastic : public Law
{
  public:
    explicit LinearElastic(const ElasticModuli& moduli);
    static LinearElastic read(const dictionary::Dictionary& material);

    std::string name() const override { return "linearElastic"; }
    std::string describe() const override;
    void update(Chunk<2>& chunk) const override;
    void update(Chunk<3>& chunk) const override;
    double bulkModulus() const override { return moduli_.bulk(); }
    double shearModulus() const override { return moduli_.shear(); }
    const ElasticModuli& moduli() const { return moduli_; }

  private:
    ElasticModuli moduli_;
};
} // namespace mpm::constitutive

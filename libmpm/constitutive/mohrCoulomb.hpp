#pragma once
/// Elastic, perfectly plastic Mohr-Coulomb, s1 >= s2 >= s3, tension positive:
///
///     yield      f = k s1 - s3 - sc <= 0,   k = (1 + sin phi)/(1 - sin phi),  sc = 2 c sqrt(k)
///     potential  g = m s1 - s3,             m = (1 + sin psi)/(1 - sin psi),  psi <= phi
///
/// Exact return in principal space to the face, to both edges and to the apex after Clausen, Damkilde & Andersen,
/// "Efficient return algorithms for associated plasticity with multiple yield planes", Int. J. Numer. Meth. Engng 66
/// (2006) 1036-1059; mohrCoulombReturn.hpp has the formulas. phi = 0 is Tresca's law; it has no apex. c = 0 is allowed.
/// The surface turns with the trial stress: axes are those of the trial stress, the answer of a backward Euler step.
///
/// At psi = 0 the flow rule keeps plastic volume, so beyond p = c cot phi it has no solution. The apex is then the
/// limit psi -> 0+, a convention; the plastic volume it drops, (p_trial - c cot phi)/K, goes to Chunk::apexStrain. For
/// psi > 0 the six planes meeting at the apex span every plastic strain the return needs: apexStrain is 0 there.
/// Chunk::apexReturns counts apex returns for every psi.
///
///     law            mohrCoulomb;
///     E              20e6;   // [Pa] > 0
///     nu             0.42;   // in (-1, 0.5)
///     cohesion       1e3;    // [Pa] >= 0
///     frictionAngle  42;     // [deg] in [0, 90)
///     dilationAngle  0;      // [deg] in [0, frictionAngle]; default 0
///     tensionCutOff  0;      // [Pa] >= 0, largest principal stress (mohrCoulombCutOff.hpp); absent: none
///     softening      { over 0.1; cohesion 0.2e3; referenceLength 0.1; }    // absent: none (softening.hpp)
///     substep        { tolerance 1e-4; }     // absent: none (substep.hpp)
///
/// Tests: tests/unit/mohrCoulomb.cpp, tests/unit/tensionCutOff.cpp, tests/unit/softening.cpp,
/// tests/verification/rateEquations.cpp. Errors: InputError for values out of bounds.
#include "constitutive/mohrCoulombCutOff.hpp"
#include "constitutive/substep.hpp"

namespace mpm::constitutive
{
class MohrCoulomb : public Law
{
  public:
    explicit MohrCoulomb(const MohrCoulombParameters& parameters, std::optional<Substep> substep = {});
    static MohrCoulomb read(const dictionary::Dictionary& material);

    std::string name() const override { return "mohrCoulomb"; }
    std::string describe() const override;
    void update(Chunk<2>& chunk) const override;
    void update(Chunk<3>& chunk) const override;
    double bulkModulus() const override { return parameters_.moduli.bulk(); }
    double shearModulus() const override { return parameters_.moduli.shear(); }
    bool plastic() const override { return true; }
    void reportYield(Chunk<2>& chunk) const override;
    void reportYield(Chunk<3>& chunk) const override;
    double tensionLimit() const override;
    bool dilates() const override { return parameters_.dilationAngle > 0; }
    bool dropsApexVolume() const override;
    bool usesHistory() const override { return parameters_.softening.has_value(); }
    void regularise(double cellSize) override;
    /// Does the limit of tension ever act?
    bool cutsOff() const { return std::isfinite(surface_.limit); }

    const MohrCoulombParameters& parameters() const { return parameters_; }
    const std::optional<Substep>& substep() const { return substep_; }

  protected:
    /// The words of a material; without `friction` there are none for angles.
    static MohrCoulombParameters readParameters(const dictionary::Dictionary& material, bool friction);
    /// Cut-off, softening and sub-steps for describe().
    std::string describeRest() const;

  private:
    template <int dim>
    void updateWhole(Chunk<dim>& chunk) const;
    template <int dim>
    void yieldOf(Chunk<dim>& chunk) const;

    MohrCoulombParameters parameters_;
    CutOffSurface surface_;
    std::optional<Substep> substep_;
    double scale_ = 1; ///< h/referenceLength
};
} // namespace mpm::constitutive

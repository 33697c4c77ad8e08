#pragma once
/// Elastic, perfectly plastic Drucker-Prager: a smooth cone in p = tr sigma/3 and q = sqrt(3/2) |dev sigma|, tension
/// positive,
///
///     yield      f = q + A p - B <= 0         A from phi, B from phi and c
///     potential  g = q + A' p                 A' from psi <= phi as A from phi
///     limit      p <= T                       tensionCutOff, associated flow; absent: none
///
/// (Drucker & Prager, "Soil mechanics and plastic analysis or limit design", Q. Appl. Math. 10 (1952) 157-165.) The
/// cone is matched to Mohr-Coulomb's pyramid by `match`:
///
///     compression  through its edges s1 = s2 (triaxial compression), the cone around it:
///                  A = 6 sin phi/(3 - sin phi),  B = 6 c cos phi/(3 - sin phi)
///     extension    through its edges s2 = s3 (triaxial extension):  3 + sin phi in place of 3 - sin phi
///     planeStrain  same strength in plastic flow under plane strain. There eps_zz = 0 puts s_zz at - a' q sqrt(4/3),
///     a'
///                  = A'/sqrt 27, and with a' = sin psi/sqrt(9 + 3 sin^2 psi), which makes the angle of dilation psi,
///                  A = sqrt 3 sin phi/(sqrt(1 - 3 a'^2) + a' sin phi),  B likewise with c cos phi for sin phi.
///                  psi = phi: A = 3 sqrt 3 tan phi/sqrt(9 + 12 tan^2 phi), the values of the paper of 1952
///
/// (de Souza Neto, Peric & Owen, "Computational Methods for Plasticity", 2008, section 6.4.4, for compression,
/// extension and associated plane strain; psi < phi follows from the same two conditions.) Both axes meet at the apex
/// p = B/A = c cot phi. phi = 0 is von Mises' law with yieldStress B, without an apex.
///
/// Exact return, closed form: on the cone lam = f/(3 G + K A A'), q less by 3 G lam and p less by K A' lam; where that
/// makes q negative the apex. At psi = 0 the flow rule keeps volume and has no solution beyond the apex; the volume
/// (p_trial - B/A)/K dropped there goes to Chunk::apexStrain, as in mohrCoulomb.hpp. A limit T < B/A: the return to p =
/// T alone where that leaves f <= 0, else the ring q = B - A T; it needs no apex, and no volume is dropped. Directions
/// of the deviator are those of the trial stress.
///
///     law            druckerPrager;
///     E              20e6;          // [Pa] > 0
///     nu             0.3;           // in (-1, 0.5)
///     cohesion       1e3;           // [Pa] >= 0
///     frictionAngle  30;            // [deg] in [0, 90)
///     dilationAngle  0;             // [deg] in [0, frictionAngle]; default 0
///     match          planeStrain;   // compression, extension or planeStrain (default)
///     tensionCutOff  0;             // [Pa] >= 0, largest mean stress; absent: none
///     substep        { tolerance 1e-4; }     // absent: none (substep.hpp)
///
/// Tests: tests/unit/druckerPrager.cpp, tests/verification/rateEquations.cpp. Errors: InputError for values out of
/// bounds.
#include "constitutive/substep.hpp"

#include <limits>

namespace mpm::constitutive
{
/// Where the cone meets Mohr-Coulomb's pyramid.
enum class ConeMatch
{
    compression,
    extension,
    planeStrain
};

/// What a user gives. Angles in degrees, stresses in Pa.
struct DruckerPragerParameters
{
    ElasticModuli moduli;
    double cohesion = 0;
    double frictionAngle = 0;
    double dilationAngle = 0;
    ConeMatch match = ConeMatch::planeStrain;
    double tensionCutOff = std::numeric_limits<double>::infinity();
};

/// f = q + slope p - strength, g = q + flow p.
struct DruckerPragerCone
{
    double slope, flow; ///< A, A'
    double strength;    ///< B [Pa]
    double apex;        ///< B/A, infinite for phi = 0 [Pa]
    double limit;       ///< T, infinite where it cannot act [Pa]

    explicit DruckerPragerCone(const DruckerPragerParameters& parameters);
};

class DruckerPrager : public Law
{
  public:
    explicit DruckerPrager(const DruckerPragerParameters& parameters, std::optional<Substep> substep = {});
    static DruckerPrager read(const dictionary::Dictionary& material);

    std::string name() const override { return "druckerPrager"; }
    std::string describe() const override;
    void update(Chunk<2>& chunk) const override;
    void update(Chunk<3>& chunk) const override;
    double bulkModulus() const override { return parameters_.moduli.bulk(); }
    double shearModulus() const override { return parameters_.moduli.shear(); }
    bool plastic() const override { return true; }
    void reportYield(Chunk<2>& chunk) const override;
    void reportYield(Chunk<3>& chunk) const override;
    double tensionLimit() const override { return std::min(cone_.apex, cone_.limit); }
    bool dilates() const override { return cone_.flow > 0; }
    bool dropsApexVolume() const override
    {
        return cone_.flow == 0 && cone_.slope > 0 && !(cone_.limit < cone_.apex) && !substep_;
    }

    const DruckerPragerParameters& parameters() const { return parameters_; }
    const DruckerPragerCone& cone() const { return cone_; }
    const std::optional<Substep>& substep() const { return substep_; }

  private:
    DruckerPragerParameters parameters_;
    DruckerPragerCone cone_;
    std::optional<Substep> substep_;
};
} // namespace mpm::constitutive

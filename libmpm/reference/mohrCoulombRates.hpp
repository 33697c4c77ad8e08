#pragma once
/// Stress rates of perfectly plastic Mohr-Coulomb on each part of its surface, in tensor form.
///
/// With D the isotropic stiffness, T = D e' the elastic rate, s1 >= s2 >= s3 and their directions n1, n2, n3:
///
///     elastic   sigma' = T
///     face      sigma' = T - lam D b,  a = k n1 n1 - n3 n3,  b = m n1 n1 - n3 n3,  lam = a:T/(a:D b)  (a:sigma' = 0)
///     edge 1    s1 = s2: b = m P - (tr P) n3 n3 with a 2 x 2 tensor P in the plane of n1, n2. The planes of all
///               directions in that plane meet here; P collects their multipliers and is positive semi-definite. The
///               part of sigma' in the plane must stay isotropic, and f' = 0:
///               dev P = dev T_12/(2 G m),  tr P = (k mean T_12 - T_33)/((k-1)(m-1) lame + G (k m + 2))
///     edge 2    s2 = s3: b = m (tr Q) n1 n1 - Q with Q in the plane of n2, n3:
///               dev Q = -dev T_23/(2 G),  tr Q = (k T_11 - mean T_23)/((k-1)(m-1) lame + G (2 k m + 1))
///     apex      sigma' = 0 while e' lies in the cone of plastic flow: with e1 >= e2 >= e3 principal rates,
///               e1 + e2 + m e3 >= 0 and e1 + m e2 + m e3 >= 0. For psi = 0 that is tr e' >= 0, by convention (see
///               constitutive/mohrCoulomb.hpp).
///
/// The equations are those of the continuum, written independently of the return map they are to judge.
#include "constitutive/mohrCoulomb.hpp"

#include <Eigen/Dense>

namespace mpm::reference
{
using constitutive::Region;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Principal values and their directions (columns), sorted or followed from an earlier frame.
struct Frame
{
    Vector3d values;
    Matrix3d axes;
};

/// s1 >= s2 >= s3.
Frame sortedFrame(const Matrix3d& sigma);
/// The permutation whose axes agree best with `former`, so that differences of values may change sign.
Frame followedFrame(const Matrix3d& sigma, const Matrix3d& former);

class MohrCoulombRates
{
  public:
    explicit MohrCoulombRates(const constitutive::MohrCoulombParameters& parameters);

    double strength() const { return strength_; } ///< sc [Pa]
    double apex() const { return apex_; }         ///< c cot phi [Pa]
    bool hasApex() const { return k_ > 1; }
    /// f of the sorted principal stresses [Pa].
    double yield(const Matrix3d& sigma) const;
    Matrix3d elastic(const Matrix3d& strainRate) const;

    struct Rate
    {
        Matrix3d stress;
        double margin; ///< smallest multiplier: the region is left when it turns negative; 1 in the elastic region
    };
    Rate rate(Region region, const Frame& frame, const Matrix3d& strainRate) const;

    /// Which region the response starts in at a state on the surface whose first two or last two values count as equal
    /// (`same12`, `same23`). `left` is a region that has just been left by its own margin or yield function and does
    /// not come into question.
    Region decide(const Frame& frame, const Matrix3d& strainRate, bool same12, bool same23,
                  std::optional<Region> left) const;
    /// The axes in which the stress leaves repeated values: those of the elastic rate in their plane, or in space.
    Frame departure(const Frame& frame, const Matrix3d& strainRate, bool same12, bool same23) const;

  private:
    Region decideAtApex(const Matrix3d& strainRate, std::optional<Region> left) const;

    double k_, m_, strength_, apex_, lame_, shear_;
};
} // namespace mpm::reference

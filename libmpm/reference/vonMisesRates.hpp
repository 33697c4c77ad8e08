#pragma once
/// Rate equations of perfectly plastic von Mises with associated flow (constitutive/vonMises.hpp), by CVODE:
///     elastic   sigma' = D e'
///     plastic   sigma' = D e' - 2 G <n : e'> n,   n = s/|s|,   while |s| = R = sqrt(2/3) yieldStress and n : e' > 0
/// Yielding (|s| = R from below) and unloading (n : e' = 0 from above) are events, at which the solver starts anew.
/// Where e' keeps its direction the angle psi between s and the deviator of e' has the closed form of Krieg & Krieg
/// (1977), tan(psi/2) = tan(psi_0/2) exp(-2 G |dev e'| t/R). Verified against it in
/// tests/verification/rateEquations.cpp.
#include "reference/rateEquations.hpp"

namespace mpm::reference
{
struct VonMisesParameters
{
    constitutive::ElasticModuli moduli;
    double yieldStress; ///< [Pa], uniaxial
};

/// Throws InputError if the start stress lies outside the surface.
RateSolution integrateRates(const VonMisesParameters& parameters, const SymmetricTensor& start, const StrainPath& path,
                            const RateTolerances& tolerances = {});
} // namespace mpm::reference

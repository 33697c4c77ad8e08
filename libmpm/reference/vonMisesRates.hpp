#pragma once
/// Rate equations of perfectly plastic von Mises and Drucker-Prager (constitutive/vonMises.hpp, druckerPrager.hpp), by
/// CVODE. On the cone f = q + A p - B with the potential q + A' p (von Mises: A = A' = 0, B = yieldStress), n = s/|s|:
///     elastic   sigma' = D e'
///     plastic   sigma' = D e' - lam (3 G n sqrt(2/3) + K A' I),
///               lam = <sqrt 6 G n : e' + K A tr e'>/(3 G + K A A')   while f = 0 and lam > 0
/// Yielding (f = 0 from below) and unloading (lam = 0 from above) are events, at which the solver starts anew. A path
/// that reaches the apex, or a limit of tension, is not answered.
/// Where e' keeps its direction the angle psi between s and the deviator of e' has the closed form of Krieg & Krieg
/// (1977), tan(psi/2) = tan(psi_0/2) exp(-2 G |dev e'| t/R). Verified against it in
/// tests/verification/rateEquations.cpp.
#include "constitutive/druckerPrager.hpp"
#include "reference/rateEquations.hpp"

namespace mpm::reference
{
struct VonMisesParameters
{
    constitutive::ElasticModuli moduli;
    double yieldStress; ///< [Pa], uniaxial
};

/// Without a limit of tension. Throws as below, and StepError at the apex.
RateSolution integrateRates(const constitutive::DruckerPragerParameters& parameters, const SymmetricTensor& start,
                            const StrainPath& path, const RateTolerances& tolerances = {});

/// Throws InputError if the start stress lies outside the surface.
RateSolution integrateRates(const VonMisesParameters& parameters, const SymmetricTensor& start, const StrainPath& path,
                            const RateTolerances& tolerances = {});
} // namespace mpm::reference

#pragma once
/// Trusted solutions of the elastoplastic rate equations of Mohr-Coulomb (mohrCoulombRates.hpp), to judge the return
/// map.
///
/// CVODE integrates sigma' inside one region; yielding (f = 0 from below), unloading (a multiplier turns negative),
/// meeting an edge (s1 = s2 or s2 = s3) or the apex, and leaving them are events. The integrator starts anew at each
/// event and at each break of the strain path. Near an edge the axes turn as fast as the gap is small, so an edge is
/// left by one explicit step that opens a gap the integrator can resolve. f = 0 is kept by differentiation only; its
/// drift is reported. Material axes do not turn: a path is that of a co-rotated frame.
///
///     const auto path = StrainPath::harmonic(components, 1.0);
///     const RateSolution exact = integrateRates(parameters, start, path);
///     for (const auto& row : judgeReturnMap(MohrCoulomb(parameters), start, path, exact, {1, 2, 4})) ...
///
/// Verified by tests/verification/rateEquations.cpp. Errors: InputError if the start stress lies outside the surface;
/// StepError if CVODE fails or events pile up without progress.
#include "constitutive/mohrCoulomb.hpp"
#include "reference/strainPath.hpp"

#include <optional>

namespace mpm::reference
{
using constitutive::Region;

struct RateEvent
{
    double time;
    Region region; ///< entered
};

struct RateSolution
{
    std::vector<SymmetricTensor> stress; ///< at the breaks of the path [Pa]
    std::vector<RateEvent> events;       ///< the first is the region the path starts in
    std::optional<double> yieldTime;     ///< of the first entry into a plastic region
    double drift = 0;                    ///< largest |f|/max(|sigma|, sc) in plastic regions
    long evaluations = 0;                ///< of the right-hand side
};

struct RateTolerances
{
    double relative = 1e-12;
    double absolute = 1e-14; ///< over the stress scale max(|start|, sc)
    double edge = 1e-11;     ///< principal stresses closer than this over the stress scale are equal
    double departure = 1e-9; ///< edges and the apex are left by one Heun step that opens this gap over the stress scale
};

RateSolution integrateRates(const constitutive::MohrCoulombParameters& parameters, const SymmetricTensor& start,
                            const StrainPath& path, const RateTolerances& tolerances = {});

/// The return map along the same path, each piece in `steps` steps of equal time with their exact strain increments.
struct ReturnMapError
{
    int steps;
    double final;                ///< |sigma - exact|/|exact| at the end, over the stored components
    double largest;              ///< largest |sigma - exact| at the breaks over the largest |exact|
    double yield;                ///< f/max(|sigma|, sc) at the end
    std::optional<double> order; ///< log2 of the error at half the steps over this one
    SymmetricTensor stress;      ///< at the end
};

/// The same law in sub-steps (constitutive/substep.hpp) and the price of it.
struct SubstepError
{
    int steps;
    double final;           ///< as above
    double largest;         ///< as above
    double yield;           ///< as above
    double calls;           ///< evaluations of the plain law a step
    double time;            ///< seconds a step over those of the plain law
    SymmetricTensor stress; ///< at the end
};

/// `law` works in sub-steps, `plain` is the law without them. Steps are those of the time step: where a path's axes
/// spin, the strain of a step stands still in them and the stress turns.
std::vector<SubstepError> judgeSubsteps(const constitutive::Law& law, const constitutive::Law& plain,
                                        const SymmetricTensor& start, const StrainPath& path, const RateSolution& exact,
                                        const std::vector<int>& steps);

std::vector<ReturnMapError> judgeReturnMap(const constitutive::Law& law, const SymmetricTensor& start,
                                           const StrainPath& path, const RateSolution& exact,
                                           const std::vector<int>& steps);
} // namespace mpm::reference

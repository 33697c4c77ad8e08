#pragma once
/// The accuracy of a material's stress update along strain paths (checkIntegration -law): what
/// system/checkIntegrationDict asks for, the comparison with the rate equations, and its tables.
///
///     material    soil;                   // dictionary in constant/materialProperties, for paths without a law of
///                                         // their own and for recorded paths
///     steps       (1 2 4 8 16 32 64 128 256 512);   // of the return map over a path; this is the default
///     paths                               // optional
///     {
///         rotatingShear
///         {
///             law mohrCoulomb;  E 20e6;  nu 0.42;  cohesion 1e3;  frictionAngle 42;    // or none of them: material
///             substep { tolerance 1e-4; }  // a law in sub-steps (constitutive/substep.hpp) is judged with and without
///             startStress (-40e3 -60e3 -48e3 0 0 0);       // [Pa] xx yy zz xy yz zx, default zero
///             endTime     1;                               // [s]
///             spin        0;       // [rad/s] the rates below are those of axes that turn so about z in the material
///             rate                                         // xx yy zz xy yz zx; those not there are zero
///             {
///                 xx { function cos; amplitude  1e-2; angularFrequency 2.4; }   // 1e-2 cos 2.4 t [1/s], [rad/s]
///                 yy { function cos; amplitude -1e-2; angularFrequency 2.4; }
///                 xy { function sin; amplitude  1e-2; angularFrequency 2.4; }
///             }
///         }
///     }
///     recorded                            // optional: paths mpmSolve recorded (recordStrain of controlDict)
///     {
///         file         "postProcessing/strainPaths.csv";   // default
///         particles    (12 345);          // ids, default: all in the file
///         from 0;  to 2.5;                // [s] part of the record, default: all of it
///         subdivisions (1 2 4 8 16 32);   // steps of the return map in each recorded increment; this is the default
///     }
///
/// A table of recorded paths has the columns particle, time, exx ... ezx (accumulated strain in the co-rotated frame)
/// and sxx ... szx (stress there); the path starts at the first row's stress. `recordError` compares the return map in
/// undivided increments with the recorded stress: round-off, unless the record is not of this law.
///
/// A strain rate whose axes turn by w t in the material is what a step of constant velocity gradient with the spin -w
/// does. The return map's rows take the exact strain of each step as the material sees it; sub-steps are judged as in
/// the time step, where the strain stands still and the stress turns: give such a path as a constant rate with `spin`.
/// Errors: InputError with file:line; mohrCoulomb and tresca (without tensionCutOff and softening),
/// druckerPrager (likewise) and vonMises have rate equations.
#include "base/csvTable.hpp"
#include "dictionary/dictionary.hpp"
#include "reference/rateEquations.hpp"

#include <filesystem>
#include <map>

namespace mpm::reference
{
using Laws = std::map<std::string, std::shared_ptr<const constitutive::Law>>;

struct LawCheck
{
    std::string name; ///< of the path, or "particle 12"
    std::shared_ptr<const constitutive::Law> law;
    SymmetricTensor start{};
    StrainPath path;
    std::vector<int> steps;
    std::optional<SymmetricTensor> recordedEnd; ///< last recorded stress
};

struct LawCheckResult
{
    RateSolution exact;
    std::vector<ReturnMapError> rows;
    std::vector<SubstepError> substeps; ///< of a law in sub-steps
    std::optional<double> recordError;  ///< |return map in recorded increments - record|/largest |exact|
};

/// Everything a dictionary asks for; `laws` are the materials of the case, `folder` is the case.
std::vector<LawCheck> readLawChecks(const dictionary::Dictionary& dict, const Laws& laws,
                                    const std::filesystem::path& folder);

/// Throws InputError for a law without rate equations.
LawCheckResult runLawCheck(const LawCheck& check);

/// A heading with regions, yield time and drift, and one line a number of steps.
std::string lawCheckText(const LawCheck& check, const LawCheckResult& result);
/// Appends path, method (returnMap or substep), steps, error, largestError, order, yield, lawCalls, timeRatio,
/// yieldTime, drift, recordError.
void addLawCheckRows(CsvTable& table, const LawCheck& check, const LawCheckResult& result);
CsvTable lawCheckTable();
} // namespace mpm::reference

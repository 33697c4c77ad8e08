#pragma once
/// The temporal error of each scheme in a case (checkIntegration -time), beside the spatial error where an exact
/// solution is given.
///
///     time                                    // system/checkIntegrationDict
///     {
///         window    0.015;                    // [s] from the stored time on
///         courant   (0.8 0.4 0.2 0.1 0.05);   // c_p dt/h of the runs, falling; default (0.4 0.2 0.1 0.05)
///         deltaT    (1e-4 5e-5);              // [s] instead of courant
///         schemes   (USL MUSL RK4);           // default: all that the case can run, of
///                                             // USF USL MUSL staggeredUSL staggeredMUSL RK2 RK4
///         tolerance 1e-12;                    // of the reference
///         exact     { displacement ("..." "..."); constants { ... } }   // optional: dictionary/expression.hpp
///     }
///
/// Each run starts from the stored state and takes round(window/dt) equal steps, at least 1. Its error is the RMS
/// distance of its particles from the reference at the end of the window, sqrt(sum |x - x_ref|^2/N) [m]: positions,
/// because velocities of a staggered scheme belong to another time. The reference is
///     the semi-discrete equations by CVODE       where laws, walls and shape are smooth; its own error is the distance
///                                                from a solution to 100 times the tolerance
///     the scheme itself                          elsewhere, extrapolated from its smallest dt and half of it with
///                                                the order seen there (Richardson); its own error is at most the
///                                                error of the run at half the smallest dt, which is printed
/// `spatial` is the distance of the reference from the exact solution, `total` that of the run.
///
/// Errors: InputError with file:line; a run that fails is a row that says why.
#include "base/csvTable.hpp"
#include "case/readScene.hpp"
#include "semiDiscrete/semiDiscrete.hpp"

namespace mpm::cases
{
/// Solves the semi-discrete equations over a window: y at its end. (SUNDIALS is in reference/, which this library does
/// not need.)
using ReferenceSolver =
    std::function<std::vector<double>(semiDiscrete::SemiDiscrete& equations, const state::State& state,
                                      const semiDiscrete::Model& model, double window, double tolerance)>;

/// Displacement of a particle by its reference position, at a time.
using ExactDisplacement = std::function<Vector3(const Vector3& X, double time)>;

struct TimeCheck
{
    double window = 0;          ///< [s]
    std::vector<double> deltaT; ///< [s], falling
    std::vector<std::string> schemes;
    double tolerance = 1e-12;
    ExactDisplacement exact; ///< empty: none is known
};

struct TimeCheckRow
{
    std::string scheme;
    double deltaT = 0;
    int steps = 0;
    double error = 0;            ///< from the reference [m]
    std::optional<double> order; ///< from the row before
    std::optional<double> total; ///< from the exact solution [m]
    std::string failure;         ///< why there is no error
};

struct TimeCheckResult
{
    std::string noOde;                                      ///< why the reference is no ODE; empty if it is
    double waveSpeed = 0;                                   ///< c_p [m/s]
    double referenceError = 0;                              ///< own error of the reference [m]
    std::vector<std::pair<std::string, double>> pairErrors; ///< of each scheme's reference where there is no ODE [m]
    std::optional<double> spatial;                          ///< of the reference [m]
    std::vector<TimeCheckRow> rows;
};

TimeCheck readTimeCheck(const dictionary::Dictionary& dict, const SceneOfCase& scene, const state::State& state);
TimeCheckResult runTimeCheck(const TimeCheck& check, const SceneOfCase& scene, const state::State& start,
                             const ReferenceSolver& solver);
std::string timeCheckText(const TimeCheck& check, const TimeCheckResult& result, const SceneOfCase& scene,
                          const state::State& start);
/// scheme, deltaT, courant, steps, temporalError, order, spatialError, totalError, referenceError, failure
CsvTable timeCheckTable(const TimeCheckResult& result, double cellSize);

/// The schemes by name, and why a scene cannot run one (empty: it can).
const std::vector<dictionary::Choice>& schemeCatalogue();
std::string whyNotScheme(const std::string& scheme, const SceneOfCase& scene);
/// A stepper of the scheme for a copy of the scene.
std::unique_ptr<stepping::Stepper> makeScheme(const std::string& scheme, const SceneOfCase& scene, state::State& state);
} // namespace mpm::cases

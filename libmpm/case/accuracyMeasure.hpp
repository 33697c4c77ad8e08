#pragma once
/// What is called the error of a run: dictionaries of `measures` in system/accuracyCostDict.
///
///     measures
///     {
///         displacement                    // a field of the particles: position, displacement, velocity, stress
///         {
///             field       displacement;
///             component   y;              // or xx yy zz xy yz zx of stress; absent: all
///             norm        rms;            // rms (default, weighted by initial volume) | max
///             over        end;            // end (default) | storedTimes: the largest of all stored times
///             against     exact;
///         }
///         runOut                          // a scalar: a column of postProcessing/history.csv
///         {
///             history     maxX;
///             take        end;            // end (default) | maximum | minimum | mean | rate
///             window      0.1;            // [s] before the end, of mean and rate (d/dt: a force from an impulse)
///             against     finest;
///             scale       1;
///         }
///         basePressure                    // a profile: mean stress of the particles in boxes side by side, at the end
///         {
///             profile     stress;
///             component   yy;
///             low         (-6 0 0);       // [m] corners of all boxes together
///             high        (10 0.4 0);
///             bins        16;             // along x; a box without particles counts as zero
///             against     finest;
///         }
///     }
///
/// against   exact            the solution in `exact` (accuracyExact.hpp); fields only
///           number           `value`, in the scalar's own unit
///           finest           the finest run: smallest cells, then smallest step, then most particles
///           finestTimeStep   the run of the same grid and method with the smallest step: the temporal error alone
///           semiDiscrete     the semi-discrete equations of the same grid and shape, by CVODE to tight tolerance
///                            (accuracyIntegration.hpp): the temporal error alone, of any method; fields of smooth
///                            scenes
/// scale     the error is divided by it; default: the size of what it is compared with, so that errors are relative
///
/// Fields follow particles by their ids; where the particles are others, a linear fit to the nearest ones of the finest
/// run, at the same material position, is taken. Fields of runs that split particles have no material position for the
/// new ones and are refused; histories and profiles are not.
#include "case/accuracyExact.hpp"
#include "case/caseDirectory.hpp"

#include <optional>

namespace mpm::cases
{
enum class MeasureKind
{
    field,
    history,
    profile
};

struct Measure
{
    std::string name;
    MeasureKind kind = MeasureKind::field;
    std::string of;              ///< field, or column of history.csv
    std::vector<int> components; ///< of a field
    bool largest = false;        ///< norm max
    bool storedTimes = false;
    std::string take = "end";
    double window = 0; ///< [s]
    Vector3 low{}, high{};
    Index bins = 0;
    std::string against;
    double number = 0; ///< with `against number`
    std::optional<double> scale;
    bool scalar() const { return kind == MeasureKind::history; }
};

std::vector<Measure> readMeasures(const dictionary::Dictionary& accuracyCostDict, const ExactSolution& exact, int dim);

/// What a run gave: one value, values of boxes, or a field.
struct Sample
{
    std::vector<double> values; ///< particle by particle, `components` each
    int components = 1;
    int dim = 2;
    double time = 0;             ///< [s]
    std::vector<Vector3> X;      ///< material positions, of a field
    std::vector<double> weights; ///< initial volumes, of a field
    double spacing = 0;          ///< of the particles [m]
};

/// At the end of a run. Throws InputError where it cannot be had.
Sample takeSample(const Measure& measure, const CaseDirectory& run);
/// The exact solution for the same particles.
Sample exactSample(const Measure& measure, const Sample& like, const ExactSolution& exact);
/// The largest error against the exact solution, at the end or over all stored times, and the solution's own size then.
std::pair<double, double> exactError(const Measure& measure, const CaseDirectory& run, const ExactSolution& exact);

/// Of the values.
double sampleSize(const Measure& measure, const Sample& sample);
/// Of a - b, at the particles of a.
double sampleDistance(const Measure& measure, const Sample& a, const Sample& b);
} // namespace mpm::cases

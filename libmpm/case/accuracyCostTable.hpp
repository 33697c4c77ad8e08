#pragma once
/// What came out of the rows: postProcessing/accuracyCost.csv, one line a row and error measure.
///
///     row                 the row's name, its folder below accuracyCost/
///     method              its curve
///     cellSize ... splitting      settings as they were in effect (accuracyMatrix.hpp); empty: does not apply
///     courant, deltaT     c_p deltaT/cellSize with the largest c_p at rest [-], and the step [s]
///     status, reason      done; refused: impossible or wrong, not begun; failed: could not go on
///     errorMeasure, against       (accuracyMeasure.hpp)
///     error               divided by errorScale; of the reference run itself its estimate, referenceError
///     errorScale          in the measure's own unit
///     value, reference    of scalars: what came out and what it is compared with
///     referenceRow, referenceError    the row compared with, and what it is thought to be wrong by (Richardson over
///     its
///                         cell sizes, in units of `error`); errors below twice that are not resolved
///     temporalError       difference to the run of the same grid and method with the smallest step
///     spatialError        error of that run
///     pareto              1: no other run is cheaper and at least as accurate
///     cpuSeconds ... sideBySide   (accuracyRun.hpp)
///     particles, steps, particleSteps, cells, nsPerParticleStep, endTime
///     machine, version, key
#include "base/csvTable.hpp"
#include "case/accuracyMeasure.hpp"
#include "case/accuracyRun.hpp"
#include "case/timeCheck.hpp"

#include <cmath>

namespace mpm::cases
{
/// One line; numbers that are not there are NaN.
struct CostLine
{
    std::size_t row = 0, measure = 0; ///< which
    std::string note;                 ///< why there is no error although the row is done
    double error = NAN, scale = NAN, value = NAN, reference = NAN, referenceError = NAN, temporal = NAN, spatial = NAN;
    std::string referenceRow;
    bool pareto = false;
};

struct Evaluation
{
    std::vector<MatrixRow> rows;
    std::vector<RowFacts> facts;
    std::vector<RowResult> results;
    std::vector<Measure> measures;
    std::vector<CostLine> lines; ///< measure by measure, each in the order of the rows; rows not run are left out
};

/// `reference`: index of the row that is the finest by decision, or nothing. `solver`: for `against semiDiscrete`.
Evaluation evaluate(const AccuracyCase& base, std::vector<MatrixRow> rows, std::vector<RowResult> results,
                    std::vector<Measure> measures, const ExactSolution& exact, std::optional<std::size_t> reference,
                    const ReferenceSolver& solver = {});

CsvTable costTable(const Evaluation& evaluation);
} // namespace mpm::cases

#pragma once
/// postProcessing/accuracyCost.csv, the table of the utility accuracyCost, as mpmSolve reads it: what runs of this case
/// with other settings cost and how wrong they were.
///
/// One line a row of the matrix and error measure. Of its columns these are used: row, cellSize, particlesPerCell,
/// shape, transfer, order, picRate, stressUpdate, staggeredStart, timeIntegration, splitting, courant, deltaT, status,
/// errorMeasure, error, referenceError, referenceRow, cpuSeconds, particleSteps, nsPerParticleStep, endTime, machine,
/// version; others are passed over. Rows whose status is not `done` say nothing about accuracy.
///
/// Errors: a missing file or column, a cell that is no number, a measure that is not in the table.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpm::cases
{
/// The words a run is set by.
struct RunSetting
{
    double cellSize = 0;                                                                        ///< [m]
    long particlesPerCell = 0;                                                                  ///< per axis
    std::string shape, transfer, order, picRate, stressUpdate, staggeredStart, timeIntegration; ///< as written
    bool splitting = false;
    double courant = 0; ///< c_p deltaT/cellSize
    double deltaT = 0;  ///< [s]

    /// Same method: all words, the seeding and the time step apart.
    bool sameMethod(const RunSetting& o) const;
    /// Same cells and particles in them.
    bool sameSeeding(const RunSetting& o) const;
    /// "cpGIMP, FLIP, MUSL, cells of 0.25 m, 2 x 2 particles, Courant number 0.5".
    std::string describe() const;
};

struct AccuracyRow
{
    std::string name;
    RunSetting setting;
    double error = 0;          ///< as it was measured
    double referenceError = 0; ///< of what it was measured against
    double cpuSeconds = 0;     ///< of the steps
    double particleSteps = 0, nsPerParticleStep = 0;
    double endTime = 0; ///< [s]
    std::string machine, version;

    /// The error that can be vouched for: no smaller than twice that of the reference.
    double bound() const { return error > 2 * referenceError ? error : 2 * referenceError; }
};

/// What is known about the error of a setting.
struct ExpectedError
{
    double error = 0;
    std::optional<double> order; ///< of the fit in cellSize, where there was one
    std::string basis;           ///< where it comes from
};

class ErrorTable
{
  public:
    /// Rows that were done, of one measure (default: the first).
    explicit ErrorTable(const std::filesystem::path& file, const std::string& measure = {});

    const std::filesystem::path& file() const { return file_; }
    const std::string& measure() const { return measure_; }
    const std::vector<AccuracyRow>& rows() const { return rows_; }

    /// That of the row with this setting; else a fit of log error against log cellSize through the rows of the same
    /// method, at the Courant number nearest to the setting's; else that of the row most like it, said so.
    std::optional<ExpectedError> expect(const RunSetting& setting) const;
    /// The row most like a setting.
    const AccuracyRow* nearest(const RunSetting& setting) const;

  private:
    std::filesystem::path file_;
    std::string measure_;
    std::vector<AccuracyRow> rows_;
};
} // namespace mpm::cases

#pragma once
/// Can the stresses of a stored time be trusted? Everything the utility stressQuality says of it, as numbers of one
/// row of postProcessing/stressQuality.csv:
///
///     time [s], then as shares (RMS errors in Pa):
///     noiseYY              N = RMS(raw - smoothed)/RMS(smoothed) of sigma_yy (smoothing/componentNoise.hpp)
///     overburdenCorrelation, overburdenRmsError [Pa]
///                          raw normal stress along gravity against the weight above (smoothing/overburden.hpp); not
///                          numbers without gravity along one axis
///     volumeError          volume the law's returns to the apex made beyond the flow rule, of the initial volume
///     remedyEnergyLoss     sum of |relaxationLoss|, |averagingLoss|, |viscosityLoss|, |gapWork| below
///     particles            [1]
///     noiseXX, noiseZZ, noiseXY (noiseYZ, noiseZX in 3D)
///                          N of the other components
///     noiseXYOfMean (...)  noise of a shear component over the RMS of the smoothed mean stress: its own RMS may be
///                          next to nothing
///     noiseMean            N of the mean stress
///     noiseVertical, noiseByMass, noiseFloor
///                          of the normal stress along gravity (sigma_yy without gravity): N, N with means by mass, N
///                          of the overburden itself, which smoothing alone makes (smoothing/stressQuality.hpp)
///     meanStress           RMS of the smoothed mean stress [Pa]
///     checkerboard, checkerboardAmplitude, checkerboardCells
///                          share, amplitude over pressure, cells looked at (smoothing/checkerboard.hpp)
///     yieldViolation, tensionViolation, massInTension
///                          smoothing/admissibility.hpp, over meanStress
///     volumeChange, elasticVolumeChange, inelasticVolumeChange
///                          smoothing/volumeBudget.hpp; the last two need the state of step 0. The last is volumeError,
///                          seen in the particles, where the flow rule keeps volume
///     releasedEnergy       [J], per metre in 2D: gravityWork + tractionWork + bodyForceWork of the ledger; where these
///                          are zero, the kinetic and elastic energy at the start
///                          (a body that swings hands the work of gravity back: compare times of the same phase)
///     relaxationLoss, averagingLoss, gapWork, transferLoss (viscosityLoss: at the end)
///                          entries of the ledger over releasedEnergy; 0 where the ledger has no such entry. What
///                          filters of velocity (PIC, XPIC) take is part of transferLoss, with what every transfer
///                          takes: it is no part of remedyEnergyLoss
/// and against another case (-against; smoothing/referenceField.hpp), of the normal stress along gravity:
///     errorAgainstRaw, errorAgainstSmoothed, errorAgainstRawByMass [Pa]
///                          RMS of raw and smoothed - the other's nodal field at our particles
///     relativeErrorAgainstRaw, relativeErrorAgainstSmoothed
///                          the same over the RMS of the other's field there
///     massCompared         share of our mass where the other has material; not numbers at times the other has not got
/// and at the end:
///     noiseBeyondFilter, noiseFloorOfField
///                          of sigma_yy: what is no part of the filtered field f, and the N that f alone has, both over
///                          RMS(smoothed) (smoothing/filteredNoise.hpp). noiseYY cannot fall below the second unless
///                          the field is made smoother than it is
///
/// Stress relaxation that acts at intervals does so at the start of a step, so the state stored before it is that of
/// the most noise: pick a writeInterval of a whole number of intervals.
#include "base/terminal.hpp"
#include "constitutive/material.hpp"
#include "smoothing/admissibility.hpp"
#include "smoothing/checkerboard.hpp"
#include "smoothing/componentNoise.hpp"
#include "smoothing/filteredNoise.hpp"
#include "smoothing/referenceField.hpp"
#include "smoothing/stressQuality.hpp"
#include "smoothing/volumeBudget.hpp"

#include <optional>

namespace mpm::cases
{
/// Shares of `released`.
struct RemedyLoss
{
    double released = 0; ///< [J]
    double relaxation = 0, averaging = 0, viscosity = 0, gap = 0, transfer = 0;
    double total = 0; ///< of the first three, as absolute values
};

/// Entries are found by their names; where nothing was released shares of 0 are 0 and others not numbers.
RemedyLoss remedyLoss(const state::Ledger& ledger);

struct StressReport
{
    int dim = 2;
    double time = 0; ///< [s]
    Index particles = 0;
    smoothing::StressQuality quality; ///< along gravity
    smoothing::ComponentNoise noise;
    smoothing::FilteredNoise filtered;
    smoothing::Checkerboard checkerboard;
    smoothing::Admissibility admissibility;
    smoothing::VolumeBudget volume;
    RemedyLoss loss;
    std::optional<smoothing::Comparison> against; ///< if the other case has the time
};

/// What a report needs besides a state.
struct StressReporting
{
    std::string shape;
    Vector3 gravity{};
    std::vector<constitutive::Material> materials; ///< in the order of State::materials
    double elasticVolumeAtStart = 0;               ///< not a number without a state of step 0
    std::string otherShape = {};
};

/// `other`: the state to compare with, or null.
StressReport stressReport(const state::State& state, const StressReporting& with, const state::State* other = nullptr);

/// Columns and values of the CSV file; `against` adds those of the comparison.
std::vector<std::string> stressReportColumns(int dim, bool against);
std::vector<double> stressReportRow(const StressReport& report, bool against);

/// For people: what matters most as two tables, one row a time.
class StressReportTables
{
  public:
    explicit StressReportTables(bool against);
    void row(const StressReport& report, const std::string& time);
    /// The tables, each below a line that says what its columns are.
    std::string text() const;

  private:
    bool against_;
    int axis_ = 1;
    Table stress_, body_;
};
} // namespace mpm::cases

#pragma once
/// The case accuracyCost is run in, and the copies of it that its rows are.
///
/// Steps are shortened so that endTime, or each writeInterval where all stored times are compared, is a whole number of
/// them: runs of different steps are seen at the same times.
///
/// A row's case lies in <case>/accuracyCost/<row>/: constant, geometry and the dictionaries of system, in which only
/// the values of the row's settings are changed (accuracyText.hpp). Besides, in controlDict: startFrom startTime 0,
/// deltaT, one state at endTime unless all stored times are wanted, purgeWrite 0, and no recordStrain. Words of
/// mpmSchemes that only another transfer has (picRate, order) are left out.
#include "case/accuracyMatrix.hpp"
#include "case/caseDirectory.hpp"

namespace mpm::cases
{
/// What a row comes to once the case's own values are filled in.
struct RowFacts
{
    Setting effective; ///< every axis that applies, courant and deltaT as they come out
    Setting declared;  ///< the same, the time step as it was asked for: what tells rows of one family
    double cellSize = 0, courant = 0, deltaT = 0, endTime = 0;
    Index steps = 0;     ///< expected; 0 with adjustTimeStep
    Index cells = 0;     ///< of the grid's box
    double work = 0;     ///< particles in a full box times steps: a first guess at what the row costs
    std::string refused; ///< why it cannot be run; empty if nothing speaks against it
};

class AccuracyCase
{
  public:
    /// Reads the case; storedTimes: rows write as often as the case says, not only at endTime.
    AccuracyCase(const CaseDirectory& folder, bool storedTimes);

    RowFacts facts(const MatrixRow& row) const;
    /// Changes when anything does that a row's result depends on: dictionaries (not their comments), geometry, version.
    std::string key(const MatrixRow& row) const;
    std::filesystem::path rowFolder(const MatrixRow& row) const;
    /// Makes the row's case folder, an old one removed.
    void make(const MatrixRow& row) const;

    const CaseDirectory& folder() const { return folder_; }
    double endTime() const { return endTime_; }
    int dim() const { return dim_; }

  private:
    Setting effective(const MatrixRow& row) const;
    std::string refusedSchemes(const MatrixRow& row, const RowFacts& facts) const;
    std::string changedText(const std::string& file, const Setting& changes, const RowFacts& facts) const;

    const CaseDirectory& folder_;
    bool storedTimes_;
    bool adjustable_ = false;
    int dim_ = 2;
    double waveSpeed_ = 0, endTime_ = 0, interval_ = 0, courant_ = 0;
    Setting own_;          ///< the case's own values
    std::string baseText_; ///< all that keys are made of but the row's settings
};

/// 16 hexadecimal digits of the 64-bit FNV-1a hash.
std::string textHash(const std::string& text);
} // namespace mpm::cases

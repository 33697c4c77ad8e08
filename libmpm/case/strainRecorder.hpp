#pragma once
/// Strain paths of chosen particles, for checkIntegration and driveLaw:
///
///     recordStrain { particles (0 915); }      // system/controlDict; ids of particles. Absent: none
///
/// Every step adds one row a particle to postProcessing/strainPaths.csv with the columns
///     particle,time,exx,eyy,ezz,exy,eyz,ezx,sxx,syy,szz,sxy,syz,szx
/// Strains are the sums of dt D, stresses sigma, both in the frame that turns with the particle: Q <- dR Q with the
/// increment dR of the stress update, starting at Q = I when the recording starts; tensor components. dt L is the
/// logarithm of F_new F_old^-1, so nothing is added to the step itself. Strain and frame stand in each state, in the
/// text /provenance/strainPaths ("id, 9 numbers of Q, 9 of the strain" a particle), so that a run that goes on from it
/// continues the rows. Without them (another list of particles, or no file) recording starts anew.
#include "dictionary/dictionary.hpp"
#include "output/csvSeries.hpp"
#include "state/state.hpp"

#include <Eigen/Dense>
#include <memory>
#include <string>

namespace mpm::cases
{
class StrainRecorder
{
  public:
    /// The ids a controlDict asks for; empty if it does not.
    static std::vector<Index> wanted(const dictionary::Dictionary& controlDict);

    /// InputError if there is no particle of such an id.
    StrainRecorder(std::vector<Index> ids, const state::State& state, const Location& where);
    /// Puts strain and frame into a state that is about to be written.
    void remember(state::State& state) const;
    /// Takes them out of a state that was read, whether it is recorded any longer or not.
    static std::string recall(state::State& state);
    /// Continues from there; `memory` is what recall() returned.
    void resume(const std::string& memory);
    void open(const std::filesystem::path& file, const state::State& state, std::optional<double> continueAt);
    /// Rows go to a file in memory: for measuring what they cost.
    void rehearse(const std::filesystem::path& memoryFile);
    /// Brings the rows to the disk.
    void synchronise() const;
    void before(const state::State& state);
    void after(const state::State& state);

  private:
    struct Path
    {
        Index id = 0;
        Eigen::Matrix3d F, frame, strain;
    };
    std::size_t find(const state::State& state, Index id) const;
    Eigen::Matrix3d deformation(const state::State& state, Index id) const;
    void write(const state::State& state, const Path& path);

    std::vector<Path> paths_;
    bool resumed_ = false;
    std::unique_ptr<output::CsvSeries> series_;
};
} // namespace mpm::cases

#pragma once
/// A run as ParaView opens it: two XDMF files in the case folder that point into the state files, one temporal
/// collection each, time from state.h5, particle numbers free to change.
///
///     <case>/<caseName>.xdmf           points: explicit Polyvertex connectivity
///     <case>/<caseName>.domains.xdmf   deformed domains: quadrilaterals or hexahedra, corners x +- F l0 / 2
///
/// Attributes: sigma_xx, sigma_yy ... [Pa], velocity [m/s], mass, id, and every derived field present in all or some
/// times, component by component (smoothedStress_yy). Any of ParaView's XDMF readers opens them.
/// Both files are rewritten whole, through a temporary and a rename.
///
///     ParaviewSeries series("column", "column");
///     series.write({"0", "0.25"});              // again after every new time; only new states are opened
#include "output/stateFile.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mpm::output
{
class ParaviewSeries
{
  public:
    ParaviewSeries(std::filesystem::path caseFolder, std::string caseName);
    /// timeNames: the time folders to list, in order. A time whose state cannot be read is an InputError.
    void write(const std::vector<std::string>& timeNames);

  private:
    struct Known
    {
        std::filesystem::file_time_type changed;
        StateSummary summary;
    };
    const StateSummary& summary(const std::string& timeName);

    std::filesystem::path folder_;
    std::string name_;
    std::map<std::string, Known> known_; ///< by time folder
};

/// The same, once.
void writeParaviewSeries(const std::filesystem::path& caseFolder, const std::string& caseName,
                         const std::vector<std::string>& timeNames);
} // namespace mpm::output

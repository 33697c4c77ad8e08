#pragma once
/// A case folder: where its dictionaries, times and results are.
///
///     geometry/  constant/{g,materialProperties,boundaryConditions}  system/{controlDict,gridDict,mpmSchemes,...}
///     0/state.h5  0.25/state.h5  ...  postProcessing/  log.<utility>
///
/// A time folder is one whose name is a number and that holds state.h5. Times are ordered and selected by their names;
/// the exact time is the one in state.h5, of which the name shows timePrecision digits.
///
/// Selection as OpenFOAM's -time: a list of single times and closed ranges, 'a:b', ':b', 'a:', separated by commas or
/// blanks: -time '0:1', -time '0.5,1,2:'. A single time takes the nearest one there is, but nothing outside the times
/// by more than half a spacing; a part that selects nothing is an InputError that lists the times there are.
#include "base/types.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpm::cases
{
struct TimeFolder
{
    std::string name; ///< "0.25"
    double value = 0; ///< [s], the name as number
};

class CaseDirectory
{
  public:
    /// Throws InputError if there is no such folder, or if it has neither system/ nor constant/.
    explicit CaseDirectory(const std::filesystem::path& folder);

    const std::filesystem::path& folder() const { return folder_; }
    /// The folder's own name, which names the files for ParaView.
    std::string name() const;

    /// Path of "system/controlDict" and the like; InputError saying where it was looked for if it is not there.
    std::filesystem::path dictionaryPath(const std::string& relative) const;
    bool hasFile(const std::string& relative) const;
    /// The file `relative`, or without a name the only geometry (.geo, .step, .stp, .stl, .msh) in geometry/.
    std::filesystem::path geometryPath(const std::string& relative = {}) const;

    /// All times with a state, sorted; empty if there are none.
    std::vector<TimeFolder> times() const;
    /// Times picked by '0.5,1,2:'; InputError if a part picks none.
    std::vector<TimeFolder> selectTimes(const std::string& ranges) const;
    /// The first, the latest, the nearest to a time; InputError if there is none.
    TimeFolder firstTime() const;
    TimeFolder latestTime() const;
    TimeFolder nearestTime(double time) const;
    /// What -time and -latestTime ask for, all times without them.
    std::vector<TimeFolder> selectTimes(const std::optional<std::string>& ranges, bool latest) const;

    std::filesystem::path timePath(const std::string& timeName) const { return folder_ / timeName; }
    std::filesystem::path statePath(const std::string& timeName) const;
    /// postProcessing/, made if needed.
    std::filesystem::path postProcessing() const;
    std::filesystem::path logPath(const std::string& utility) const { return folder_ / ("log." + utility); }

    /// Throws InputError unless files can be made in the folder.
    void requireWritable() const;

    /// Removes a time: its state, and its folder if nothing else is in it. False if something else was.
    bool removeTime(const std::string& timeName) const;
    /// Removes what killed programs left in time folders: unfinished states, and folders in which nothing is left. Only
    /// for who holds the lock of the case (caseLock.hpp): another's unfinished state looks the same.
    void removeLeftovers() const;
    /// purgeWrite: of the times written by this run, oldest first, keeps the last `keep` (0 keeps all), removes the
    /// others and takes them off the list.
    void purge(std::vector<std::string>& written, Index keep) const;

  private:
    TimeFolder pickNearest(const std::vector<TimeFolder>& all, double time, const std::string& what) const;

    std::filesystem::path folder_;
};

/// A time folder's name: the shortest with `precision` significant digits, as OpenFOAM ("0.25", "1e-05", "2").
std::string timeName(double time, int precision = 6);
/// The same with as many more digits as it takes to tell the time from the one stored before (to 1e-3 of the time
/// between them), so that no two times share a folder and names keep their order.
std::string distinctTimeName(double time, double previous, int precision = 6);
} // namespace mpm::cases

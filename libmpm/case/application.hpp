#pragma once
/// The frame of every utility's main: options as users of OpenFOAM type them, the case folder checked, every ending of
/// a run turned into a message and an exit code.
///
///     int main(int argc, char** argv)
///     {
///         cases::ApplicationInfo info{"smoothStress", "smooths the stress of stored times"};
///         info.usesTime = true;
///         info.options = {{"field", "NAME", "the field to smooth (default: sigma)"}};
///         return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
///             ...
///             return 0;
///         });
///     }
///
/// One dash, whole words, the argument after a blank: `smoothStress -case column -latestTime`. An unknown option, a
/// missing argument, a word that is no option and a repeated option are errors with the nearest option.
/// Exit codes: 0 done; 1 the input is wrong (InputError, an unusable file or folder); 2 the calculation cannot go on
/// (StepError, memory); 3 a mistake of ours. Messages go to stderr as `--> name: error: text`; stdout carries nothing
/// but the body's own text.
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpm::cases
{
/// What the user typed.
struct Options
{
    std::filesystem::path caseFolder = ".";
    bool dryRun = false;
    bool overwrite = false;
    bool latestTime = false;
    std::optional<std::string> time;                       ///< ranges as typed: '0:1', '0.5,1', ':2'
    int threads = 0;                                       ///< 0: not given, see threadCount()
    std::map<std::string, std::vector<std::string>> extra; ///< name (no dash) -> its arguments, in the order typed

    /// Was the utility's own option given?
    bool has(const std::string& name) const;
    /// Its argument; without one, `fallback`.
    std::string value(const std::string& name, const std::string& fallback = "") const;
    /// Its argument as a number; InputError unless it is one, finite and as a whole.
    double number(const std::string& name, double fallback) const;
    /// -threads, else the environment's OMP_NUM_THREADS, else 1.
    int threadCount() const;
};

/// An option of one utility. An empty `argument` makes it a flag; one that ends in "..." may be repeated; one in
/// brackets may be left out and is then an empty text.
struct ExtraOption
{
    std::string name, argument, help;
};

/// What a utility is and which of the common options mean something to it; the others are refused.
struct ApplicationInfo
{
    std::string name, purpose;
    std::vector<ExtraOption> options = {};
    bool usesCase = true;       ///< -case DIR; the folder must exist and hold `system`
    bool usesTime = false;      ///< -time RANGES, -latestTime
    bool usesDryRun = false;    ///< -dry-run
    bool usesOverwrite = false; ///< -overwrite
    bool usesThreads = false;   ///< -threads N
    std::string details = {};   ///< further paragraphs of -help
};

int runApplication(int argc, char** argv, const ApplicationInfo& info, const std::function<int(const Options&)>& body);

/// The page `-help` prints.
std::string helpPage(const ApplicationInfo& info);
} // namespace mpm::cases

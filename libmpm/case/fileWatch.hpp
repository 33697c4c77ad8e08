#pragma once
/// Waits until files of a case are others: the geometry and the dictionaries, while somebody edits them.
///
///     FileWatch watch({"column/geometry", "column/constant", "column/system"});
///     while (auto changed = watch.wait([&] { return interruption.signal() != 0; }))
///         seedAgain(*changed);
///
/// Watched are all files below the folders, so that what a dictionary includes or a .geo file merges counts too; not
/// hidden files and what editors leave beside a file (*~, *.swp, #*#, *.partial). A change is told once the files have
/// been left alone for `settle` seconds: an editor that writes in pieces, or moves a new file over the old one, is one
/// change. What counts is the content (size, and a 64-bit FNV-1a hash where the time or the size is another), so a
/// `touch` is no change. Looking around every `interval` seconds works on every file system, over the network too.
/// Verified in tests/unit/fileWatch.cpp and tests/cases/watch.py.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mpm::cases
{
class FileWatch
{
  public:
    /// What is there now is known: a change is against this.
    explicit FileWatch(std::vector<std::filesystem::path> folders, double interval = 0.1, double settle = 0.3);

    /// The files that changed or came, then those that went; nothing when `stop` says so, which is asked every
    /// interval.
    std::optional<std::vector<std::filesystem::path>> wait(const std::function<bool()>& stop);

  private:
    struct Print
    {
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;
        std::uint64_t hash = 0;
        bool operator==(const Print& other) const { return size == other.size && hash == other.hash; }
    };
    using Prints = std::map<std::filesystem::path, Print>;

    Prints look(const Prints& known) const;

    std::vector<std::filesystem::path> folders_;
    double interval_, settle_;
    Prints known_;
};
} // namespace mpm::cases

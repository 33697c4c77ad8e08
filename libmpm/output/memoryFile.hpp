#pragma once
/// A file that exists in memory only, under a path of its own, and goes with its object: for measuring what writing
/// costs without leaving anything on a disk.
#include <filesystem>

namespace mpm::output
{
class MemoryFile
{
  public:
    MemoryFile();
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    /// To be opened like any other; /dev/null where the system has no files in memory.
    std::filesystem::path path() const;
    /// Bytes written so far; 0 where the system has no files in memory.
    double bytes() const;

  private:
    int descriptor_ = -1;
};
} // namespace mpm::output

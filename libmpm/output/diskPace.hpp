#pragma once
/// Keeps a writer of a large file at most 256 MB ahead of the disk. What the disk has taken leaves the page cache, so
/// that a state of many GB neither fills the memory with pages nor waits for all of them at the end. A file below that
/// size is not held up. Only a hint: where the system has no such calls, nothing happens.
#include <cstdint>

namespace mpm::output
{
class DiskPace
{
  public:
    /// The file was written from its beginning on, up to its present end; call it every few MB.
    void follow(int descriptor);

  private:
    std::uint64_t begun_ = 0, taken_ = 0; ///< bytes handed to the disk, and taken by it
};
} // namespace mpm::output

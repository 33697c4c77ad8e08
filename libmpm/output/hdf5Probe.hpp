#pragma once
/// HDF5 believes what stands in a file: headers made to do harm crash it, let it allocate whatever they say, or keep it
/// busy for ever. So before ours, a process that may do all that, but has little memory, goes through everything but
/// the numbers (base/childProcess.hpp). Only what it could open to the last object and attribute is opened here, where
/// HDF5 then does the same things again: with no more memory.
#include <filesystem>

namespace mpm::output
{
/// Throws InputError if HDF5 did not survive the file, or could not open it or an object in it (which is named).
/// Where no process can be started nothing is looked at. A file is looked at once: it is known again by its inode,
/// length and time of change.
void requireHarmless(const std::filesystem::path& file);

/// This program has written the file: it need not be looked at. (And must not while threads run: a child of fork would
/// wait for locks that other threads held.)
void rememberHarmless(const std::filesystem::path& file);
} // namespace mpm::output

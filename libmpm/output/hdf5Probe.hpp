#pragma once
/// HDF5 believes what stands in a file: headers made to do harm crash it, let it allocate whatever they say, or keep it
/// busy for ever. So before ours, a process that may do all that goes through everything but the numbers
/// (base/childProcess.hpp).
#include <filesystem>

namespace mpm::output
{
/// Throws InputError if HDF5 did not survive the file. A file that is no HDF5, or is damaged where HDF5 notices,
/// passes: whoever opens it next is told. Where no process can be started nothing is looked at.
void requireHarmless(const std::filesystem::path& file);
} // namespace mpm::output

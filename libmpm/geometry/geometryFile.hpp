#pragma once
/// What can be known of a geometry file without gmsh.
#include <filesystem>

namespace mpm::geometry
{
/// ".geo", in lower case. Throws InputError for an ending we do not read and for a file that cannot be read.
std::string checkedEnding(const std::filesystem::path& file);

/// The ending alone, in lower case.
std::string lowerEnding(const std::filesystem::path& file);

/// gmsh drops the last line of a .geo file that lacks its line end.
bool endsWithNewline(const std::filesystem::path& file);

/// The unit of length a STEP file (ISO 10303-21) declares: "METRE", "MILLI METRE", "INCH" ...; empty if none is found.
std::string stepUnit(const std::filesystem::path& file);
} // namespace mpm::geometry

#pragma once
/// What a geometry file may not say. gmsh's language can write files, run programs and read any file; a geometry only
/// draws. Refused with file:line, in the file and in all it includes or merges:
///
///     SystemCall, System, NonBlockingSystemCall, OnelabRun, SendToServer    run programs
///     Save, Print, CreateDir, Printf(...) > "file"                          write files
///     Plugin, Exit, Abort, Sleep, GetEnv                                    have no business in a drawing
///     Include, Merge, MergeWithBoundingBox, ShapeFromFile                   unless a file name in quotes follows, of a
///                                                                           file below the case folder or etc
///
/// The case folder is the one around a folder `geometry`, else the file's own. A .msh file must begin like one, because
/// gmsh runs as a script whatever it does not recognise, and the options gmsh finds in <file>.opt are checked as well.
/// This is for the message; what slips through meets base/confine.hpp.
#include <filesystem>

namespace mpm::geometry
{
/// Throws InputError. `ending` in lower case, as checkedEnding() gives it.
void checkScript(const std::filesystem::path& file, const std::string& ending);
} // namespace mpm::geometry

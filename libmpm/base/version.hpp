#pragma once
/// What this build is: for banners, `-version`, and the provenance attributes of result files.
#include <string>
#include <vector>

namespace mpm
{
/// "0.1.0"
std::string projectVersion();
/// Short git revision of the source at configure time, with "+" when files were changed; "unknown" outside git.
std::string gitRevision();
/// "GNU 12.2.0"
std::string compilerText();
/// Build type and the flags given to the compiler, kernels' flags included: "Release: -O3 -march=native ...".
std::string compilerFlags();
/// What the running kernels were compiled for: "x86-64-v2", "x86-64-v3" (AVX2, FMA) or "x86-64-v4" (AVX-512) of a
/// portable build, "native (znver4)" with the compiler's name of the machine it was built on, or the processor family.
std::string instructionSet();
/// What most particle columns are stored as (state::Stored, the CMake option MPM_STORAGE): "double" or "float".
std::string storage();
/// For banners: the instruction set and, where it is not double, the storage: "x86-64-v3, storage float".
std::string kernelText();
/// All of the above, one fact a line; the storage only where it is not double.
std::vector<std::string> versionLines();

/// The project's folder (the one that holds etc/): $MPM_PROJECT_DIR when set, as etc/bashrc does; of an installed
/// program share/libmpm beside its bin/, of a library the one of its tree; otherwise the folder this library was
/// configured in.
std::string projectFolder();
} // namespace mpm

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
/// The widest instruction set the kernels were compiled for: "avx512", "avx2", "avx", "sse2", "neon" or "generic".
std::string instructionSet();
/// All of the above, one fact a line.
std::vector<std::string> versionLines();

/// The project's folder (the one that holds etc/): $MPM_PROJECT_DIR when set, as etc/bashrc does, otherwise the
/// folder this library was configured in.
std::string projectFolder();
} // namespace mpm

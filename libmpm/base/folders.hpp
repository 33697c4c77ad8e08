#pragma once
/// Where files really lie, for texts that name other files and must not reach beyond their case.
#include <filesystem>

namespace mpm
{
/// Absolute, with symbolic links and '..' followed as far as the path exists; empty when that cannot be told.
std::filesystem::path realPath(const std::filesystem::path& path);

/// Is `file` below `folder` (or the folder itself), both as they really lie? Never below an empty folder.
bool liesInside(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Is it below `root`, or below the project's own etc?
bool isWithinReach(const std::filesystem::path& file, const std::filesystem::path& root);
} // namespace mpm

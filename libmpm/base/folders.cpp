#include "base/folders.hpp"

#include "base/version.hpp"

#include <algorithm>

namespace fs = std::filesystem;

namespace mpm
{
fs::path realPath(const fs::path& path)
{
    std::error_code none;
    return path.empty() ? fs::path() : fs::weakly_canonical(path, none);
}

bool liesInside(const fs::path& file, const fs::path& folder)
{
    const fs::path real = realPath(file), place = realPath(folder);
    if (real.empty() || place.empty())
        return false;
    return std::mismatch(place.begin(), place.end(), real.begin(), real.end()).first == place.end();
}

bool isWithinReach(const fs::path& file, const fs::path& root)
{
    return liesInside(file, root) || liesInside(file, fs::path(projectFolder()) / "etc");
}
} // namespace mpm

#include "case/copyCase.hpp"

#include "base/error.hpp"
#include "case/caseLock.hpp"

#include <fmt/format.h>

namespace mpm::cases
{
std::filesystem::path copyCase(const CaseDirectory& from, const std::filesystem::path& target, bool overwrite)
{
    namespace fs = std::filesystem;
    const fs::path path = target.is_absolute() ? target : from.folder() / target;
    const std::vector<std::string> parts = {"constant", "system", "geometry"};
    if (fs::exists(path))
    {
        if (!overwrite)
            throw InputError(
                fmt::format("-target: found {} there already; allowed: a new folder, or -overwrite", target.string()));
        if (fs::equivalent(path, from.folder()))
            throw InputError("-target: found the case itself; allowed: another folder");
        const CaseDirectory old(path); // refuses to touch what is no case folder
        const CaseLock lock(path, "splitParticles");
        for (const auto& time : old.times())
            old.removeTime(time.name);
        for (const auto& part : parts)
            fs::remove_all(path / part);
        fs::remove_all(path / "postProcessing");
    }
    try
    {
        fs::create_directories(path);
        for (const auto& part : parts)
            if (fs::exists(from.folder() / part))
                fs::copy(from.folder() / part, path / part, fs::copy_options::recursive);
    }
    catch (const fs::filesystem_error& error)
    {
        throw InputError(fmt::format("-target: cannot make {}: {}", target.string(), error.code().message()));
    }
    return path;
}
} // namespace mpm::cases

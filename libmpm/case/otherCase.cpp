#include "case/otherCase.hpp"

#include "base/error.hpp"
#include "case/smoothingInput.hpp"
#include "output/stateFile.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
/// As in "0, 0.5, 1", the first few.
std::string list(const std::vector<TimeFolder>& times)
{
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(times.size(), 8); ++i)
        text += (i ? ", " : "") + times[i].name;
    return times.empty() ? "none" : text + (times.size() > 8 ? ", ..." : "");
}

/// The folder, said in the words of the option if it is no case.
std::filesystem::path caseAt(const CaseDirectory& here, const std::filesystem::path& typed)
{
    const auto folder = typed.is_absolute() ? typed : here.folder() / typed;
    if (!std::filesystem::is_directory(folder / "system"))
        throw InputError(fmt::format(
            "-against {}: found {}, allowed is a case folder, as seen from this one", typed.string(),
            std::filesystem::exists(folder) ? "no case there, as it has no system/" : "nothing of that name"));
    return folder;
}
} // namespace

OtherCase::OtherCase(const CaseDirectory& here, const std::filesystem::path& folder,
                     const std::vector<TimeFolder>& times)
    : there_(caseAt(here, folder))
{
    const auto all = there_.times();
    for (const auto& time : times)
        for (const auto& other : all)
            if (std::abs(time.value - other.value) <= 1e-6 * std::abs(time.value))
                same_[time.name] = other.name;
    if (same_.empty())
        throw InputError(fmt::format("-against {}: found the times {}, allowed is a case with at least one of {}",
                                     folder.string(), list(all), list(times)));
    const auto& [ours, its] = *same_.begin();
    const int own = output::readSummary(here.statePath(ours)).dim;
    if (const int dim = output::readSummary(there_.statePath(its)).dim; dim != own)
        throw InputError(fmt::format("-against {}: found states of dimension {}, allowed {} as in this case",
                                     folder.string(), dim, own));
}

std::string OtherCase::shape() const
{
    return readSmoothingShape(there_);
}

std::filesystem::path OtherCase::stateOf(const TimeFolder& time) const
{
    const auto found = same_.find(time.name);
    return found == same_.end() ? std::filesystem::path() : there_.statePath(found->second);
}
} // namespace mpm::cases

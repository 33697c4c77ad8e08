#include "case/caseDirectory.hpp"

#include "base/error.hpp"
#include "output/replaceFile.hpp"
#include "output/stateFile.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <limits>

namespace mpm::cases
{
namespace fs = std::filesystem;

namespace
{
constexpr const char* caseContents =
    "a case folder holds geometry/, constant/ (g, materialProperties, boundaryConditions), "
    "system/ (controlDict, gridDict, mpmSchemes) and one folder a time (0/state.h5)";

std::optional<double> number(const std::string& text)
{
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::string timeList(const std::vector<TimeFolder>& times)
{
    std::vector<std::string> names;
    for (const auto& time : times)
        names.push_back(time.name);
    // Long runs: the ends say enough.
    if (names.size() > 20)
    {
        names[10] = "...";
        names.erase(names.begin() + 11, names.end() - 9);
    }
    return joinWords(names, ", ");
}

/// One part of '0.5,1,2:'.
struct Range
{
    std::string text;
    double low, high;
    bool single;
};

std::vector<Range> parseRanges(const std::string& text)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<Range> ranges;
    for (std::size_t begin = 0; begin < text.size();)
    {
        const std::size_t end = std::min(text.find_first_of(", \t", begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        begin = end + 1;
        if (part.empty())
            continue;
        const auto colon = part.find(':');
        const auto low = number(part.substr(0, colon));
        const auto high = colon == std::string::npos ? low : number(part.substr(colon + 1));
        const bool openLow = colon == 0, openHigh = colon == part.size() - 1;
        if ((!low && !openLow) || (!high && !openHigh) || (low && high && *low > *high))
            throw InputError(
                fmt::format("-time: found \"{}\", allowed are times and ranges like 0.5,1,2: or 0:1", part));
        ranges.push_back({part, low.value_or(-infinity), high.value_or(infinity), colon == std::string::npos});
    }
    if (ranges.empty())
        throw InputError("-time: nothing given, allowed are times and ranges like 0.5,1,2: or 0:1");
    return ranges;
}
} // namespace

CaseDirectory::CaseDirectory(const fs::path& folder) : folder_(folder.empty() ? fs::path(".") : folder)
{
    std::error_code error;
    if (!fs::exists(folder_, error))
        throw InputError({folder_.string()}, fmt::format("no such case folder; {}", caseContents));
    if (!fs::is_directory(folder_, error))
        throw InputError({folder_.string()}, fmt::format("is not a folder; {}", caseContents));
    if (!fs::is_directory(folder_ / "system", error) && !fs::is_directory(folder_ / "constant", error))
        throw InputError({folder_.string()},
                         fmt::format("has neither system/ nor constant/; {}. Give it with -case DIR", caseContents));
}

std::string CaseDirectory::name() const
{
    std::error_code error;
    const fs::path whole = fs::canonical(folder_, error);
    const std::string name = whole.filename().string();
    return name.empty() ? "case" : name;
}

bool CaseDirectory::hasFile(const std::string& relative) const
{
    std::error_code error;
    const auto status = fs::status(folder_ / relative, error);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw InputError({(folder_ / relative).string()}, "found a folder or a device, allowed a file");
    return fs::exists(status);
}

fs::path CaseDirectory::dictionaryPath(const std::string& relative) const
{
    if (hasFile(relative))
        return folder_ / relative;
    const fs::path place = (folder_ / relative).parent_path();
    std::vector<std::string> there;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(place, error))
        there.push_back(entry.path().filename().string());
    const std::string near = nearestWord(fs::path(relative).filename().string(), there);
    throw InputError(
        {(folder_ / relative).string()},
        fmt::format("no such file{}; {}", near.empty() ? "" : fmt::format(" (did you mean {}?)", near), caseContents));
}

fs::path CaseDirectory::geometryPath(const std::string& relative) const
{
    if (!relative.empty())
        return dictionaryPath(relative);
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_ / "geometry", error))
    {
        const std::string ending = entry.path().extension().string();
        for (const char* known : {".geo", ".step", ".stp", ".stl", ".msh"})
            if (ending == known)
                found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    if (found.size() != 1)
        throw InputError({(folder_ / "geometry").string()},
                         found.empty() ? "no geometry here (.geo, .step, .stp, .stl or .msh)"
                                       : fmt::format("several geometries: {}; name one in seedParticlesDict",
                                                     joinWords(found, " and ")));
    return folder_ / "geometry" / found.front();
}

std::vector<TimeFolder> CaseDirectory::times() const
{
    std::vector<TimeFolder> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_, error))
    {
        const std::string name = entry.path().filename().string();
        const auto value = number(name);
        if (value && fs::is_regular_file(entry.path() / output::stateFileName, error))
            found.push_back({name, *value});
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    for (std::size_t i = 1; i < found.size(); ++i)
        if (found[i].value == found[i - 1].value)
            throw InputError({folder_.string()}, fmt::format("the folders {} and {} stand for the same time",
                                                             found[i - 1].name, found[i].name));
    return found;
}

TimeFolder CaseDirectory::pickNearest(const std::vector<TimeFolder>& all, double time, const std::string& what) const
{
    if (all.empty())
        throw InputError({folder_.string()},
                         "no times here (folders like 0/ with a state.h5); run seedParticles first");
    const auto nearest = std::min_element(all.begin(), all.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.value - time) < std::abs(b.value - time);
    });
    const double spacing = all.size() < 2             ? 0
                           : nearest == all.begin()   ? all[1].value - all[0].value
                           : nearest == all.end() - 1 ? all.back().value - all[all.size() - 2].value
                                                      : std::numeric_limits<double>::infinity();
    if (std::abs(nearest->value - time) > std::max(0.5 * spacing, 1e-6 * std::abs(time)))
        throw InputError({folder_.string()}, fmt::format("no time near {}; there are: {}", what, timeList(all)));
    return *nearest;
}

std::vector<TimeFolder> CaseDirectory::selectTimes(const std::string& text) const
{
    const auto ranges = parseRanges(text);
    const auto all = times();
    std::vector<bool> picked(all.size(), false);
    for (const auto& range : ranges)
    {
        bool any = false;
        const std::string only = range.single ? pickNearest(all, range.low, range.text).name : "";
        for (std::size_t i = 0; i < all.size(); ++i)
            if (range.single ? all[i].name == only : all[i].value >= range.low && all[i].value <= range.high)
                any = picked[i] = true;
        if (!any)
            throw InputError({folder_.string()}, fmt::format("no time in {}; there are: {}", range.text,
                                                             all.empty() ? "none" : timeList(all)));
    }
    std::vector<TimeFolder> selected;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (picked[i])
            selected.push_back(all[i]);
    return selected;
}

std::vector<TimeFolder> CaseDirectory::selectTimes(const std::optional<std::string>& ranges, bool latest) const
{
    if (ranges && latest)
        throw InputError("-time and -latestTime exclude each other");
    if (ranges)
        return selectTimes(*ranges);
    if (latest)
        return {latestTime()};
    firstTime();
    return times();
}

TimeFolder CaseDirectory::nearestTime(double time) const
{
    return pickNearest(times(), time, fmt::format("{}", time));
}

TimeFolder CaseDirectory::firstTime() const
{
    const auto all = times();
    return all.empty() ? pickNearest(all, 0, "") : all.front();
}

TimeFolder CaseDirectory::latestTime() const
{
    const auto all = times();
    return all.empty() ? pickNearest(all, 0, "") : all.back();
}

fs::path CaseDirectory::statePath(const std::string& timeName) const
{
    return folder_ / timeName / output::stateFileName;
}

fs::path CaseDirectory::postProcessing() const
{
    const fs::path place = folder_ / "postProcessing";
    output::makeFolder(place);
    return place;
}

void CaseDirectory::requireWritable() const
{
    const fs::path probe = folder_ / ".writable.partial";
    const bool made = bool(std::ofstream(probe));
    std::error_code error;
    fs::remove(probe, error);
    if (!made)
        throw InputError({folder_.string()}, "this folder cannot be written to");
}

bool CaseDirectory::removeTime(const std::string& timeName) const
{
    if (!number(timeName))
        throw InputError({timePath(timeName).string()}, "is not a time folder");
    std::error_code error;
    fs::remove(statePath(timeName), error);
    fs::remove(output::temporaryName(statePath(timeName)), error);
    fs::remove(timePath(timeName), error); // refuses a folder that is not empty
    return !fs::exists(timePath(timeName));
}

void CaseDirectory::removeLeftovers() const
{
    std::error_code error;
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(folder_, error))
        if (entry.is_directory(error) && !entry.is_symlink(error) && number(entry.path().filename().string()))
            folders.push_back(entry.path());
    for (const auto& folder : folders)
    {
        fs::remove(output::temporaryName(folder / output::stateFileName), error);
        fs::remove(folder, error); // refuses a folder that is not empty
    }
}

void CaseDirectory::purge(std::vector<std::string>& written, Index keep) const
{
    while (keep > 0 && Index(written.size()) > keep)
    {
        removeTime(written.front());
        written.erase(written.begin());
    }
}

std::string timeName(double time, int precision)
{
    if (std::abs(time) < 1e-14)
        time = 0;
    return fmt::format("{:.{}g}", time, precision);
}

std::string distinctTimeName(double time, double previous, int precision)
{
    constexpr int mostDigits = 17;
    for (; precision < mostDigits; ++precision)
    {
        const auto name = timeName(time, precision);
        if (std::abs(number(name).value_or(0) - time) <= 1e-3 * std::abs(time - previous))
            return name;
    }
    return timeName(time, mostDigits);
}
} // namespace mpm::cases

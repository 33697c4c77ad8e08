#include "geometry/geometryFile.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <regex>

namespace mpm::geometry
{
std::string lowerEnding(const std::filesystem::path& file)
{
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    return ending;
}

std::string checkedEnding(const std::filesystem::path& file)
{
    static const std::vector<std::string> known = {".geo", ".step", ".stp", ".stl", ".msh"};
    const std::string ending = lowerEnding(file);
    if (std::find(known.begin(), known.end(), ending) == known.end())
        throw InputError({file.string(), 0},
                         fmt::format("found the ending '{}', allowed: {}", ending, joinWords(known)));
    if (!std::filesystem::is_regular_file(file) || !std::ifstream(file))
        throw InputError({file.string(), 0}, "cannot be read");
    return ending;
}

bool endsWithNewline(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    char last = '\n';
    if (in.tellg() > 0)
        in.seekg(-1, std::ios::end).get(last);
    return last == '\n';
}

std::string stepUnit(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    static const std::regex conversion(R"(CONVERSION_BASED_UNIT\s*\(\s*'([^']*)')");
    static const std::regex si(R"(SI_UNIT\s*\(\s*(\$|\.(\w+)\.)\s*,\s*\.METRE\.)");
    std::string unit;
    for (std::size_t at = text.find("LENGTH_UNIT"); at != std::string::npos; at = text.find("LENGTH_UNIT", at + 1))
    {
        // The instance around the word: a unit by conversion (inch) names its own base unit, which comes as well.
        const std::size_t begin = text.rfind(';', at), end = std::min(text.find(';', at), text.size());
        const std::string instance = text.substr(begin == std::string::npos ? 0 : begin, end - std::min(begin, end));
        std::smatch match;
        if (std::regex_search(instance, match, conversion))
            return match[1];
        if (unit.empty() && std::regex_search(instance, match, si))
            unit = match[2].matched ? match[2].str() + " METRE" : "METRE";
    }
    return unit;
}
} // namespace mpm::geometry

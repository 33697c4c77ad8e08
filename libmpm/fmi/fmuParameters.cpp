#include "fmi/fmuParameters.hpp"

#include "dictionary/dictionary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>

namespace mpm::fmi
{
namespace
{
const Unit pascal{"Pa", {1, -1, -2}, 0, 1};
const Unit degree{"deg", {}, 1, std::numbers::pi / 180};
const Unit second{"s", {0, 0, 1}, 0, 1};
const Unit perSecond{"1/s", {0, 0, -1}, 0, 1};
const Unit metre{"m", {0, 1}, 0, 1};

/// Units of words that are written without dimensions.
const std::map<std::string, Unit> unitsOfWords = {{"E", pascal},
                                                  {"cohesion", pascal},
                                                  {"tensionCutOff", pascal},
                                                  {"yieldStress", pascal},
                                                  {"frictionAngle", degree},
                                                  {"dilationAngle", degree},
                                                  {"deltaT", second},
                                                  {"duration", second},
                                                  {"picRate", perSecond},
                                                  {"filterRate", perSecond},
                                                  {"rate", perSecond},
                                                  {"referenceLength", metre},
                                                  {"position", metre}};

bool seeded(const std::string& file, const std::string& path, const std::string& word)
{
    return file == "constant/materialProperties" &&
           (word == "density" || word == "initialVelocity" || path.find("initialStress") != std::string::npos);
}

/// "(", ")", "[", "]" and what stands between blanks.
std::vector<std::string> piecesOf(const std::string& text)
{
    std::string spaced;
    for (const char c : text)
        spaced += std::string("()[]").find(c) != std::string::npos ? std::string{' ', c, ' '} : std::string{c};
    std::istringstream in(spaced);
    std::vector<std::string> pieces;
    for (std::string piece; in >> piece;)
        pieces.push_back(piece);
    return pieces;
}

std::optional<double> numberOf(const std::string& text)
{
    double value = 0;
    const char* first = text.data() + (!text.empty() && text[0] == '+');
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Exponents before a value, "[ 1 -1 -2 0 0 0 0 ]", taken off the pieces.
std::optional<Unit> takeDimensions(std::vector<std::string>& pieces)
{
    const auto close = std::find(pieces.begin(), pieces.end(), "]");
    if (pieces.empty() || pieces[0] != "[" || close == pieces.end())
        return std::nullopt;
    Unit unit;
    std::size_t at = 0;
    for (auto piece = pieces.begin() + 1; piece != close && at < unit.exponents.size(); ++piece)
        unit.exponents[at++] = int(numberOf(*piece).value_or(0));
    pieces.erase(pieces.begin(), close + 1);
    const std::array<const char*, 7> bases = {"kg", "m", "s", "K", "mol", "A", "cd"};
    for (std::size_t i = 0; i < bases.size(); ++i)
        if (const int exponent = unit.exponents[i]; exponent != 0)
            unit.name.append(unit.name.empty() ? "" : ".")
                .append(bases[i])
                .append(exponent == 1 ? "" : std::to_string(exponent));
    return unit;
}

/// One number, or three in brackets; nothing else.
std::vector<double> numbersOf(std::vector<std::string> pieces)
{
    const bool list = pieces.size() == 5 && pieces.front() == "(" && pieces.back() == ")";
    if (list)
        pieces = {pieces.begin() + 1, pieces.end() - 1};
    if (pieces.size() != (list ? 3u : 1u))
        return {};
    std::vector<double> numbers;
    for (const std::string& piece : pieces)
        if (const auto number = numberOf(piece))
            numbers.push_back(*number);
    return numbers.size() == pieces.size() ? numbers : std::vector<double>{};
}

void takeEntry(const std::string& file, const std::string& path, const std::string& line, std::vector<Parameter>& out)
{
    const auto blank = line.find(' ');
    if (blank == std::string::npos || line.back() != ';')
        return;
    const std::string word = line.substr(0, blank);
    const bool control = file == "system/controlDict";
    if (seeded(file, path, word) || (control && word != "deltaT" && word != "maxCo"))
        return;
    auto pieces = piecesOf(line.substr(blank, line.size() - blank - 1));
    const auto dimensions = takeDimensions(pieces);
    const auto values = numbersOf(pieces);
    if (values.empty())
        return;
    const auto known = unitsOfWords.find(word);
    Unit unit = dimensions ? *dimensions : known != unitsOfWords.end() ? known->second : Unit{};
    if (file == "constant/g" && word == "value")
        unit = {"m/s2", {0, 1, -2}, 0, 1};
    out.push_back({file, path + word, values, unit});
}

/// Goes through a dictionary as it prints itself: one entry a line, macros resolved.
void takeFile(const std::filesystem::path& folder, const std::string& file, std::vector<Parameter>& out)
{
    std::istringstream lines(dictionary::Dictionary::readFile(folder / file).text());
    std::vector<std::string> open; // names of the dictionaries around
    std::string line, before;
    while (std::getline(lines, line))
    {
        line.erase(0, line.find_first_not_of(' '));
        if (line == "{")
            open.push_back(before);
        else if (line == "}")
            open.pop_back();
        else if (open.empty() || open[0] != "FoamFile")
        {
            std::string path;
            for (const std::string& name : open)
                path.append(name).append(".");
            takeEntry(file, path, line, out);
        }
        before = line;
    }
}
} // namespace

std::string namePart(const std::string& text)
{
    const auto isLetter = [](char c) { return c == '_' || std::isalpha(static_cast<unsigned char>(c)); };
    bool plain = !text.empty() && isLetter(text[0]);
    std::string quoted = "'";
    for (const char c : text)
    {
        plain = plain && (isLetter(c) || std::isdigit(static_cast<unsigned char>(c)));
        quoted.append(c == '\'' || c == '\\' ? "\\" : "").append(1, c);
    }
    return plain ? text : quoted.append("'");
}

std::string Parameter::name() const
{
    std::string name = namePart(file.substr(file.find('/') + 1));
    std::istringstream parts(word);
    for (std::string part; std::getline(parts, part, '.');)
        name.append(".").append(namePart(part));
    return name;
}

std::vector<Parameter> numbersOfCase(const std::filesystem::path& caseFolder)
{
    std::vector<Parameter> out;
    for (const char* file :
         {"constant/g", "constant/materialProperties", "constant/boundaryConditions", "constant/rigidBodies",
          "constant/contactProperties", "constant/bodyForce", "system/mpmSchemes", "system/controlDict"})
        if (std::filesystem::exists(caseFolder / file))
            takeFile(caseFolder, file, out);
    return out;
}

coupling::Setting settingOf(const Parameter& parameter, std::span<const double> values)
{
    if (values.size() == 1)
        return {parameter.file, parameter.word, fmt::format("{}", values[0])};
    return {parameter.file, parameter.word, fmt::format("({} {} {})", values[0], values[1], values[2])};
}
} // namespace mpm::fmi

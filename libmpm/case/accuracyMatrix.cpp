#include "case/accuracyMatrix.hpp"

#include "case/accuracyText.hpp"
#include "case/makeStepper.hpp"
#include "output/csvSeries.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using dictionary::Bound;
using dictionary::Choice;
using dictionary::Dictionary;
using Words = std::vector<std::string>;

constexpr std::size_t mostRows = 10000;

/// An axis: its word, its help, and how its values are checked.
struct Axis
{
    std::string word, help;
    dictionary::Dimensions dimensions = dictionary::unit::none;
    Bound bound = {};
    Words words = {}; ///< the names allowed; empty: numbers
    bool whole = false;
};

Words names(const std::vector<Choice>& catalogue)
{
    Words out;
    for (const auto& choice : catalogue)
        out.push_back(choice.name);
    return out;
}

const std::vector<Axis>& catalogue()
{
    namespace unit = dictionary::unit;
    static const std::vector<Axis> axes = {
        {"cellSize", "sides of a cell", unit::length, Bound::positive()},
        {"particlesPerCell", "along each axis", unit::none, Bound::atLeast(1), {}, true},
        {"shape", "shape functions", unit::none, {}, names(shapeCatalogue())},
        {"transfer", "between grid and particles", unit::none, {}, {"FLIP", "XPIC", "FMPM", "APIC", "TPIC"}},
        {"order", "of XPIC and FMPM", unit::none, Bound::atLeast(1), {}, true},
        {"picRate", "share of PIC velocity mixed in per second", unit::rate, Bound::nonNegative()},
        {"stressUpdate", "when stress is updated", unit::none, {}, {"USF", "USL", "MUSL"}},
        {"staggeredStart", "is the first kick half a step?", unit::none, {}, {"no", "yes"}},
        {"timeIntegration", "of the step", unit::none, {}, {"symplecticEuler", "RK2", "RK4"}},
        {"splitting", "of stretched particles", unit::none, {}, {"off", "on"}},
        {"courant", "c_p deltaT/cellSize", unit::none, Bound::positive()},
        {"deltaT", "time steps", unit::time, Bound::positive()}};
    return axes;
}

const Axis* findAxis(const std::string& word)
{
    for (const Axis& axis : catalogue())
        if (axis.word == word)
            return &axis;
    return nullptr;
}

Words readWords(const Dictionary& d, const Axis& axis, bool single)
{
    Words values = single ? Words{d.get<std::string>({axis.word, axis.help})} : d.get<Words>({axis.word, axis.help});
    for (const auto& value : values)
        if (std::find(axis.words.begin(), axis.words.end(), value) == axis.words.end())
        {
            const auto near = nearestWord(value, axis.words);
            d.fail(axis.word, "'" + value + "'",
                   joinWords(axis.words) + (near.empty() ? "" : " (did you mean '" + near + "'?)"));
        }
    return values;
}

Words readNumbers(const Dictionary& d, const Axis& axis, bool single)
{
    const auto numbers = single
                             ? std::vector<double>{d.get<double>({axis.word, axis.help, axis.dimensions, axis.bound})}
                             : d.get<std::vector<double>>({axis.word, axis.help, axis.dimensions, axis.bound});
    Words values;
    for (const double number : numbers)
    {
        if (axis.whole && number != std::round(number))
            d.fail(axis.word, fmt::format("{:g}", number), "whole numbers");
        values.push_back(output::shortest(number));
    }
    return values;
}

/// A value alone needs no brackets.
bool isSingle(const Dictionary& d, const std::string& word)
{
    return entryText(d.text(), word).value_or("").find('(') == std::string::npos;
}

using Axes = std::map<std::string, Words>;

/// Axis -> its values, of `axes` or of one method.
Axes readAxes(const Dictionary& d)
{
    Axes out;
    for (const Axis& axis : catalogue())
    {
        if (!d.found(axis.word))
            continue;
        const bool single = isSingle(d, axis.word);
        Words values = axis.words.empty() ? readNumbers(d, axis, single) : readWords(d, axis, single);
        if (values.empty())
            d.fail(axis.word, "no value", "at least one");
        for (auto value = values.begin(); value != values.end(); ++value)
            if (std::find(values.begin(), value, *value) != value)
                d.fail(axis.word, *value + " twice", "each value once");
        out[axis.word] = std::move(values);
    }
    if (out.count("courant") && out.count("deltaT"))
        d.fail("deltaT", "both courant and deltaT", "one of them");
    return out;
}

/// All combinations, the last axis of the catalogue running fastest.
std::vector<Setting> combinations(const Axes& axes)
{
    std::vector<Setting> all{{}};
    double count = 1;
    for (const auto& [word, values] : axes)
        count *= double(values.size());
    if (count > double(mostRows))
        return {};
    for (const Axis& axis : catalogue())
    {
        const auto found = axes.find(axis.word);
        if (found == axes.end())
            continue;
        std::vector<Setting> longer;
        for (const Setting& setting : all)
            for (const auto& value : found->second)
            {
                longer.push_back(setting);
                longer.back()[axis.word] = value;
            }
        all = std::move(longer);
    }
    return all;
}

bool isResolution(const std::string& axis)
{
    return axis == "cellSize" || axis == "courant" || axis == "deltaT";
}

bool isWord(const std::string& axis)
{
    return !findAxis(axis)->words.empty();
}

/// "MUSL" for itself, "particlesPerCell 3" where a number alone says nothing.
std::string shown(const std::string& axis, const std::string& value)
{
    const bool clear = isWord(axis) && axis != "splitting" && axis != "staggeredStart";
    return clear ? value : axis + " " + value;
}

/// Method's name and the swept words that make a curve of their own.
std::string curveName(const std::string& method, const Axes& axes, const Setting& setting)
{
    std::string name = method;
    for (const Axis& axis : catalogue())
        if (const auto found = axes.find(axis.word);
            found != axes.end() && found->second.size() > 1 && !isResolution(axis.word))
            name.append(name.empty() ? "" : " ").append(shown(axis.word, setting.at(axis.word)));
    return name.empty() ? "as in the case" : name;
}

/// A name for a folder: what letters, digits, '.', '-' and '_' can say.
std::string folderName(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+' ? c : '_';
    return out;
}

std::string rowName(const std::string& method, const Axes& axes, const Setting& setting)
{
    std::string name = folderName(method);
    for (const std::string word : {"cellSize", "courant", "deltaT"})
        if (const auto found = axes.find(word); found != axes.end() && found->second.size() > 1)
            name += fmt::format("-{}_{}", word, folderName(setting.at(word)));
    return name;
}

/// A method's own axes, and those of `axes` it does not name. Its own time step excludes theirs.
Axes merged(Axes own, const Axes& common)
{
    const bool hasStep = own.count("courant") || own.count("deltaT");
    for (const auto& [word, values] : common)
        if (!(hasStep && (word == "courant" || word == "deltaT")))
            own.emplace(word, values);
    return own;
}

void addRows(std::vector<MatrixRow>& rows, const std::string& method, const Axes& axes, const Dictionary& where)
{
    const auto settings = combinations(axes);
    if (settings.empty() || rows.size() + settings.size() > mostRows)
        throw InputError(where.where(), fmt::format("found more than {} rows, allowed fewer", mostRows));
    for (const auto& setting : settings)
    {
        const auto curve = curveName(method, axes, setting);
        MatrixRow row{rowName(curve, axes, setting), curve, setting};
        for (const auto& other : rows)
            if (other.setting == row.setting || other.name == row.name)
                throw InputError(where.where(), fmt::format("found the same settings in '{}' and '{}', allowed: each "
                                                            "combination once",
                                                            other.name, row.name));
        rows.push_back(std::move(row));
    }
}
} // namespace

const std::vector<std::string>& accuracyAxes()
{
    static const Words words = [] {
        Words out;
        for (const Axis& axis : catalogue())
            out.push_back(axis.word);
        return out;
    }();
    return words;
}

std::vector<MatrixRow> readMatrix(const Dictionary& d)
{
    const Dictionary* axesDict = d.findDict("axes", "settings of which every combination is tried");
    const Axes common = axesDict ? readAxes(*axesDict) : Axes{};
    std::vector<MatrixRow> rows;
    const Dictionary* methods = d.findDict("methods", "named settings, one curve each");
    if (!methods || methods->dictNames().empty())
        addRows(rows, "", common, axesDict ? *axesDict : d);
    else
        for (const auto& name : methods->dictNames())
        {
            const Dictionary& method = methods->subDict(name, "a method");
            addRows(rows, name, merged(readAxes(method), common), method);
        }
    return rows;
}

Setting readSetting(const Dictionary& d)
{
    Setting setting;
    for (const auto& [word, values] : readAxes(d))
    {
        if (values.size() != 1)
            d.fail(word, fmt::format("{} values", values.size()), "one");
        setting[word] = values.front();
    }
    return setting;
}

namespace
{
bool sameBut(Setting a, Setting b, const Words& left)
{
    for (const auto& word : left)
    {
        a.erase(word);
        b.erase(word);
    }
    return a == b;
}
} // namespace

bool sameButTimeStep(const Setting& a, const Setting& b)
{
    return sameBut(a, b, {"courant", "deltaT"});
}

bool sameButCellSize(const Setting& a, const Setting& b)
{
    return sameBut(a, b, {"cellSize"});
}
} // namespace mpm::cases

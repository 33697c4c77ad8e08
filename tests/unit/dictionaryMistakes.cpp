// Every wrong dictionary of dictionaryMistakes.txt gets exactly the message that stands there.
#include "dictionary/dictionary.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>
#include <unistd.h>

using namespace mpm;
using namespace mpm::dictionary;
namespace fs = std::filesystem;

namespace
{
struct Mistake
{
    std::string name, message;
    std::vector<std::pair<std::string, std::string>> files; ///< name and text; the last is read
};

std::vector<Mistake> mistakes()
{
    std::ifstream in(MPM_SOURCE_DIR "/tests/unit/dictionaryMistakes.txt");
    std::vector<Mistake> all;
    std::string* to = nullptr;
    for (std::string line; std::getline(in, line);)
    {
        if (line.rfind("### ", 0) == 0)
        {
            all.push_back({line.substr(4), "", {}});
            to = nullptr;
        }
        else if (line.rfind("--- file ", 0) == 0)
            to = &all.back().files.emplace_back(line.substr(9), "").second;
        else if (line == "--- message")
            to = &all.back().message;
        else if (to && !(to == &all.back().message && line.empty()))
            *to += line + "\n";
    }
    return all;
}

/// The questions a program would ask.
void askAll(const Dictionary& dict)
{
    dict.get<std::string>({"title", "", unit::none, {}, "none"});
    dict.get<Index>({"steps", "", unit::none, Bound::atLeast(1), Index(1)});
    dict.get<bool>({"active", "", unit::none, {}, true});
    dict.get<std::vector<double>>({"layers", "", unit::length, Bound::nonNegative(), std::vector<double>()});
    dict.get<std::vector<Vector3>>({"points", "", unit::length, {}, std::vector<Vector3>()});
    dict.get<std::vector<std::string>>({"names", "", unit::none, {}, std::vector<std::string>()});
    dict.checkDimensions(unit::acceleration);
    const Dictionary& soil = dict.subDict("soil", "the only material");
    soil.choose("law", "", {{"linearElastic", ""}, {"mohrCoulomb", ""}}, "mohrCoulomb");
    soil.get<double>({"density", "mass per volume of the grains and pores", unit::density, Bound::positive()});
    soil.get<double>({"E", "", unit::pressure, Bound::positive(), 20e6});
    soil.get<double>({"nu", "", unit::none, Bound::rightOpen(0, 0.5), 0.42});
    soil.get<double>({"cohesion", "", unit::pressure, Bound::nonNegative(), 1e3});
    soil.get<double>({"frictionAngle", "", unit::none, Bound::open(0, 90), 42.0});
    soil.get<Vector3>({"initialVelocity", "", unit::velocity, {}, Vector3{}});
    soil.findDict("initialStress");
    dict.rejectUnread();
}

std::string replaceAll(std::string text, const std::string& what, const std::string& with)
{
    for (std::size_t at; (at = text.find(what)) != std::string::npos;)
        text.replace(at, what.size(), with);
    return text;
}
} // namespace

TEST_CASE("every mistake gets the message that is promised")
{
    const auto all = mistakes();
    REQUIRE(all.size() >= 40);
    std::set<std::string> names;
    const fs::path folder = fs::temp_directory_path() / ("mpmMistakes" + std::to_string(getpid()));
    for (const Mistake& mistake : all)
    {
        INFO(mistake.name);
        CHECK(names.insert(mistake.name).second);
        REQUIRE(!mistake.files.empty());
        fs::create_directories(folder / "system");
        fs::create_directories(folder / "constant");
        for (const auto& [name, text] : mistake.files)
            std::ofstream(folder / name) << text;
        std::string message = "nothing was wrong";
        try
        {
            askAll(Dictionary::readFile(folder / mistake.files.back().first));
        }
        catch (const InputError& error)
        {
            message = replaceAll(error.what(), folder.string() + "/", "");
        }
        CHECK(message + "\n" == mistake.message);
        fs::remove_all(folder);
    }
}

// Every dictionary of the cases we ship: read by our parser, with a FoamFile header that names it, and read to the same
// words by OpenFOAM's own foamDictionary where that is installed.
#include "dictionary/dictionary.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;
using mpm::dictionary::Dictionary;

namespace
{
std::vector<fs::path> shippedDictionaries()
{
    std::vector<fs::path> files;
    for (const auto& scene : fs::directory_iterator(fs::path(MPM_SOURCE_DIR) / "cases"))
        for (const char* folder : {"constant", "system"})
            if (fs::is_directory(scene.path() / folder))
                for (const auto& file : fs::directory_iterator(scene.path() / folder))
                    files.push_back(file.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string firstLineWith(const fs::path& file, const std::string& word)
{
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.find(word) != std::string::npos)
            return line;
    return {};
}

/// What a command prints; exit code in `status`.
std::string output(const std::string& command, int& status)
{
    std::string text;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    for (int c; pipe && (c = std::fgetc(pipe)) != EOF;)
        text += char(c);
    status = pipe ? pclose(pipe) : -1;
    return text;
}
} // namespace

TEST_CASE("every shipped dictionary is read and names itself")
{
    const auto files = shippedDictionaries();
    REQUIRE(files.size() >= 9);
    for (const auto& file : files)
    {
        INFO(file.string());
        const Dictionary dictionary = Dictionary::readFile(file);
        CHECK(dictionary.words().size() + dictionary.dictNames().size() > 0);
        std::istringstream header(firstLineWith(file, "object "));
        std::string word, object;
        header >> word >> object;
        CHECK(object == file.filename().string() + ";");
    }
}

TEST_CASE("foamDictionary reads every shipped dictionary to the same words")
{
    int status = 0;
    output("command -v foamDictionary", status);
    if (status != 0)
    {
        WARN("foamDictionary is not installed (Debian package openfoam): not compared");
        return;
    }
    const std::string environment = std::getenv("WM_PROJECT_DIR") ? "" : "WM_PROJECT_DIR=/usr/share/openfoam ";
    for (const auto& file : shippedDictionaries())
    {
        INFO(file.string());
        std::istringstream printed(output(environment + "foamDictionary -keywords '" + file.string() + "'", status));
        CHECK(status == 0);
        std::vector<std::string> theirs, ours = Dictionary::readFile(file).words();
        for (std::string word; printed >> word;)
            if (word != "FoamFile")
                theirs.push_back(word);
        for (const auto& name : Dictionary::readFile(file).dictNames())
            ours.push_back(name);
        std::sort(theirs.begin(), theirs.end());
        std::sort(ours.begin(), ours.end());
        CHECK(theirs == ours);
    }
}

// Every dictionary of the cases we ship is read, and has a FoamFile header that names it. (That foamDictionary reads
// them to the same values is checked in tests/cases.)
#include "dictionary/dictionary.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
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

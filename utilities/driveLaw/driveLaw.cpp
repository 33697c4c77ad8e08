// The single-point test of a material law: oedometer, triaxial, simple shear, a strain path, or single trial stresses.
#include "base/version.hpp"
#include "case/application.hpp"
#include "constitutive/soilTests.hpp"
#include "constitutive/trialTable.hpp"
#include "dictionary/dictionary.hpp"
#include "output/replaceFile.hpp"
#include "output/runScript.hpp"

#include <fmt/format.h>

using namespace mpm;
namespace fs = std::filesystem;

namespace
{
int returnTrials(const cases::Options& options)
{
    if (!options.has("out"))
        throw InputError("-trial: found no -out, allowed is -trial FILE.csv -out FILE.csv");
    CsvTable table = CsvTable::read(options.value("trial"));
    constitutive::returnTrials(table);
    output::replaceText(options.value("out"), table.text());
    fmt::print("driveLaw: returned {} trial stresses, wrote {}\n", table.rows().size(), options.value("out"));
    return 0;
}

int driveLaw(const cases::Options& options)
{
    const std::string path = constitutive::requireSoilTest(options.value("path"));
    const auto file = dictionary::Dictionary::readFile(options.value("law"));
    const auto& material = constitutive::lawDictionary(file, options.value("material"));
    for (const char* word : {"density", "initialStress", "initialVelocity", "constants"})
        material.passOver(word, "the solver's");
    const auto law = constitutive::makeLaw(material);
    const auto test = constitutive::readSoilTest(material, path, law->poissonRatio(), law->hyperelastic());
    file.rejectUnread();

    const auto points = constitutive::runSoilTest(*law, test);
    const fs::path out = options.value("out", fs::path(path).stem().string() + "Test.csv");
    output::replaceText(out, constitutive::soilTestTable(points, law->usesHistory()).text());
    const auto& s = points.back().stress;
    fmt::print(
        "driveLaw: {} of {}\n{} steps, last stress xx {:.6g} yy {:.6g} zz {:.6g} xy {:.6g} yz {:.6g} zx {:.6g} Pa "
        "({})\nwrote {}\n",
        path, law->describe(), points.size() - 1, s[0], s[1], s[2], s[3], s[4], s[5],
        constitutive::regionName(points.back().region), out.string());
    if (!options.has("noPlot"))
        output::runScript(fs::path(projectFolder()) / "etc/plotLaw",
                          {out.string(), "-title", path + ": " + law->describe()});
    return 0;
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"driveLaw", "stress of a material law along a strain path, at a single point"};
    info.usesCase = false;
    info.options = {{"law", "DICT", "a material dictionary: the file itself, or a nested one"},
                    {"material", "NAME", "which of several materials in DICT"},
                    {"path", "PATH", "oedometer, triaxial, simpleShear or a table of strains, FILE.csv"},
                    {"trial", "FILE", "a table of trial stresses to return, instead of -law and -path"},
                    {"out", "FILE", "the table to write (default: <path>Test.csv; needed by -trial)"},
                    {"noPlot", "", "write no figure"}};
    info.details = constitutive::soilTestHelp();
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        if (options.has("trial") && (options.has("law") || options.has("path") || options.has("material")))
            throw InputError(
                "-trial: found -law, -path or -material beside it, allowed is -trial FILE.csv -out FILE.csv");
        if (options.has("trial"))
            return returnTrials(options);
        if (!options.has("law") || !options.has("path"))
            throw InputError("found too few options, allowed is -law DICT -path PATH or -trial FILE.csv -out FILE.csv");
        return driveLaw(options);
    });
}

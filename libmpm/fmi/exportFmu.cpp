#include "fmi/exportFmu.hpp"

#include "base/error.hpp"
#include "base/version.hpp"
#include "dictionary/dictionary.hpp"
#include "fmi/fmuArchive.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace mpm::fmi
{
namespace fs = std::filesystem;

namespace
{
/// The parts of a case an FMU takes along, in a temporary folder.
class Parts
{
  public:
    Parts(const fs::path& caseFolder, const std::string& timeName)
    {
        std::string name = (fs::temp_directory_path() / "libmpm-export-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw InputError(fmt::format("cannot make a folder below {}", fs::temp_directory_path().string()));
        folder_ = name;
        for (const char* part : {"constant", "system", "geometry"})
            if (fs::exists(caseFolder / part))
                fs::copy(caseFolder / part, folder_ / part, fs::copy_options::recursive);
        fs::create_directory(folder_ / timeName);
        fs::copy_file(caseFolder / timeName / "state.h5", folder_ / timeName / "state.h5");
    }
    ~Parts()
    {
        std::error_code none;
        fs::remove_all(folder_, none);
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;
    const fs::path& folder() const { return folder_; }

  private:
    fs::path folder_;
};

/// 1, 2 or 5 times a power of ten, at most x.
double roundedDown(double x)
{
    const double decade = std::pow(10.0, std::floor(std::log10(x)));
    for (const double factor : {5.0, 2.0})
        if (factor * decade <= x)
            return factor * decade;
    return decade;
}

/// A message about the parts as one about the case they are of.
std::string asOf(const fs::path& caseFolder, const fs::path& parts, std::string message)
{
    const std::string found = parts.string() + "/", said = caseFolder == "." ? "" : caseFolder.string() + "/";
    for (auto at = message.find(found); at != std::string::npos; at = message.find(found, at + said.size()))
        message.replace(at, found.size(), said);
    return message;
}

double endTimeOf(const fs::path& caseFolder)
{
    const auto control = dictionary::Dictionary::readFile(caseFolder / "system/controlDict");
    return control.found("endTime") ? control.get<double>({"endTime", "where a run ends", dictionary::unit::time}) : 0;
}
} // namespace

std::vector<fs::path> fmuBinaries()
{
    std::error_code none;
    const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
    for (const char* place : {"../lib", MPM_LIBRARY_FROM_BIN})
    {
        const fs::path folder = (program / place).lexically_normal();
        if (!fs::exists(folder / "libmpmFMU.so"))
            continue;
        std::vector<fs::path> found{folder / "libmpmFMU.so"};
        // in a portable build the kernels are libraries of their own, one for each instruction set
        for (const auto& entry : fs::recursive_directory_iterator(folder))
            if (entry.path().filename() == "libmpmCore.so")
                found.push_back(entry.path());
        return found;
    }
    throw InputError(fmt::format("found no libmpmFMU.so in {} (build the target mpmFMU)",
                                 (program / "../lib").lexically_normal().string()));
}

FmuExport::FmuExport(const fs::path& caseFolder, const std::string& timeName, const std::string& modelName)
    : binaries_(fmuBinaries())
{
    const Parts parts(caseFolder, timeName);
    try
    {
        read(parts.folder(), modelName);
    }
    catch (const std::exception& error)
    {
        throw InputError(asOf(caseFolder, parts.folder(), error.what()));
    }
}

void FmuExport::read(const fs::path& parts, const std::string& modelName)
{
    packed_ = std::make_unique<CaseCopy>(parts, "");
    coupling::Participant participant(parts);
    if (participant.surfaces().empty())
        throw InputError("system/couplingDict: found no coupling surface, allowed: one or more, so that a master has "
                         "something to couple with");
    participant.initialize(); // checks the surfaces too
    variables_ = variablesOf(participant, numbersOfCase(packed_->folder()));
    facts_.modelName = modelName;
    facts_.modelIdentifier = identifierOf(modelName);
    facts_.token = tokenOf(packed_->folder());
    facts_.startTime = participant.time();
    facts_.stopTime = endTimeOf(packed_->folder());
    facts_.stepSize = roundedDown(20 * participant.stableTimeStep());
}

void FmuExport::write(const fs::path& file, bool overwrite) const
{
    if (fs::exists(file) && !overwrite)
        throw InputError(
            fmt::format("-output: found {} there already; allowed: another name, or -overwrite", file.string()));
    FmuArchive archive(file);
    archive.addText("modelDescription.xml", modelDescription(facts_, variables_));
    archive.addText("documentation/index.html", documentationPage(facts_, variables_));
    archive.addText("documentation/externalDependencies.txt", externalDependencies());
    const fs::path license = fs::path(projectFolder()) / "LICENSE";
    if (fs::exists(license))
        archive.addFile("documentation/licenses/license.txt", license);
    if (const fs::path whole = license.parent_path() / "COPYING"; fs::exists(whole))
        archive.addFile("documentation/licenses/COPYING", whole);
    const std::string folder = "binaries/x86_64-linux/";
    archive.addFile(folder + facts_.modelIdentifier + ".so", binaries_[0]);
    for (std::size_t i = 1; i < binaries_.size(); ++i)
        archive.addFile(folder + binaries_[i].lexically_relative(binaries_[0].parent_path()).generic_string(),
                        binaries_[i]);
    archive.addFolder(std::string("resources/") + caseFolderName, packed_->folder());
    archive.close();
}
} // namespace mpm::fmi

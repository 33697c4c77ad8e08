#pragma once
/// Packs a seeded case as an FMU for FMI 3.0 Co-Simulation.
///
///     modelDescription.xml
///     binaries/x86_64-linux/<modelIdentifier>.so    libmpmFMU.so, and what it needs of ours in a portable build
///     resources/case/                               constant, system, geometry and one state
///     documentation/                                index.html, externalDependencies.txt, licenses/license.txt
///
/// The case is read and checked by a participant before anything is written, from a copy of just what is packed.
#include "fmi/fmuCase.hpp"
#include "fmi/modelDescription.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mpm::fmi
{
class FmuExport
{
  public:
    /// timeName: the folder of the state the FMU begins with. InputError for a case a participant does not take.
    FmuExport(const std::filesystem::path& caseFolder, const std::string& timeName, const std::string& modelName);

    const ModelFacts& facts() const { return facts_; }
    const Variables& variables() const { return variables_; }
    /// InputError if it cannot be written, or is there already and `overwrite` is false.
    void write(const std::filesystem::path& file, bool overwrite) const;

  private:
    void read(const std::filesystem::path& parts, const std::string& modelName);

    std::unique_ptr<CaseCopy> packed_;
    std::vector<std::filesystem::path> binaries_; ///< the library first
    ModelFacts facts_;
    Variables variables_;
};

/// libmpmFMU.so and the libraries of ours it needs, from where this program lies; InputError if there is none.
std::vector<std::filesystem::path> fmuBinaries();
} // namespace mpm::fmi

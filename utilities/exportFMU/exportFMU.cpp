// Packs a seeded case with coupling surfaces as an FMU for FMI 3.0 Co-Simulation.
#include "fmi/exportFmu.hpp"
#include "base/error.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"

#include <fmt/format.h>

#include <filesystem>

int main(int argc, char** argv)
{
    using namespace mpm;
    cases::ApplicationInfo info{"exportFMU", "packs a case as an FMU for FMI 3.0 Co-Simulation"};
    info.options = {{"output", "FILE.fmu", "the FMU (default: <case>.fmu in the case folder)"},
                    {"name", "NAME", "name of the model (default: that of the case folder)"}};
    info.usesTime = info.usesDryRun = info.usesOverwrite = true;
    info.details =
        "The case needs a state (seedParticles) and coupling surfaces (system/couplingDict). The FMU begins with the\n"
        "first state there is, with -time T or -latestTime with that one, and runs as long as its master wants.\n"
        "Poses and resultants of Rigid surfaces become scalars, fields at vertices arrays, numbers of the "
        "dictionaries\n"
        "parameters; docs/coupling-fmi.md lists them. -dry-run checks everything and writes nothing.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory folder(options.caseFolder);
        const std::string name = options.value("name", folder.name());
        const std::filesystem::path file = options.value("output", (folder.folder() / (name + ".fmu")).string());
        if (file.extension() != ".fmu")
            throw InputError(fmt::format("-output: found {}, allowed: a name that ends in .fmu", file.string()));
        if (!options.dryRun && !options.overwrite && std::filesystem::exists(file))
            throw InputError(
                fmt::format("-output: found {} there already; allowed: another name, or -overwrite", file.string()));
        const auto times = options.time || options.latestTime ? folder.selectTimes(options.time, options.latestTime)
                                                              : std::vector{folder.firstTime()};
        if (times.size() != 1)
            throw InputError(fmt::format("-time: found {} times; allowed: one", times.size()));

        const fmi::FmuExport fmu(folder.folder(), times[0].name, name);
        fmt::print("exportFMU: {} from time {}: {} variables, step size {} s\n", fmu.facts().modelIdentifier,
                   times[0].name, fmu.variables().all.size(), fmu.facts().stepSize);
        if (options.dryRun)
            return 0;
        fmu.write(file, options.overwrite);
        fmt::print("  written to {}\n", file.string());
        return 0;
    });
}

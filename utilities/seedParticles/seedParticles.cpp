// Cuts the geometry of a case into particles, with their initial stress: 0/state.h5.
#include "base/error.hpp"
#include "base/terminal.hpp"
#include "base/version.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/caseLock.hpp"
#include "case/fileWatch.hpp"
#include "case/gridFromDict.hpp"
#include "case/interruption.hpp"
#include "case/readScene.hpp"
#include "geometry/geometryFile.hpp"
#include "output/paraviewSeries.hpp"
#include "output/stateFile.hpp"
#include "seeding/seedReport.hpp"

#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <thread>

using namespace mpm;

namespace
{
void refuseOldState(const cases::CaseDirectory& here, bool overwrite)
{
    const auto state = here.statePath("0").lexically_normal();
    if (std::filesystem::exists(state) && !overwrite)
        throw InputError({state.string()}, "holds a state already; -overwrite replaces it");
    if (std::filesystem::exists(here.timePath("0")) && !std::filesystem::is_directory(here.timePath("0")))
        throw InputError({here.timePath("0").string()}, "is no folder; the state would go into it");
    const auto times = here.times();
    if (!times.empty() && times.back().value > 0)
        fmt::print(
            "note: times of an earlier run stay, up to {}; startFrom of controlDict says where mpmSolve begins\n",
            times.back().name);
}
/// The geometry file; a wrong name is told where it was written.
std::filesystem::path geometryFile(const cases::CaseDirectory& here, const seeding::SeedOptions& how)
{
    try
    {
        const auto file = here.geometryPath(how.geometry);
        geometry::checkedEnding(file);
        return file;
    }
    catch (const InputError& error)
    {
        if (how.geometry.empty())
            throw;
        throw InputError(how.geometryWhere, std::string("geometry: ") + error.what());
    }
}

/// Once from dictionaries and geometry to 0/state.h5.
void seed(const cases::CaseDirectory& here, bool dryRun)
{
    const auto read = [&](const std::string& name) {
        return dictionary::Dictionary::readFile(here.dictionaryPath(name));
    };

    const auto gridDict = read("system/gridDict"), seedDict = read("system/seedParticlesDict");
    const auto materialDict = read("constant/materialProperties");
    const state::GridBox grid = cases::gridFromDict(gridDict);
    const seeding::SeedOptions how = seeding::readSeedOptions(seedDict);
    std::optional<Vector3> g;
    if (here.hasFile("constant/g"))
    {
        const auto gravityDict = read("constant/g");
        g = cases::readGravity(gravityDict, grid.dim);
        cases::readGravityRamp(gravityDict); // of the solver; checked here too
        gravityDict.rejectUnread();
    }
    const auto materials = seeding::readMaterials(materialDict, g.value_or(Vector3{}), grid.dim);
    for (const auto* dict : {&gridDict, &seedDict, &materialDict})
        dict->rejectUnread();

    const auto body = geometry::readGeometry(geometryFile(here, how), grid.dim, how.scale, how.meshingTime);
    seeding::Seeding seeded = seeding::seedState(body, grid, materials, how);
    seeded.state.provenance = {{"version", projectVersion()},
                               {"revision", gitRevision()},
                               {"seededBy", "seedParticles"},
                               {"seedParticlesDict", seedDict.text()}};
    fmt::print("seedParticles, libmpm {} ({})\n{}", projectVersion(), gitRevision(),
               seeding::report(body, seeded, materials, how));

    if (dryRun)
        return;
    here.requireWritable();
    output::writeState(here.timePath("0"), seeded.state);
    output::writeParaviewSeries(here.folder(), here.name(), {"0"});
    fmt::print("wrote 0/state.h5\n");
}

/// What a person who edits the case sees between two seedings.
void say(const std::string& text)
{
    fmt::print("{}\n", text);
    std::fflush(stdout);
}

/// Waits for other programs in the case; nothing if a signal came first.
std::unique_ptr<cases::CaseLock> lockWhenFree(const cases::Options& options, const cases::Interruption& interruption)
{
    std::unique_ptr<cases::CaseLock> lock;
    for (bool told = false; !lock && !interruption.signal();)
        try
        {
            lock = std::make_unique<cases::CaseLock>(options, "seedParticles");
        }
        catch (const InputError& error)
        {
            if (!told)
                say(fmt::format("waiting: {}", error.what()));
            told = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
        }
    return lock;
}

/// Seeds, and again after every change of geometry or dictionaries, until a signal ends it. A mistake is told, and the
/// state stays as it was.
int watch(const cases::Options& options)
{
    const cases::CaseDirectory here(options.caseFolder);
    const cases::Interruption interruption;
    const auto stopped = [&] { return interruption.signal() != 0; };
    cases::FileWatch files({here.folder() / "geometry", here.folder() / "constant", here.folder() / "system"});
    refuseOldState(here, options.overwrite || options.dryRun);
    if (!options.dryRun)
        here.requireWritable();
    while (!stopped())
    {
        try
        {
            if (const auto lock = lockWhenFree(options, interruption))
                seed(here, options.dryRun);
        }
        catch (const InputError& error)
        {
            std::fputs(fmt::format("--> seedParticles: error: {}\n", error.what()).c_str(), stderr);
            say("0/state.h5 is as it was");
        }
        say("watching geometry, constant and system; Ctrl-C ends it");
        const auto changed = files.wait(stopped);
        for (const auto& file : changed.value_or(std::vector<std::filesystem::path>{}))
            say(fmt::format("changed: {}", file.lexically_relative(here.folder()).string()));
    }
    return cases::Interruption::exitCode(interruption.signal());
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"seedParticles", "particles with initial stress from the geometry of a case"};
    info.usesDryRun = info.usesOverwrite = true;
    info.options = {{"watch", "", "go on and seed again whenever geometry, constant or system changes, until Ctrl-C"}};
    info.details =
        "Reads system/{seedParticlesDict,gridDict}, constant/{materialProperties,g} and the geometry (.geo, .step, "
        ".stl,\n"
        ".msh). Writes 0/state.h5 and <case>.xdmf for ParaView. -dry-run says what would be seeded and writes nothing.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        if (options.has("watch"))
            return watch(options);
        const cases::CaseDirectory here(options.caseFolder);
        const cases::CaseLock lock(options, "seedParticles");
        refuseOldState(here, options.overwrite);
        seed(here, options.dryRun);
        return 0;
    });
}

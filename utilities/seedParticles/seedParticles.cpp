// Cuts the geometry of a case into particles, with their initial stress: 0/state.h5.
#include "base/error.hpp"
#include "base/terminal.hpp"
#include "base/version.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/caseLock.hpp"
#include "case/gridFromDict.hpp"
#include "case/readScene.hpp"
#include "geometry/geometryFile.hpp"
#include "output/paraviewSeries.hpp"
#include "output/stateFile.hpp"
#include "seeding/seedReport.hpp"

#include <fmt/format.h>

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
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"seedParticles", "particles with initial stress from the geometry of a case"};
    info.usesDryRun = info.usesOverwrite = true;
    info.details =
        "Reads system/{seedParticlesDict,gridDict}, constant/{materialProperties,g} and the geometry (.geo, .step, "
        ".stl,\n"
        ".msh). Writes 0/state.h5 and <case>.xdmf for ParaView. -dry-run says what would be seeded and writes nothing.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory here(options.caseFolder);
        const cases::CaseLock lock(options, "seedParticles");
        refuseOldState(here, options.overwrite);
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

        if (options.dryRun)
            return 0;
        here.requireWritable();
        output::writeState(here.timePath("0"), seeded.state);
        output::writeParaviewSeries(here.folder(), here.name(), {"0"});
        fmt::print("wrote 0/state.h5\n");
        return 0;
    });
}

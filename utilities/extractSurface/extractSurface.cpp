// The closed surface of the deformed material at stored times, as STL (3D) and gmsh mesh: from particles back to
// geometry.
#include "base/error.hpp"
#include "base/terminal.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/caseLock.hpp"
#include "coupling/couplingError.hpp"
#include "coupling/exportSurface.hpp"
#include "dictionary/dictionary.hpp"
#include "geometry/deformedSurface.hpp"
#include "geometry/particleDomains.hpp"
#include "geometry/readSurfaceChoices.hpp"
#include "output/stateFile.hpp"

#include <algorithm>
#include <fmt/format.h>

using namespace mpm;

namespace
{
geometry::SurfaceChoices readChoices(const cases::CaseDirectory& here)
{
    const std::string name = "system/extractSurfaceDict";
    const auto dict = here.hasFile(name) ? dictionary::Dictionary::readFile(here.dictionaryPath(name))
                                         : dictionary::Dictionary::fromText("", "the defaults of " + name);
    auto made = geometry::readSurfaceChoices(dict);
    dict.rejectUnread();
    return made;
}

std::optional<int> chosenMaterial(const geometry::SurfaceChoices& choices, const state::State& state)
{
    if (choices.material == "all")
        return std::nullopt;
    const auto found = std::find(state.materials.begin(), state.materials.end(), choices.material);
    if (found != state.materials.end())
        return int(found - state.materials.begin());
    auto known = state.materials;
    known.push_back("all");
    const std::string near = nearestWord(choices.material, known);
    throw InputError(choices.materialWhere,
                     fmt::format("material: found '{}', allowed: {}{}", choices.material, joinWords(known),
                                 near.empty() ? "" : fmt::format(" (did you mean {}?)", near)));
}

geometry::DeformedSurface surfaceOf(const cases::CaseDirectory& here, const std::string& time,
                                    const geometry::SurfaceChoices& choices)
{
    const auto state = output::readState(here.statePath(time));
    const auto how = choices.on(state.grid.h, *std::max_element(state.seedSpacing.begin(), state.seedSpacing.end()));
    const auto domains = geometry::particleDomains(state.particles, chosenMaterial(choices, state));
    try
    {
        return geometry::deformedSurface(domains, state.particles.dim, how);
    }
    catch (const InputError& error)
    {
        throw InputError({here.statePath(time).lexically_normal().string()},
                         std::string(error.what()) + " (system/extractSurfaceDict)");
    }
}

std::vector<std::filesystem::path> targets(const std::filesystem::path& folder, const std::string& time, int dim)
{
    std::vector<std::filesystem::path> files{folder / fmt::format("surface_{}.msh", time)};
    if (dim == 3)
        files.push_back(folder / fmt::format("surface_{}.stl", time));
    return files;
}

void requireFree(const std::vector<std::filesystem::path>& files, bool overwrite)
{
    for (const auto& file : files)
        if (!overwrite && std::filesystem::exists(file))
            throw InputError({file.lexically_normal().string()}, "is there already; -overwrite replaces it");
}

void write(const cases::CaseDirectory& here, const std::string& time, const std::string& material,
           const geometry::DeformedSurface& surface)
{
    coupling::SurfaceMesh mesh{surface.dim, surface.points, {}};
    for (const auto& e : surface.elements)
        mesh.elements.push_back({e[0], e[1], e[2]});
    try
    {
        for (const auto& file : targets(here.postProcessing(), time, surface.dim))
            coupling::exportSurface(file, material == "all" ? "surface" : material, mesh);
    }
    catch (const coupling::CouplingError& error)
    {
        throw InputError(error.what()); // a folder or disk that takes no file
    }
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"extractSurface", "the closed surface of the deformed material at stored times"};
    info.usesTime = info.usesDryRun = info.usesOverwrite = true;
    info.details =
        "Writes postProcessing/surface_<time>.msh (gmsh 4.1; in 2D its loops) and, in 3D, surface_<time>.stl, and "
        "prints the\n"
        "volume they enclose against that of the particles. A .geo file that merges the .msh makes a body of it "
        "again.\n"
        "Reads system/extractSurfaceDict, if it is there: material (all), alpha (cells; gaps and hollows narrower than "
        "two\n"
        "of it are closed; default one seeding spacing), offset (cells, 3D; 0.0125), pieces (one | largest | all),\n"
        "matchVolume (yes), volumeTolerance (0.15). Without -time or -latestTime: all stored times.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory here(options.caseFolder);
        const cases::CaseLock lock(options, "extractSurface");
        const auto times = here.selectTimes(options.time, options.latestTime);
        const auto choices = readChoices(here);
        const int dim = output::readSummary(here.statePath(times[0].name)).dim;
        for (const auto& time : times)
            requireFree(targets(here.folder() / "postProcessing", time.name, dim), options.overwrite);
        if (!options.dryRun)
            here.requireWritable();
        const char* const unit = dim == 2 ? "m2" : "m3";
        Table table({"time", fmt::format("particles [{}]", unit), "outline", "off [%]",
                     fmt::format("surface [{}]", unit), "off [%]", "moved in [m]", "pieces",
                     dim == 2 ? "segments" : "triangles"});
        std::vector<std::string> notes;
        std::vector<geometry::DeformedSurface> surfaces; // all, before anything is written
        for (const auto& time : times)
        {
            const auto& surface = surfaces.emplace_back(surfaceOf(here, time.name, choices));
            const auto off = [&](double volume) {
                return fmt::format("{:.3f}", 100 * (volume / surface.particleVolume - 1));
            };
            table.row({time.name, fmt::format("{:.9g}", surface.particleVolume),
                       fmt::format("{:.9g}", surface.outlineVolume), off(surface.outlineVolume),
                       fmt::format("{:.9g}", surface.volume), off(surface.volume),
                       fmt::format("{:.3g}", surface.movedIn), std::to_string(surface.pieces),
                       std::to_string(surface.elements.size())});
            for (const auto& note : surface.notes)
                notes.push_back(fmt::format("  note: time {}: {}\n", time.name, note));
        }
        for (std::size_t i = 0; i < times.size() && !options.dryRun; ++i)
            write(here, times[i].name, choices.material, surfaces[i]);
        fmt::print("extractSurface of {}\n{}", here.name(), table.text());
        for (const auto& note : notes)
            fmt::print("{}", note);
        if (!options.dryRun)
            fmt::print("wrote postProcessing/surface_<time>{}\n", dim == 2 ? ".msh" : ".msh and .stl");
        return 0;
    });
}

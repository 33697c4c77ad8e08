// Refines a stored state: splits stretched particles by the rule of system/splitParticlesDict, with the code the solver
// splits with.
#include "base/error.hpp"
#include "base/version.hpp"
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/caseLock.hpp"
#include "case/copyCase.hpp"
#include "case/provenance.hpp"
#include "case/readScene.hpp"
#include "case/readSchemes.hpp"
#include "case/writtenTimes.hpp"
#include "output/stateFile.hpp"

#include <fmt/format.h>

int main(int argc, char** argv)
{
    using namespace mpm;
    cases::ApplicationInfo info{"splitParticles", "splits stretched particles of a stored state"};
    info.options = {{"target", "DIR",
                     "write the refined state into a new case folder, which copies constant, system and "
                     "geometry; a relative path starts at the case folder"}};
    info.usesTime = info.usesDryRun = info.usesOverwrite = true;
    info.details =
        "Reads system/splitParticlesDict: threshold (longest edge in seeding spacings), mode (fourWay | stretched), "
        "maxParticles, maxGeneration, passes (how often children are looked at again, default 8).\n"
        "Without -target the state itself is replaced and its derived fields are dropped, which needs -overwrite. "
        "Works on one time: -time T, or the latest.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory folder(options.caseFolder);
        std::optional<cases::CaseLock> lock;
        if (!options.has("target"))
            lock.emplace(options, "splitParticles");
        const auto times = folder.selectTimes(options.time, options.latestTime || !options.time);
        if (times.size() != 1)
            throw InputError(fmt::format("-time: found {} times; allowed: one", times.size()));
        auto state = output::readState(folder.statePath(times[0].name));
        const auto dict = dictionary::Dictionary::readFile(folder.dictionaryPath("system/splitParticlesDict"));
        const auto rule = cases::readSplitRule(dict);
        const Index passes = dict.get<Index>(
            {"passes", "how often children are looked at again", {}, dictionary::Bound::between(1, 100), Index(8)});
        dict.rejectUnread();
        const auto scene = cases::readScene(folder, state).scene;

        const Index before = state.particles.size();
        const auto barriers = stepping::wallBarriers(scene, state.grid);
        for (Index pass = 0; pass < passes; ++pass)
            if (splitting::splitParticles(state, rule, barriers).added == 0)
                break;
        fmt::print("splitParticles: time {}: {} particles become {}; {} splits put off at walls, {} refused by caps\n",
                   times[0].name, before, state.particles.size(), state.ledger.splitsPutOff, state.ledger.splitsCapped);
        for (const auto& note :
             {cases::instructionSetNote(state, instructionSet()), cases::storageNote(state, storage())})
            if (!note.empty())
                fmt::print("  note: {}\n", note);
        cases::recordInstructionSet(state, instructionSet());
        cases::recordStorage(state, storage());
        cases::forgetTurn(state);
        if (options.dryRun)
            return 0;
        if (options.has("target"))
        {
            const auto target = cases::copyCase(folder, options.value("target"), options.overwrite);
            lock.emplace(target, "splitParticles");
            output::writeState(target / times[0].name, state);
            fmt::print("  written to {}\n", (std::filesystem::path(options.value("target")) / times[0].name).string());
            return 0;
        }
        if (!options.overwrite)
            throw InputError(
                "splitParticles: found neither -target nor -overwrite; allowed: -target DIR for a new case "
                "folder, or -overwrite to replace the state");
        output::writeState(folder.timePath(times[0].name), state);
        return 0;
    });
}

// The accuracy of time integration, against SUNDIALS CVODE. -law: the return map of the case's materials along strain
// paths. -time: the schemes of the step, from a stored time on.
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/readScene.hpp"
#include "case/timeCheck.hpp"
#include "output/replaceFile.hpp"
#include "output/stateFile.hpp"
#include "reference/lawCheck.hpp"
#include "reference/semiDiscreteSolution.hpp"

#include <fmt/format.h>

using namespace mpm;

namespace
{
reference::Laws readLaws(const cases::CaseDirectory& here)
{
    const auto properties = dictionary::Dictionary::readFile(here.dictionaryPath("constant/materialProperties"));
    reference::Laws laws;
    for (const auto& material : cases::readMaterials(properties))
        laws[material.name] = material.law;
    properties.rejectUnread();
    return laws;
}

int checkLaw(const cases::Options& options)
{
    const cases::CaseDirectory here(options.caseFolder);
    const auto dict = dictionary::Dictionary::readFile(here.dictionaryPath("system/checkIntegrationDict"));
    const auto checks = reference::readLawChecks(dict, readLaws(here), here.folder());
    fmt::print("checkIntegration of {}: {} paths, rate equations by SUNDIALS CVODE\n", here.name(), checks.size());
    if (options.dryRun)
        return 0;
    here.requireWritable();
    CsvTable table = reference::lawCheckTable();
    for (const auto& check : checks)
    {
        const auto result = reference::runLawCheck(check);
        fmt::print("\n{}", reference::lawCheckText(check, result));
        reference::addLawCheckRows(table, check, result);
    }
    output::replaceText(here.postProcessing() / "checkIntegrationLaw.csv", table.text());
    fmt::print("\nwrote postProcessing/checkIntegrationLaw.csv\n");
    return 0;
}

cases::TimeFolder chosenTime(const cases::CaseDirectory& here, const cases::Options& options)
{
    if (options.has("latestTime"))
        return here.latestTime();
    const auto text = options.value("time");
    return text.empty() ? here.firstTime() : here.nearestTime(options.number("time", 0));
}

int checkTime(const cases::Options& options)
{
    const cases::CaseDirectory here(options.caseFolder);
    if (here.times().empty())
        throw InputError(here.folder().string() + ": found no time folder with a state.h5; run seedParticles first");
    const auto time = chosenTime(here, options);
    auto state = output::readState(here.statePath(time.name));
    const auto scene = cases::readScene(here, state);
    const auto dict = dictionary::Dictionary::readFile(here.dictionaryPath("system/checkIntegrationDict"));
    const auto check = cases::readTimeCheck(dict, scene, state);
    fmt::print("checkIntegration of {} from time {}\n", here.name(), time.name);
    if (options.dryRun)
        return 0;
    here.requireWritable();
    const auto result =
        cases::runTimeCheck(check, scene, state,
                            [](auto& equations, const auto& start, const auto& model, double window, double tolerance) {
                                return reference::integrateSemiDiscrete(equations, start, model, window, tolerance).y;
                            });
    fmt::print("{}", cases::timeCheckText(check, result, scene, state));
    output::replaceText(here.postProcessing() / "checkIntegrationTime.csv",
                        cases::timeCheckTable(result, state.grid.h).text());
    fmt::print("\nwrote postProcessing/checkIntegrationTime.csv\n");
    return 0;
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"checkIntegration", "accuracy of time integration, against an ODE solver"};
    info.usesDryRun = true;
    info.usesThreads = true;
    info.options = {{"law", "", "the stress update along the strain paths of system/checkIntegrationDict"},
                    {"time", "[T]", "the time step, from the stored time nearest to T on (default: the first)"},
                    {"latestTime", "", "the time step, from the latest stored time on"}};
    info.details =
        "-law prints error and order of the return map for each number of steps, and writes them to\n"
        "postProcessing/checkIntegrationLaw.csv. Paths are harmonic strain rates given in the dictionary, or\n"
        "strain paths of particles recorded by mpmSolve (recordStrain { particles (...); } in controlDict).\n"
        "-time prints the temporal error of each scheme against dt over a window, and writes it to\n"
        "postProcessing/checkIntegrationTime.csv. The reference are the semi-discrete equations by CVODE where\n"
        "laws, walls and shape are smooth, elsewhere each scheme itself at half its smallest step.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const bool time = options.has("time") || options.has("latestTime");
        if (options.has("law") == time)
            throw InputError(fmt::format("found {}, allowed is either -law or -time",
                                         time ? "both -law and -time" : "no option that says what to check"));
        return time ? checkTime(options) : checkLaw(options);
    });
}

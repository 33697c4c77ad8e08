// The accuracy of time integration, against SUNDIALS CVODE. -law: the return map of the case's materials along strain
// paths.
#include "case/application.hpp"
#include "case/caseDirectory.hpp"
#include "case/readScene.hpp"
#include "output/replaceFile.hpp"
#include "reference/lawCheck.hpp"

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
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"checkIntegration", "accuracy of time integration, against an ODE solver"};
    info.usesDryRun = true;
    info.options = {{"law", "", "the stress update along the strain paths of system/checkIntegrationDict"}};
    info.details =
        "Prints error and order of the return map for each number of steps, and writes them to\n"
        "postProcessing/checkIntegrationLaw.csv. Paths are harmonic strain rates given in the dictionary, or\n"
        "strain paths of particles recorded by mpmSolve (recordStrain { particles (...); } in controlDict).";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        if (!options.has("law"))
            throw InputError("found no option that says what to check, allowed is -law");
        return checkLaw(options);
    });
}

// What accuracy costs: runs a case with many settings and shows error against processor time.
#include "base/version.hpp"
#include "case/accuracyReport.hpp"
#include "case/application.hpp"
#include "case/caseLock.hpp"
#include "case/interruption.hpp"
#include "output/replaceFile.hpp"
#include "output/runScript.hpp"
#include "reference/semiDiscreteSolution.hpp"

#include <algorithm>
#include <fmt/format.h>

using namespace mpm;

namespace
{
struct Plan
{
    std::vector<cases::MatrixRow> rows;
    std::optional<std::size_t> reference;
    cases::ExactSolution exact;
    std::vector<cases::Measure> measures;
    Index repeats = 0;
};

Plan readPlan(const cases::CaseDirectory& here)
{
    const auto dict = dictionary::Dictionary::readFile(here.dictionaryPath("system/accuracyCostDict"));
    const auto grid = dictionary::Dictionary::readFile(here.dictionaryPath("system/gridDict"));
    const int dim = int(grid.get<Index>({"dimension", "2: plane strain, 3"}));
    Plan plan;
    plan.rows = cases::readMatrix(dict);
    if (const auto* reference = dict.findDict("reference", "settings of the run others are compared with"))
    {
        plan.reference = plan.rows.size();
        plan.rows.push_back({"reference", "reference", cases::readSetting(*reference)});
    }
    if (const auto* exact = dict.findDict("exact", "the exact solution"))
        plan.exact = cases::ExactSolution(*exact, dim);
    plan.measures = cases::readMeasures(dict, plan.exact, dim);
    plan.repeats = dict.get<Index>({"repeats",
                                    "of each run, for its time; 0: three of short runs",
                                    {},
                                    dictionary::Bound::between(0, 1000),
                                    Index(0)});
    dict.rejectUnread();
    return plan;
}

std::optional<double> within(const cases::Options& options)
{
    if (!options.has("within"))
        return std::nullopt;
    const double bound = options.number("within", 0);
    if (!(bound > 0))
        throw InputError(fmt::format("-within: found {:g}, allowed an error > 0", bound));
    return bound;
}

int rowsSideBySide(const cases::Options& options)
{
    const double rows = options.number("threads", 1);
    if (!(rows >= 1 && rows <= 1024) || rows != double(int(rows)))
        throw InputError(fmt::format("-threads: found {:g}, allowed an integer from 1 to 1024", rows));
    return int(rows);
}

int run(const cases::Options& options)
{
    const cases::CaseDirectory here(options.caseFolder);
    const auto bound = within(options);
    const int sideBySide = rowsSideBySide(options);
    const Plan plan = readPlan(here);
    const bool storedTimes = std::any_of(plan.measures.begin(), plan.measures.end(),
                                         [](const auto& measure) { return measure.storedTimes; });
    const cases::AccuracyCase base(here, storedTimes);
    fmt::print("accuracyCost of {}: {} rows, {} measures; {}\n", here.name(), plan.rows.size(), plan.measures.size(),
               cases::machineName());
    if (options.dryRun)
    {
        fmt::print("{}", cases::matrixText(base, plan.rows));
        return 0;
    }
    const cases::CaseLock lock(options, "accuracyCost");
    here.requireWritable();
    if (sideBySide > 1)
        fmt::print("  {} rows run side by side: they slow each other down, so compare times within this table only\n",
                   sideBySide);
    const cases::Interruption interruption;
    const cases::RunOptions how{.repeats = plan.repeats,
                                .sideBySide = sideBySide,
                                .again = options.overwrite,
                                .stopped = [&] { return interruption.signal() != 0; }};
    const auto results = cases::runRows(base, plan.rows, how);
    const auto all =
        cases::evaluate(base, plan.rows, results, plan.measures, plan.exact, plan.reference,
                        [](auto& equations, const auto& start, const auto& model, double window, double tolerance) {
                            return reference::integrateSemiDiscrete(equations, start, model, window, tolerance).y;
                        });
    const auto file = here.postProcessing() / "accuracyCost.csv";
    output::replaceText(file, cases::costTable(all).text());
    fmt::print("\nwrote postProcessing/accuracyCost.csv\n");
    if (interruption.signal())
    {
        fmt::print(stderr, "--> accuracyCost: stopped by {}; run it again to go on with the rows that are left\n",
                   cases::signalName(interruption.signal()));
        return cases::Interruption::exitCode(interruption.signal());
    }
    fmt::print("{}", cases::costReport(all, bound));
    if (!options.has("noFigures"))
        output::runScript(projectFolder() + "/etc/plotAccuracyCost", {"-case", here.folder().string()});
    return 0;
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"accuracyCost", "error against processor time, for many settings of one case"};
    info.usesDryRun = info.usesOverwrite = true;
    info.options = {{"threads", "N", "rows run side by side (default 1: times are fair)"},
                    {"within", "ERROR", "the cheapest setting for this error (default: for each decade)"},
                    {"noFigures", "", "write the table alone"}};
    info.details =
        "Reads system/accuracyCostDict: axes and methods (the settings to try), measures (what is called the error)\n"
        "and exact (a solution, if there is one); libmpm/case/accuracy{Matrix,Measure,Exact}.hpp describe them.\n"
        "Runs seedParticles and mpmSolve in copies of the case, accuracyCost/<row>/, one thread each. Rows that were\n"
        "run with the same dictionaries and version are taken over; -overwrite runs all again.\n"
        "Writes postProcessing/accuracyCost.csv and postProcessing/figures/accuracyCost-<measure>.{png,svg}.\n"
        "-dry-run lists the rows and what speaks against them.";
    return cases::runApplication(argc, argv, info, run);
}

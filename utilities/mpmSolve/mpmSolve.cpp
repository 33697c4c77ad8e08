// Solves the motion of a case: from the last stored state to endTime, one explicit step after the other.
#include "case/caseLock.hpp"
#include "case/interruption.hpp"
#include "case/pickSetting.hpp"
#include "case/solverRun.hpp"

int main(int argc, char** argv)
{
    using namespace mpm;
    cases::ApplicationInfo info{"mpmSolve", "large deformation of solids by the material point method"};
    info.options = {{"effects", "", "what each effect costs here, in use or off: measured, nothing written"},
                    {"markdown", "", "with -effects: the page docs/effects.md"},
                    {"profile", "", "write postProcessing/profile.csv: where the time went, pass by pass"},
                    {"withinTime", "SECONDS", "run the most accurate setting that is predicted to take no longer"},
                    {"withinError", "ERROR", "run the cheapest setting with an error no larger"},
                    {"errorMeasure", "NAME", "which error of postProcessing/accuracyCost.csv (default: the first)"}};
    info.usesDryRun = info.usesOverwrite = info.usesThreads = true;
    info.details =
        "Reads constant/{materialProperties,boundaryConditions,g,bodyForce}, system/{controlDict,gridDict,mpmSchemes} "
        "and "
        "the state of the start time (seedParticles makes the first).\n"
        "Writes time folders, postProcessing/history.csv and energyBudget.csv, and <case>.xdmf for ParaView.\n"
        "constant/bodyForce { value (\"A*sin(pi*X)*cos(t)\" 0 0); constants { A 0.05; } }: variables x y z X Y Z t; "
        "where\n"
        "X Y Z are named, and with fields (referencePosition); in controlDict, states hold where particles started.\n"
        "-dry-run reads and checks everything, says what would be done and what it will cost, and writes nothing:\n"
        "steps, memory, bytes, and seconds from up to 2 s of steps that are thrown away; and the error to expect, "
        "where\n"
        "accuracyCost has been run in the case.\n"
        "-withinTime and -withinError pick scheme and time step from the table accuracyCost made, say what and why, "
        "and\n"
        "run with them; the dictionaries stay as they are, and a run that goes on keeps them. Cells and particles are\n"
        "those of the seeded state.\n"
        "-effects steps copies of the state with and without every effect for a few seconds, and says what share of a "
        "step\n"
        "and how many bytes a particle each takes, and what those that are off would add.\n"
        "-overwrite with startFrom firstTime or startTime removes stored times after the start.\n"
        "Ctrl-C (SIGINT), SIGTERM and SIGHUP: the step is finished and its state written, so that startFrom "
        "latestTime\n"
        "goes on bitwise; that time is removed once the next one in turn is on disk. A second signal kills at once.\n"
        "Exit codes: 0 endTime is reached; 1 wrong input, or nothing can be written; 2 the calculation cannot go on;\n"
        "3 a mistake of ours; 130, 143, 129 stopped by SIGINT, SIGTERM, SIGHUP.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory folder(options.caseFolder);
        if (cases::wantsEffects(options))
            return cases::SolverRun(folder, options).printEffects(), 0;
        const cases::CaseLock lock(options, "mpmSolve");
        const auto picked = cases::wantsPick(options) ? cases::pickSetting(folder, options) : cases::Overrides();
        cases::SolverRun run(folder, options, picked);
        run.banner();
        if (options.dryRun)
            return run.printPrediction(run.rehearse()), 0;
        const cases::Interruption interruption;
        run.openOutput();
        while (!run.done() && !interruption.signal())
        {
            run.step();
            run.writeIfDue();
        }
        if (!run.done())
            return run.stop(interruption.signal());
        run.summary();
        return 0;
    });
}

// Solves the motion of a case: from the last stored state to endTime, one explicit step after the other.
#include "case/solverRun.hpp"

int main(int argc, char** argv)
{
    using namespace mpm;
    cases::ApplicationInfo info{"mpmSolve", "large deformation of solids by the material point method"};
    info.options = {{"profile", "", "write postProcessing/profile.csv: where the time went, pass by pass"}};
    info.usesDryRun = info.usesOverwrite = info.usesThreads = true;
    info.details =
        "Reads constant/{materialProperties,boundaryConditions,g}, system/{controlDict,gridDict,mpmSchemes} and "
        "the state of the start time (seedParticles makes the first).\n"
        "Writes time folders, postProcessing/history.csv and energyBudget.csv, and <case>.xdmf for ParaView.\n"
        "-dry-run reads and checks everything, says what would be done and writes nothing.\n"
        "-overwrite with startFrom firstTime or startTime removes stored times after the start.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory folder(options.caseFolder);
        cases::SolverRun run(folder, options);
        run.banner();
        if (options.dryRun)
            return 0;
        run.openOutput();
        while (!run.done())
        {
            run.step();
            run.writeIfDue();
        }
        run.summary();
        return 0;
    });
}

// Brings the seeded body to rest under its loads: 0/state.h5 with the initial stress of gravity loading.
#include "case/gravityLoading.hpp"
#include "case/caseLock.hpp"

int main(int argc, char** argv)
{
    using namespace mpm;
    cases::ApplicationInfo info{"gravityLoading", "initial stress by damped motion to equilibrium under all loads"};
    info.usesDryRun = info.usesOverwrite = info.usesThreads = true;
    info.details =
        "Runs between seedParticles and mpmSolve on 0/state.h5, with the scene mpmSolve will see.\n"
        "Reads system/gravityLoadingDict, where there is one: dynamicRelaxation { damping local | kinetic; "
        "coefficient;\n"
        "tolerance (net over applied forces at rest); kineticTolerance (kinetic over elastic energy) },\n"
        "maxSteps, maxTime, and keepPositions: yes (default) keeps only stresses, positions and deformation are those\n"
        "seeded; no keeps the deformed body. Velocities are zero in the end.\n"
        "-dry-run reads and checks everything and writes nothing. -overwrite loads a state anew that is loaded "
        "already.\n"
        "Exit code 2: the body came to no rest (a slope that fails has no equilibrium); nothing is written.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        const cases::CaseDirectory folder(options.caseFolder);
        const cases::CaseLock lock(options, "gravityLoading");
        cases::GravityLoading loading(folder, options);
        loading.banner();
        if (options.dryRun)
            return 0;
        loading.run();
        loading.report();
        loading.write();
        return 0;
    });
}

// Runs a case as one participant of a simulation that preCICE couples.
#include "case/application.hpp"
#include "precice/preciceLink.hpp"

#include <fmt/format.h>

int main(int argc, char** argv)
{
    using namespace mpm;
    const std::string version = precice::preciceVersion();
    cases::ApplicationInfo info{"mpmCouple", "a case as participant of a simulation coupled by preCICE"};
    info.usesDryRun = info.usesThreads = true;
    info.details =
        fmt::format("This program was built {}.\n\n", version.empty() ? "without preCICE" : "with " + version) +
        "Reads what mpmSolve reads, and system/couplingDict:\n"
        "    surfaces { wall { type Rigid; geometry \"geometry/wall.msh\"; } }\n"
        "    preciceCoupling\n"
        "    {\n"
        "        config \"../precice-config.xml\";  participant Soil;    // from the case folder; our name there\n"
        "        surfaces { wall { mesh SoilMesh; read (Displacement Rotation); write (Force Torque); } }\n"
        "    }\n"
        "Rigid surfaces are one vertex at their reference point: read Displacement, Rotation, Velocity, "
        "AngularVelocity;\n"
        "write Force, Torque, ContactArea. Deformable: read Displacement, Velocity; write Force, Traction, "
        "ContactArea.\n"
        "Monitor: read Force, Traction; write Displacement, Velocity. In 2D rotations and torques are scalars, forces "
        "per\n"
        "metre. Options: maxStep [s], samples, forces windowAverage | instantaneous; `read { Displacement NameThere; "
        "}`.\n"
        "Windows end where preCICE says; within them the soil takes its own steps. Time folders and rows are written "
        "for\n"
        "accepted windows only. preCICE looks for its exchange-directory from where the program is started.\n"
        "-dry-run reads and checks couplingDict and the case, and connects to nobody.\n"
        "Ctrl-C (SIGINT), SIGTERM, SIGHUP: the last accepted window is written, so that startFrom latestTime goes on.\n"
        "Exit codes: 0 preCICE ended the coupling; 1 wrong input; 2 the partner is gone, or the soil cannot go on;\n"
        "3 a mistake of ours; 130, 143, 129 stopped by a signal.";
    return cases::runApplication(argc, argv, info, [](const cases::Options& options) {
        precice::CoupledCase coupled(options);
        coupled.banner();
        return options.dryRun ? 0 : precice::runWithPrecice(coupled);
    });
}

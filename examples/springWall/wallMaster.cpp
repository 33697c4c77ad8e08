// The master of cases/columnSpringWall: a wall on a spring (CVODE) and the soil that pushes it, in one process, in two,
// or with the soil as an FMU.
#include "base/error.hpp"
#include "case/application.hpp"
#include "coupling.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>

using namespace mpm;
using namespace springWall;

namespace
{
std::unique_ptr<SoilSide> soilOf(const cases::Options& options)
{
    if (options.has("socket"))
        return soilBySocket(options.value("socket"));
    if (options.has("fmu"))
        return soilByFmu(options.value("fmu"));
    if (!options.has("case"))
        throw InputError("found neither -case nor -socket nor -fmu, allowed is one of them");
    return soilInProcess(options.value("case"), options.threadCount());
}

Scheme schemeOf(const cases::Options& options)
{
    Scheme scheme;
    const std::string word = options.value("coupling", "implicit");
    if (word != "implicit" && word != "explicit")
        throw InputError("-coupling: found '" + word + "', allowed implicit or explicit");
    scheme.implicitly = word == "implicit";
    scheme.window = options.number("window", scheme.window);
    if (!(scheme.window > 0))
        throw InputError(fmt::format("-window: found {:g}, allowed > 0", scheme.window));
    scheme.tolerance = options.number("tolerance", scheme.tolerance);
    return scheme;
}

/// Shortest decimals that are read back as the same double: two files are the same bit by bit or not at all.
void writeRow(std::ofstream& out, const Row& row, const reference::SpringWall& wall)
{
    const auto& s = wall.state();
    out << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", row.time, s.position, s.velocity, row.force,
                       row.soilImpulse, row.wallImpulse, row.soilWork, s.work, s.heat, wall.kineticEnergy(),
                       wall.springEnergy(), row.mismatch, row.iterations);
}

int run(const cases::Options& options)
{
    reference::SpringWall wall(
        {options.number("mass", 2e4), options.number("damping", 0), options.number("stiffness", 5e5)});
    const Scheme scheme = schemeOf(options);
    const double end = options.number("end", 1);
    const std::string file = options.value("output", "springWall.csv");
    const auto soil = soilOf(options);
    std::ofstream out(file);
    out << "time,x,v,force,soilImpulse,wallImpulse,soilWork,wallWork,heat,kineticEnergy,springEnergy,mismatch,"
           "iterations\n";
    long iterations = 0;
    try
    {
        Coupling(*soil, wall, scheme).run(end, [&](const Row& row) {
            writeRow(out, row, wall);
            out.flush(); // others may look at it while it runs
            iterations += row.iterations;
        });
        soil->finish();
    }
    catch (const SoilLost& error)
    {
        throw StepError(fmt::format("at {:g} s: {}", wall.state().time, error.what()));
    }
    if (!out.flush())
        throw InputError(file + ": cannot be written");
    fmt::print("wallMaster: {:g} s, wall at {:.6f} m, {} iterations\n", wall.state().time, wall.state().position,
               iterations);
    return 0;
}
} // namespace

int main(int argc, char** argv)
{
    cases::ApplicationInfo info{"wallMaster", "a wall on a spring, integrated by CVODE, that soil pushes"};
    info.usesCase = false;
    info.usesThreads = true;
    info.options = {{"case", "DIR", "the soil is this case, seeded"},
                    {"socket", "PATH", "the soil is soilServer, at this Unix socket"},
                    {"fmu", "DIR", "the soil is an FMU, unpacked there (exportFMU)"},
                    {"coupling", "WORD", "implicit (default) or explicit"},
                    {"window", "SECONDS", "between exchanges (default 0.01)"},
                    {"end", "SECONDS", "of time (default 1)"},
                    {"tolerance", "METRES", "of implicit coupling (default 1e-10)"},
                    {"mass", "M", "of the wall [kg/m] (default 2e4)"},
                    {"damping", "C", "[N s/m/m] (default 0)"},
                    {"stiffness", "K", "of the spring [N/m/m] (default 5e5)"},
                    {"output", "FILE", "a row a window, .csv (default springWall.csv)"}};
    info.details =
        "Exit codes: 0 end is reached; 1 wrong input; 2 the soil cannot follow, is gone, or iterations do not "
        "converge.";
    return cases::runApplication(argc, argv, info, run);
}

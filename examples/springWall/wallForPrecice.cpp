// The wall on a spring as a participant of preCICE: what mpmCouple can be tried against.
//
//     wallForPrecice CONFIG MASS DAMPING STIFFNESS OUTPUT
//
// Participant Wall, mesh WallMesh (one vertex): reads Force, writes Displacement (and Rotation, 0). Steps of a whole
// window.
#include "reference/springWall.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <precice/precice.hpp>
#include <unistd.h>
#include <vector>

namespace
{
int couple(char** arguments)
{
    mpm::reference::SpringWall wall({std::atof(arguments[2]), std::atof(arguments[3]), std::atof(arguments[4])});
    std::ofstream out(arguments[5]);
    out << "time,x,v,force,iterations\n";
    precice::Participant participant("Wall", arguments[1], 0, 1);
    const std::vector<double> place = {0, 0};
    std::vector<int> ids(1);
    participant.setMeshVertices("WallMesh", place, ids);
    std::vector<double> displacement = {0, 0}, rotation = {0}, force = {0, 0};
    const auto write = [&] {
        displacement[0] = wall.state().position;
        participant.writeData("WallMesh", "Displacement", ids, displacement);
        participant.writeData("WallMesh", "Rotation", ids, rotation);
    };
    if (participant.requiresInitialData())
        write();
    participant.initialize();
    auto start = wall.save();
    int iterations = 0;
    while (participant.isCouplingOngoing())
    {
        if (participant.requiresWritingCheckpoint())
            start = wall.save();
        const double window = participant.getMaxTimeStepSize();
        participant.readData("WallMesh", "Force", ids, window, force);
        wall.advance(window, force[0], force[0]);
        write();
        participant.advance(window);
        ++iterations;
        if (participant.requiresReadingCheckpoint())
        {
            wall.restore(start);
            continue;
        }
        const auto& s = wall.state();
        out << fmt::format("{},{},{},{},{}\n", s.time, s.position, s.velocity, force[0], iterations) << std::flush;
        iterations = 0;
    }
    participant.finalize();
    return 0;
}
} // namespace

int main(int count, char** arguments)
{
    if (count != 6)
    {
        fmt::print(stderr, "wallForPrecice CONFIG MASS DAMPING STIFFNESS OUTPUT\n");
        return 1;
    }
    try
    {
        return couple(arguments);
    }
    catch (const std::exception& error)
    {
        fmt::print(stderr, "--> wallForPrecice: error: {}\n", error.what());
        _exit(2); // preCICE's destructor would wait for a partner that may be gone
    }
}

// The same coupled calculation without an FMU: a participant in a program of its own, values printed exactly (%a).
//
//     runWithoutFmu CASE [FILE WORD VALUE]... < windows
//
// A line a window: FROM LENGTH, then x, y and angle of the wall and the settlement of the lid at its end. Answers with
// a line a window: time, mean force (x, y) and torque on the wall, contact area, work of the wall, kinetic and strain
// energy, substeps; mean forces on the lid's vertices; displacements of the marker's.
#include "coupling/participant.hpp"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>

using mpm::coupling::FieldName;

namespace
{
double number(std::istringstream& words)
{
    std::string word;
    words >> word;
    return std::strtod(word.c_str(), nullptr);
}

std::vector<double> mean(const mpm::Participant& soil, const std::string& surface, FieldName field)
{
    std::vector<double> values(soil.valueCount(surface, field));
    soil.windowAverage(surface, field, values);
    return values;
}

std::vector<double> now(const mpm::Participant& soil, const std::string& surface, FieldName field)
{
    std::vector<double> values(soil.valueCount(surface, field));
    soil.readField(surface, field, values);
    return values;
}

void write(mpm::Participant& soil, std::istringstream& words, double at)
{
    const double x = number(words), y = number(words), angle = number(words), settlement = number(words);
    soil.writeField("wall", FieldName::RigidPose,
                    std::vector{x, y, 0.0, std::cos(angle / 2), 0.0, 0.0, std::sin(angle / 2)}, at);
    std::vector<double> displacement(soil.valueCount("lid", FieldName::Displacement), 0.0);
    for (std::size_t i = 1; i < displacement.size(); i += 3)
        displacement[i] = -settlement;
    soil.writeField("lid", FieldName::Displacement, displacement, at);
}
} // namespace

int main(int argc, char** argv)
{
    std::vector<mpm::coupling::Setting> settings;
    for (int i = 2; i + 2 < argc; i += 3)
        settings.push_back({argv[i], argv[i + 1], argv[i + 2]});
    mpm::Participant soil(argv[1], settings, 1);
    soil.initialize();
    std::string line;
    for (bool first = true; std::getline(std::cin, line); first = false)
    {
        std::istringstream words(line);
        const double from = number(words), length = number(words);
        if (first) // the state at the start
        {
            write(soil, words, 0);
            continue;
        }
        const double window = from + length - soil.time();
        write(soil, words, window);
        const auto done = soil.advance(window);
        if (done.status != mpm::coupling::Status::reached)
            return 2;
        const auto force = mean(soil, "wall", FieldName::Force), torque = mean(soil, "wall", FieldName::Torque);
        const auto balance = soil.balance();
        std::vector<double> row{soil.time(),
                                force[0],
                                force[1],
                                torque[2],
                                now(soil, "wall", FieldName::ContactArea)[0],
                                soil.interfaceWork("wall"),
                                balance.kineticEnergy,
                                balance.strainEnergy,
                                double(done.substeps)};
        for (const auto& more : {mean(soil, "lid", FieldName::Force), now(soil, "marker", FieldName::Displacement)})
            row.insert(row.end(), more.begin(), more.end());
        for (const double v : row)
            std::printf("%a ", v);
        std::printf("\n");
    }
}

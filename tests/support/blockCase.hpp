#pragma once
/// A whole seeded case of 32 particles in a folder, for tests of what drives one: an elastic block, 1 m wide and 0.5 m
/// high, that stands on a rough floor at y = 0 in a grid of 20 x 12 cells from (-2, -1) to (3, 2). A wave crosses it in
/// 14 ms; deltaT is 2 ms.
#include "output/stateFile.hpp"
#include "support/scenes.hpp"

#include <fstream>

namespace mpm::tests
{
inline void writeText(const std::filesystem::path& file, const std::string& text)
{
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

inline void writeBlockCase(const std::filesystem::path& folder, double E = 1e6)
{
    writeText(
        folder / "system/controlDict",
        "startFrom latestTime; startTime 0; stopAt endTime; endTime 1; deltaT 2e-3; adjustTimeStep no; maxCo 0.5;\n"
        "writeControl runTime; writeInterval 1; purgeWrite 0; timePrecision 6; historyInterval 1;\n");
    writeText(folder / "system/gridDict", "dimension 2; min (-2 -1 0); max (3 2 0); cellSize 0.25;\n");
    writeText(folder / "system/mpmSchemes", "shape uGIMP; stressUpdate MUSL; transfer FLIP; picRate 0;\n");
    writeText(folder / "constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);\n");
    writeText(folder / "constant/materialProperties",
              "solid { law linearElastic; density 1000; E " + std::to_string(E) + "; nu 0.3; }\n");
    writeText(folder / "constant/boundaryConditions",
              "floor { type friction; mu 0.5; plane { normal (0 -1 0); position 0; } }\n");
    scenes::Block block;
    block.n = {8, 4, 1};
    block.spacing = 0.125;
    block.h = 0.25;
    block.low = {-2, -1, 0};
    block.cells = {20, 12, 1};
    output::writeState(folder / "0", scenes::seedBlock(block));
}
} // namespace mpm::tests

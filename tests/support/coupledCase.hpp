#pragma once
/// A small case folder for a participant: a block of an elastic solid, 1 m x 0.5 m, 16 x 8 particles, cells of 1/8 m.
#include "output/stateFile.hpp"
#include "support/scenes.hpp"
#include "support/temporaryFolder.hpp"

#include <fstream>

namespace mpm::tests
{
struct CoupledCase
{
    std::string material = "law linearElastic; density 1000; E 1e6; nu 0.3;";
    std::string gravity = {};                                ///< "(0 -10 0)"; empty: no constant/g
    std::string boundaries = {}, control = {}, schemes = {}; ///< more entries; boundaries: the whole file
    Vector3 velocity{};
    int dim = 2; ///< in 3D the block is 0.5 m thick, from z = 0.5

    /// Writes it to a folder that is there.
    void write(const std::filesystem::path& folder) const
    {
        const auto put = [&](const std::string& name, const std::string& text) {
            std::filesystem::create_directories((folder / name).parent_path());
            std::ofstream(folder / name) << text;
        };
        put("constant/materialProperties", "solid { " + material + " }\n");
        if (!gravity.empty())
            put("constant/g", "value " + gravity + ";\n");
        if (!boundaries.empty())
            put("constant/boundaryConditions", boundaries);
        put("system/controlDict", "startFrom latestTime; endTime 1; deltaT 0.0009765625; writeControl runTime; "
                                  "writeInterval 0.03125; " +
                                      control + "\n");
        put("system/gridDict", dim == 2 ? "dimension 2; min (0 0 0); max (5 3 0); cellSize 0.125;\n"
                                        : "dimension 3; min (0 0 0); max (5 3 3); cellSize 0.125;\n");
        put("system/mpmSchemes", "shape uGIMP; " + schemes + "\n");
        output::writeState(folder / "0", scenes::seedBlock({.dim = dim,
                                                            .corner = {1, 0.5, dim == 3 ? 0.5 : 0},
                                                            .n = {16, 8, 8},
                                                            .spacing = 0.0625,
                                                            .h = 0.125,
                                                            .cells = {40, 24, dim == 3 ? 24 : 1},
                                                            .velocity = velocity}));
    }
};
} // namespace mpm::tests

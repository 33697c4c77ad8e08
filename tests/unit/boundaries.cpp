// Boundary dictionaries: planes of walls, and walls that would be ignored or hold what they should not.
#include "base/error.hpp"
#include "case/gridFromDict.hpp"
#include "case/readBoundaries.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using Catch::Contains;

namespace
{
/// 1 m x 1 m (x 1 m) of soil on the floor of a grid of 4 m x 2 m (x 2 m), cells of 0.5 m.
state::State soil(int dim = 2)
{
    return scenes::seedBlock({.dim = dim,
                              .corner = {1, 0, 0},
                              .n = {4, 4, 4},
                              .spacing = 0.25,
                              .h = 0.5,
                              .cells = {8, 4, dim == 3 ? 4 : 1}});
}

stepping::Scene read(const std::string& text, const state::State& state)
{
    stepping::Scene scene;
    cases::readBoundaries(dictionary::Dictionary::fromText(text, "boundaryConditions"), state, scene);
    return scene;
}

std::string wall(const std::string& name, const std::string& normal, const std::string& position)
{
    return name + " { type friction; mu 0.5; plane { normal (" + normal + "); position " + position + "; } }\n";
}
} // namespace

TEST_CASE("a wall is read with its plane, side and index")
{
    const auto scene = read(wall("base", "0 -1 0", "0") + wall("right", "2 0 0", "3.5"), soil());
    REQUIRE(scene.walls.size() == 2);
    CHECK(scene.walls[0].axis == 1);
    CHECK(scene.walls[0].side == -1);
    CHECK(scene.walls[0].plane == 0);
    CHECK(scene.walls[0].separation);
    CHECK(scene.walls[1].side == 1);
    CHECK(scene.walls[1].plane == 7);
}

TEST_CASE("walls on all six sides of a box")
{
    const auto scene = read(wall("a", "-1 0 0", "0.5") + wall("b", "1 0 0", "2") + wall("c", "0 -1 0", "0") +
                                wall("d", "0 1 0", "2") + wall("e", "0 0 -1", "0") + wall("f", "0 0 1", "1"),
                            soil(3));
    REQUIRE(scene.walls.size() == 6);
    CHECK(scene.walls[4].axis == 2);
    CHECK(scene.walls[5].plane == 2);
}

TEST_CASE("walls that cannot do what they say are refused by name")
{
    const auto state = soil();
    // a normal into the soil would hold all of it
    CHECK_THROWS_WITH(read(wall("base", "0 1 0", "0"), state), Contains("boundaryConditions:1") && Contains("base") &&
                                                                   Contains("behind the wall") &&
                                                                   Contains("out of the soil"));
    CHECK_NOTHROW(read(wall("base", "0 1 0", "1"), state));
    // out of reach
    CHECK_THROWS_WITH(read(wall("base", "0 -1 0", "-0.5"), state), Contains("outside the grid"));
    // between nodes
    CHECK_THROWS_WITH(read(wall("left", "-1 0 0", "0.75"), state), Contains("0.5 and 1"));
    // two on one plane: friction would act twice
    CHECK_THROWS_WITH(read(wall("left", "0 -1 0", "0") + wall("right", "0 -1 0", "0"), state),
                      Contains("boundaryConditions:2") && Contains("left") && Contains("right"));
    // askew
    CHECK_THROWS_WITH(read(wall("slope", "1 -1 0", "0"), state), Contains("normal"));
    // out of the plane in 2D
    CHECK_THROWS_AS(read(wall("front", "0 0 -1", "0"), state), InputError);
}

TEST_CASE("a grid of more nodes than sort keys can count is refused")
{
    const auto grid = [](const std::string& text) {
        return cases::gridFromDict(dictionary::Dictionary::fromText(text, "gridDict"));
    };
    CHECK(grid("dimension 3; min (0 0 0); max (1 1 1); cellSize 0.001;").cells[2] == 1000);
    CHECK_THROWS_WITH(grid("dimension 3;\nmin (0 0 0);\nmax (1 1 1);\ncellSize 1e-5;"),
                      Contains("gridDict:4") && Contains("cellSize") && Contains("nodes"));
}

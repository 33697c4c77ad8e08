#include "dictionary/dictionary.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::dictionary;

namespace
{
const char* const soilText = R"(FoamFile
{
    version     2.0;
    format      ascii;
    class       dictionary;
    object      materialProperties;
}
/* a comment
   over lines */
stiffness       20e6;           // used by a macro
soil
{
    law             mohrCoulomb;
    density         [1 -3 0 0 0 0 0] 1000;
    E               [1 -1 -2 0 0] $stiffness;
    nu              0.42;
    frictionAngle   42;
    active          on;
    steps           12;
    initialVelocity (0 -1.5e-3 .5);
    title           "a \"soft\" soil";
    layers          (0 2 4.5);
    names           (soil "other soil" div(phi,U));
    points          2((0 0 0) (1 0 0));
    initialStress
    {
        type        K0;
        K0          $..nu;
        again       $..E;
    }
}
clay
{
    $soil;
    E               5e6;
    initialStress
    {
        K0          0.8;
    }
}
copy    $clay;
)";
}

TEST_CASE("values of every type are read as they stand")
{
    const Dictionary dict = Dictionary::fromText(soilText, "materialProperties");
    CHECK(dict.dictNames() == std::vector<std::string>{"soil", "clay", "copy"});
    CHECK(dict.words() == std::vector<std::string>{"stiffness"});
    const Dictionary& soil = dict.subDict("soil");
    CHECK(soil.where().text() == "materialProperties:11");
    CHECK(soil.where("nu").text() == "materialProperties:16");
    CHECK(soil.choose("law", "", {{"linearElastic", ""}, {"mohrCoulomb", ""}}) == "mohrCoulomb");
    CHECK(soil.get<double>({"density", "", unit::density, Bound::positive()}) == 1000);
    CHECK(soil.get<double>({"E", "", unit::pressure}) == 20e6);
    CHECK(soil.get<double>({"nu", "", unit::none, Bound::rightOpen(0, 0.5)}) == 0.42);
    CHECK(soil.get<double>({"cohesion", "", unit::pressure, {}, 7.0}) == 7.0);
    CHECK(soil.get<bool>({"active", ""}));
    CHECK(soil.get<Index>({"steps", ""}) == 12);
    CHECK(soil.get<Vector3>({"initialVelocity", "", unit::velocity}) == Vector3{0, -1.5e-3, 0.5});
    CHECK(soil.get<std::string>({"title", ""}) == "a \"soft\" soil");
    CHECK(soil.get<std::vector<double>>({"layers", ""}) == std::vector<double>{0, 2, 4.5});
    CHECK(soil.get<std::vector<std::string>>({"names", ""}) ==
          std::vector<std::string>{"soil", "other soil", "div(phi,U)"});
    CHECK(soil.get<std::vector<Vector3>>({"points", ""}) == std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}});
    CHECK(soil.get<double>({"frictionAngle", ""}) == 42);
    const Dictionary& stress = soil.subDict("initialStress");
    CHECK(stress.get<double>({"K0", ""}) == 0.42);
    CHECK(stress.get<double>({"again", "", unit::pressure}) == 20e6);
    CHECK(stress.get<std::string>({"type", ""}) == "K0");
    soil.rejectUnread();

    const Dictionary& clay = dict.subDict("clay");
    CHECK(clay.get<double>({"E", "", unit::pressure}) == 5e6);
    CHECK(clay.get<double>({"nu", ""}) == 0.42);
    CHECK(clay.subDict("initialStress").get<double>({"K0", ""}) == 0.8);
    CHECK(clay.subDict("initialStress").get<double>({"again", "", unit::pressure}) == 20e6);
    CHECK(dict.subDict("copy").get<double>({"E", "", unit::pressure}) == 5e6);
    CHECK_THROWS_WITH(dict.rejectUnread(), Catch::Contains("materialProperties:13: clay.law: found an unknown word"));
}

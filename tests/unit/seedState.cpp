// From seeds to a state: initial stress, patches, materials, and the dictionaries that ask for them.
#include "seeding/seedState.hpp"
#include "base/error.hpp"
#include "case/gridFromDict.hpp"
#include "geometry/region3D.hpp"
#include "seeding/seedReport.hpp"
#include "seeding/surfacePatches.hpp"
#include "support/shapes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::seeding;
using namespace mpm::test;
using Catch::Matchers::Contains;
using geometry::Region3D;

namespace
{
geometry::BodyGeometry bodyOf(std::vector<std::unique_ptr<geometry::Region>> regions)
{
    geometry::BodyGeometry body;
    body.dim = regions[0]->dim();
    body.file = "body.geo";
    body.regions = std::move(regions);
    return body;
}

SeedMaterial materialOf(const std::string& name, double density)
{
    SeedMaterial m;
    m.name = name;
    m.density = density;
    return m;
}
} // namespace

TEST_CASE("initial stress of a layer at rest")
{
    const auto dict = dictionary::Dictionary::fromText(
        "soil { initialStress { type K0; } } deep { initialStress { type K0; K0 0.5; "
        "surfaceLevel 10; } } still { initialStress { type uniform; value (1 2 3 4 0 0); } }"
        " wrong { initialStress { type uniform; value (1 2 3 4 5 0); } } bare {}",
        "materialProperties");
    const Vector3 g{0, -9.8, 0};
    const auto soil = readInitialStress(dict.subDict("soil"), 0.42, g, 2);
    const auto stress = soil.at({1, 3, 0}, 1000, 8);
    CHECK(stress[1] == Approx(-1000 * 9.8 * 5));
    CHECK(stress[0] == Approx(0.42 / 0.58 * stress[1]));
    CHECK(stress[2] == stress[0]);
    CHECK(stress[3] == 0);
    const auto deep = readInitialStress(dict.subDict("deep"), 0.42, {9.8, 0, 0}, 2); // down is +x
    CHECK(deep.at({14, 0, 0}, 1000, 0)[0] == Approx(-1000 * 9.8 * 4));
    CHECK(deep.at({14, 0, 0}, 1000, 0)[1] == Approx(-500 * 9.8 * 4));
    CHECK(deep.above({9, 0, 0}, 0));
    CHECK_FALSE(deep.above({11, 0, 0}, 0));
    CHECK(readInitialStress(dict.subDict("still"), 0.3, {}, 2).at({}, 1, 1) == std::array<double, 6>{1, 2, 3, 4, 0, 0});
    CHECK(readInitialStress(dict.subDict("bare"), 0.3, {}, 2).at({}, 1, 1) == std::array<double, 6>{});
    for (const Vector3& bad : {Vector3{0, 0, 0}, Vector3{1, -9, 0}, Vector3{0, 0, -9.8}})
        CHECK_THROWS_WITH(readInitialStress(dict.subDict("soil"), 0.42, bad, 2),
                          Contains("materialProperties:1") && Contains("gravity"));
    CHECK(readInitialStress(dict.subDict("soil"), 0.42, {0, 0, -9.8}, 3).gravity.axis == 2);
    CHECK_THROWS_WITH(readInitialStress(dict.subDict("wrong"), 0.3, {}, 2), Contains("yz 5"));
}

TEST_CASE("patches keep the boundary's length, area and orientation in pieces no longer than asked")
{
    geometry::Boundary side{"side", {{{1, 0, 0}, {{{0, 2, 0}, {}}}}}};
    const auto patch = makePatch(side, 2, 0.3);
    REQUIRE(patch.size() == 7);
    double length = 0;
    for (std::size_t i = 0; i < 7; ++i)
        length += patch.edges[1][i];
    CHECK(length == Approx(2).epsilon(1e-14));
    CHECK(patch.centre[1][0] == Approx(1.0 / 7));
    CHECK(makePatch(side, 2, 0.5).size() == 4);

    geometry::Boundary face{"face", {{{0, 0, 1}, {{{3, 0, 0}, {0, 1, 0}}}}}};
    const auto triangles = makePatch(face, 3, 0.5);
    double area = 0, moment = 0;
    for (std::size_t i = 0; i < std::size_t(triangles.size()); ++i)
    {
        const double ux = triangles.edges[0][i], uy = triangles.edges[1][i], vx = triangles.edges[3][i],
                     vy = triangles.edges[4][i];
        const double normal = (ux * vy - uy * vx) / 2;
        CHECK(normal > 0);
        CHECK(std::max({std::hypot(ux, uy), std::hypot(vx, vy), std::hypot(ux - vx, uy - vy)}) <= 0.5 * (1 + 1e-9));
        CHECK(triangles.centre[2][i] == 1);
        area += normal;
        moment += normal * triangles.centre[0][i];
    }
    CHECK(area == Approx(1.5).epsilon(1e-13));
    CHECK(moment / area == Approx(1).epsilon(1e-13));
}

TEST_CASE("a state: order, ids, masses, two materials, patches")
{
    const auto file = writeText("layers.geo", R"(
        Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 1.5, 0}; Point(4) = {0, 1.5, 0};
        Point(5) = {4, 3, 0}; Point(6) = {0, 3, 0};
        Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
        Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
        Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
        Physical Surface("rock") = {1}; Physical Surface("top soil") = {2}; Physical Curve("base") = {1};
    )");
    const auto body = geometry::readGeometry(file, 2);
    auto soil = materialOf("sand", 1000);
    soil.velocity = {0.5, -1, 0};
    soil.initialStress.type = InitialStress::Type::K0;
    soil.initialStress.K0 = 0.5;
    soil.initialStress.gravity = {1, -1, 10};
    const std::vector<SeedMaterial> materials = {materialOf("spare", 1), soil, materialOf("rock", 2500)};
    SeedOptions options;
    options.materialOf["top soil"] = "sand";
    const auto grid = gridBox(2, {-1, 0, 0}, 0.5, {12, 8, 1});
    const Seeding made = seedState(body, grid, materials, options);
    const auto& p = made.state.particles;
    REQUIRE(p.size() == 16 * 12);
    CHECK(made.state.materials == std::vector<std::string>{"rock", "sand"});
    CHECK(made.regions[0].mass == Approx(6 * 2500).epsilon(1e-14));
    CHECK(made.regions[1].mass == Approx(6 * 1000).epsilon(1e-14));
    CHECK(made.state.nextId == p.size());
    CHECK(made.state.seedSpacing == Vector3{0.25, 0.25, 0});
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        REQUIRE(p.id[i] == std::int64_t(i));
        REQUIRE(p.material[i] == (i < 96 ? 0 : 1));
        REQUIRE(p.x[1][i] == Approx(0.125 + 0.25 * double(i / 16)));
        REQUIRE((p.F[0][i] == 1 && p.F[1][i] == 0 && p.F[3][i] == 1));
        REQUIRE(p.volume[i] == p.volume0[i]);
        REQUIRE(p.stress[1][i] == Approx(i < 96 ? 0 : -1e4 * (3 - p.x[1][i])));
        REQUIRE(p.v[0][i] == (i < 96 ? 0 : 0.5));
    }
    CHECK(p.mass.size() % lanes == 0);
    REQUIRE(made.state.patches.size() == 1);
    CHECK(made.state.patches[0].size() == 16);
    CHECK(made.state.patches[0].edges[0][0] == 0.25); // outward normal (0, -0.25)

    options.materialOf.clear();
    CHECK_THROWS_WITH(seedState(body, grid, materials, options),
                      Contains("'top soil'") && Contains("spare, sand or rock"));
    options.materialOf = {{"rock", "rook"}};
    CHECK_THROWS_WITH(seedState(body, grid, materials, options), Contains("'rook'") && Contains("did you mean rock"));
    options.materialOf = {{"topsoil", "sand"}, {"top soil", "sand"}};
    CHECK_THROWS_WITH(seedState(body, grid, materials, options),
                      Contains("'topsoil'") && Contains("did you mean top soil"));
    options.materialOf = {{"top soil", "sand"}};
    auto low = materials;
    low[1].initialStress.surfaceLevel = 2.9;
    CHECK_NOTHROW(seedState(body, grid, low, options));
    low[1].initialStress.surfaceLevel = 2.8;
    CHECK_THROWS_WITH(seedState(body, grid, low, options), Contains("surfaceLevel 2.8"));
}

TEST_CASE("3D regions that overlap are refused by name")
{
    const auto region = [](const std::string& name, const Surface3& s) {
        return std::make_unique<Region3D>(name, s.points, s.triangles);
    };
    const auto grid = gridBox(3, {0, 0, 0}, 0.5, {8, 8, 8});
    const std::vector<SeedMaterial> materials = {materialOf("a", 1), materialOf("b", 1)};
    std::vector<std::unique_ptr<geometry::Region>> regions;
    regions.push_back(region("a", boxSurface({0, 0, 0}, {1.1, 2, 2})));
    regions.push_back(region("b", boxSurface({1.1, 0, 0}, {3, 2, 2})));
    CHECK(seedState(bodyOf(std::move(regions)), grid, materials, {}).regions.size() == 2);
    regions.clear();
    regions.push_back(region("a", boxSurface({0, 0, 0}, {1.1, 2, 2})));
    regions.push_back(region("b", boxSurface({1.05, 0, 0}, {3, 2, 2})));
    CHECK_THROWS_WITH(seedState(bodyOf(std::move(regions)), grid, materials, {}), Contains("'a' and 'b' overlap"));
}

TEST_CASE("the dictionary of seedParticles")
{
    const auto dict = dictionary::Dictionary::fromText(
        "geometry \"geometry/a.geo\"; particlesPerCell 3; arrangement jittered; jitter 0.1; "
        "regions { soil { material sand; } rock {} }",
        "seedParticlesDict");
    const SeedOptions options = readSeedOptions(dict);
    dict.rejectUnread();
    CHECK(options.geometry == "geometry/a.geo");
    CHECK(options.lattice.perCell == 3);
    CHECK(options.lattice.jittered);
    CHECK(options.lattice.jitter == 0.1);
    CHECK(options.materialOf == std::map<std::string, std::string>{{"rock", "rock"}, {"soil", "sand"}});
    const auto fails = [](const std::string& text, const std::string& what) {
        const auto bad = dictionary::Dictionary::fromText(text, "seedParticlesDict");
        CHECK_THROWS_WITH(readSeedOptions(bad), Contains("seedParticlesDict:1") && Contains(what));
    };
    fails("particlesPerCell 0;", "particlesPerCell");
    fails("arrangement jittred;", "jittered");
    fails("arrangement jittered; jitter 0.5;", "jitter");
    fails("jitter 0.2;", "arrangement jittered");
}

TEST_CASE("the grid's dictionary")
{
    const auto grid = [](const std::string& text) {
        return cases::gridFromDict(dictionary::Dictionary::fromText(text, "gridDict"));
    };
    const auto column = grid("dimension 2; min (-12 0 0); max (16 12 0); cellSize 0.2666666666666667;");
    CHECK(column.cells == std::array<Index, 3>{105, 45, 1});
    CHECK(column.h == 28.0 / 105);
    CHECK(column.upper(0) == 16);
    const auto rounded = grid("dimension 3; min (0 0 0); max (1 2 3); cellSize 0.3333333;");
    CHECK(rounded.cells == std::array<Index, 3>{3, 6, 9});
    CHECK(rounded.h == 1.0 / 3);
    CHECK_THROWS_WITH(grid("dimension 2; min (0 0 0); max (16.1 12 0); cellSize 0.5;"),
                      Contains("gridDict:1") && Contains("(16 12 0)"));
    CHECK_THROWS_WITH(grid("dimension 4; min (0 0 0); max (1 1 1); cellSize 0.5;"), Contains("dimension"));
    CHECK_THROWS_WITH(grid("dimension 2; min (0 0 0); max (1 -1 0); cellSize 0.5;"), Contains("y > 0"));
    CHECK_THROWS_WITH(grid("dimension 2; min (0 0 0); max (1 1 2); cellSize 0.5;"), Contains("z = 0 in 2D"));
    CHECK_THROWS_WITH(grid("dimension 2; min (0 0 0); max (1 1 0); cellSize 0;"), Contains("cellSize"));
}

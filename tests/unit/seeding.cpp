// From regions to particles: exact volumes, initial stress, patches, and what is refused.
#include "base/error.hpp"
#include "case/gridFromDict.hpp"
#include "geometry/region2D.hpp"
#include "geometry/region3D.hpp"
#include "seeding/seedLattice.hpp"
#include "seeding/seedState.hpp"
#include "seeding/surfacePatches.hpp"
#include "support/shapes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <numeric>
#include <random>

using namespace mpm;
using namespace mpm::seeding;
using namespace mpm::test;
using Catch::Matchers::Contains;
using geometry::Region2D;
using geometry::Region3D;

namespace
{
state::GridBox gridBox(int dim, const Vector3& origin, double h, std::array<Index, 3> cells)
{
    state::GridBox grid;
    grid.dim = dim;
    grid.origin = origin;
    grid.h = h;
    grid.cells = cells;
    return grid;
}

std::vector<Seed> seedsOf(const geometry::Region& region, const state::GridBox& grid, const LatticeOptions& options)
{
    BoxLattice lattice(grid, options);
    lattice.fit(region);
    return seedRegion(region, lattice).seeds;
}

/// Relative errors of volume and first moments of all seeds.
struct Errors
{
    double volume, moment;
};
Errors errorsOf(const std::vector<Seed>& seeds, const geometry::Region& region)
{
    long double volume = 0, moment[3] = {0, 0, 0};
    for (const Seed& s : seeds)
    {
        volume += s.volume;
        for (std::size_t k = 0; k < 3; ++k)
            moment[k] += s.volume * (s.centre[k] - (long double)(region.centroid()[k]));
    }
    double size = 0, largest = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
        size = std::max(size, region.upper()[k] - region.lower()[k]);
        largest = std::max(largest, std::abs(double(moment[k])));
    }
    return {std::abs(double(volume) / region.volume() - 1), largest / (region.volume() * size)};
}

/// A star with its rays around `centre`, lengths between inner and outer.
Region2D::Loop star(std::mt19937& random, const Vector3& centre, double inner, double outer, int rays)
{
    std::uniform_real_distribution<double> length(inner, outer), turn(-0.3, 0.3);
    Region2D::Loop loop;
    for (int i = 0; i < rays; ++i)
    {
        const double angle = 2 * M_PI * (i + turn(random)) / rays, r = length(random);
        loop.push_back({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle), 0});
    }
    return loop;
}

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

TEST_CASE("the soil column: 1800 equal particles at the centres of their boxes")
{
    const Region2D column("soil", {{{0, 0}, {4, 0}, {4, 8}, {0, 8}}});
    for (const auto& [h, n] : {std::pair(4.0 / 15, 2), std::pair(0.4, 3)})
    {
        const auto grid = gridBox(2, {-12, 0, 0}, h, {Index(std::lround(28 / h)), Index(std::lround(12 / h)), 1});
        const auto seeds = seedsOf(column, grid, {n});
        REQUIRE(seeds.size() == 1800);
        const double side = 4.0 / 30;
        for (std::size_t i = 0; i < seeds.size(); ++i)
        {
            REQUIRE(seeds[i].volume == seeds[0].volume); // bitwise
            REQUIRE(std::abs(seeds[i].centre[0] - side * (double(i % 30) + 0.5)) < 1e-14);
            REQUIRE(std::abs(seeds[i].centre[1] - side * (double(i / 30) + 0.5)) < 1e-14);
            REQUIRE(seeds[i].length[0] == Approx(side).epsilon(1e-14));
        }
        CHECK(errorsOf(seeds, column).volume < 1e-13);
    }
}

TEST_CASE("any polygon, with holes and islands, keeps area and centroid to round-off")
{
    std::mt19937 random(7);
    for (int trial = 0; trial < 12; ++trial)
    {
        // A large star with two star holes and an island in the first one.
        const Vector3 c{0.13 * trial, -0.07 * trial, 0};
        const Region2D region("star", {star(random, c, 3, 5, 9 + trial),
                                       star(random, {c[0] - 1.2, c[1], 0}, 0.5, 1.1, 5 + trial),
                                       star(random, {c[0] + 1.2, c[1], 0}, 0.3, 1, 3 + trial % 3),
                                       star(random, {c[0] - 1.2, c[1], 0}, 0.1, 0.3, 7)});
        const auto grid = gridBox(2, {-9, -9, 0}, 0.5, {40, 36, 1});
        for (const bool jittered : {false, true})
        {
            LatticeOptions options{Index(1 + trial % 3), jittered, 0.4, 3};
            BoxLattice lattice(grid, options);
            lattice.fit(region);
            const RegionSeeds seeded = seedRegion(region, lattice);
            const Errors errors = errorsOf(seeded.seeds, region);
            CHECK(errors.volume < 1e-12);
            CHECK(errors.moment < 1e-12);
            const double side = lattice.spacing();
            Index outside = 0, slivers = 0;
            for (const Seed& s : seeded.seeds)
            {
                REQUIRE(s.length[0] * s.length[1] == Approx(s.volume).epsilon(1e-13));
                outside += !region.contains(s.centre);
                slivers += s.volume < 0.05 * side * side;
            }
            // A centroid leaves the region only where a reflex corner notches its box.
            CHECK(outside <= Index(region.vertices().size()) / 4);
            CHECK(slivers <= 6); // islands and tips alone in their box
            CHECK(seeded.merged > 0);
        }
    }
}

TEST_CASE("seeds of convex regions are inside")
{
    const Region2D polygon("hexagon", {{{0.1, 0}, {3, -0.7}, {5.3, 1}, {5, 3.9}, {2, 4.6}, {-0.3, 2}}});
    for (const bool jittered : {false, true})
        for (const Seed& s : seedsOf(polygon, gridBox(2, {-1, -1, 0}, 0.37, {20, 20, 1}), {3, jittered, 0.3, 11}))
            REQUIRE(polygon.contains(s.centre));
}

TEST_CASE("jittered boxes tile, are deterministic and follow the seed of the generator")
{
    const Region2D plate("plate", {{{0, 0}, {4, 0}, {4, 3}, {0, 3}}});
    const auto grid = gridBox(2, {0, 0, 0}, 0.5, {8, 6, 1});
    const auto first = seedsOf(plate, grid, {2, true, 0.3, 1});
    CHECK(first.size() == 16 * 12);
    CHECK(errorsOf(first, plate).volume < 1e-13);
    const auto [least, most] =
        std::minmax_element(first.begin(), first.end(), [](auto& a, auto& b) { return a.volume < b.volume; });
    CHECK(most->volume / least->volume > 2);
    CHECK(least->volume >= 0.4 * 0.4 / 16);
    const auto again = seedsOf(plate, grid, {2, true, 0.3, 1});
    const auto other = seedsOf(plate, grid, {2, true, 0.3, 2});
    CHECK(std::equal(first.begin(), first.end(), again.begin(), [](auto& a, auto& b) { return a.centre == b.centre; }));
    CHECK_FALSE(
        std::equal(first.begin(), first.end(), other.begin(), [](auto& a, auto& b) { return a.centre == b.centre; }));
    // The same numbers on every platform; this one was worked out apart, in Python's integers.
    CHECK(first[0].centre[0] == Approx(0.10413058379329374).epsilon(1e-15));
}

TEST_CASE("slivers go to the neighbour they touch, thin bodies stay")
{
    const auto grid = gridBox(2, {0, 0, 0}, 1, {8, 8, 1});
    const Region2D wide("wide", {{{1, 1}, {3.05, 1}, {3.05, 3}, {1, 3}}});
    const auto seeds = seedsOf(wide, grid, {1});
    REQUIRE(seeds.size() == 4);
    CHECK(seeds[1].volume == Approx(1.05).epsilon(1e-14));
    CHECK(seeds[1].length[0] == Approx(1.05).epsilon(1e-14));
    CHECK(seeds[1].length[1] == Approx(1).epsilon(1e-14));
    CHECK(seeds[1].centre[0] == Approx(2.525).epsilon(1e-14));
    CHECK(errorsOf(seeds, wide).moment < 1e-14);

    // A plate thinner than a tenth of a box has no neighbours to go to.
    const Region2D plate("plate", {{{1, 1}, {5, 1}, {5, 1.04}, {1, 1.04}}});
    const auto thin = seedsOf(plate, grid, {1});
    REQUIRE(thin.size() == 4);
    CHECK(thin[0].length[0] == Approx(1));
    CHECK(thin[0].length[1] == Approx(0.04));

    // Two bodies with a slit of 0.01 between them: the sliver right of the plane goes right although it is nearer to
    // the left.
    const Region2D slit("slit", {{{1, 1}, {2.94, 1}, {2.94, 2}, {1, 2}}, {{2.95, 1}, {5, 1}, {5, 2}, {2.95, 2}}});
    const auto parts = seedsOf(slit, grid, {1});
    CHECK(errorsOf(parts, slit).volume < 1e-14);
    const Region2D one("one", {{{0.2, 0.2}, {0.4, 0.2}, {0.4, 0.4}, {0.2, 0.4}}});
    CHECK(seedsOf(one, grid, {1}).size() == 1);
}

TEST_CASE("3D surfaces keep volume and centroid: sphere, tetrahedron, cube, turned box")
{
    const auto grid = gridBox(3, {-2, -2, -2}, 0.5, {8, 8, 8});
    const auto check = [&](const Surface3& surface, bool jittered) {
        const Region3D region("body", surface.points, surface.triangles);
        CHECK(region.volume() == Approx(std::abs(volumeOf(surface))).epsilon(1e-13));
        const auto seeds = seedsOf(region, grid, {2, jittered, 0.3, 5});
        const Errors errors = errorsOf(seeds, region);
        CHECK(errors.volume < 1e-11);
        CHECK(errors.moment < 1e-11);
        for (const Seed& s : seeds)
            REQUIRE(region.contains(s.centre)); // all are convex
        return seeds.size();
    };
    for (const bool jittered : {false, true})
    {
        check(sphereSurface({0.1, 0.03, -0.2}, 1.3, 4), jittered);
        check(tetrahedron({-1, -1, -1}, {1.5, -0.9, -1.2}, {0, 1.7, -0.8}, {0.2, 0.1, 1.9}), jittered);
        check(boxSurface({-0.93, -0.41, 0.13}, {1.21, 0.77, 1.6}), jittered);
        Surface3 turned = boxSurface({-1, -0.6, -0.4}, {1, 0.6, 0.4});
        for (Vector3& p : turned.points)
        {
            const double a = 0.5, b = 0.7;
            const Vector3 q{std::cos(a) * p[0] - std::sin(a) * p[1], std::sin(a) * p[0] + std::cos(a) * p[1], p[2]};
            p = {q[0], std::cos(b) * q[1] - std::sin(b) * q[2], std::sin(b) * q[1] + std::cos(b) * q[2]};
        }
        check(turned, jittered);
    }
    CHECK(check(boxSurface({-1, -1, -1}, {1, 1, 1}), false) == 512);
}

TEST_CASE("what leaves the grid is refused with its name, place and the box it needs")
{
    const Region2D column("soil", {{{0, 0}, {4, 0}, {4, 8.1}, {0, 8}}});
    BoxLattice lattice(gridBox(2, {-2, 0, 0}, 0.5, {16, 16, 1}), {});
    REQUIRE_THROWS_WITH(lattice.fit(column), Contains("'soil'") && Contains("(4 8.1)") && Contains("max (6 8.5 0)"));
    const Surface3 cube = boxSurface({0, 0, -0.5}, {1, 1, 1});
    const Region3D body("block", cube.points, cube.triangles);
    BoxLattice lattice3(gridBox(3, {0, 0, 0}, 1, {2, 2, 2}), {});
    REQUIRE_THROWS_WITH(lattice3.fit(body), Contains("'block'") && Contains("(0 0 -0.5)") && Contains("min (0 0 -1)"));
}

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
        Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 1.5, 0}; Point(4) = {0, 1.5, 0}; Point(5) = {4, 3, 0}; Point(6) = {0, 3, 0};
        Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
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

TEST_CASE("seeding takes linear time", "[.][speed]")
{
    const Region2D plate("plate", {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}});
    const Surface3 sphere = sphereSurface({5, 5, 5}, 4, 6);
    const Region3D ball("ball", sphere.points, sphere.triangles);
    const auto time = [](const char* what, auto&& work) {
        const auto start = std::chrono::steady_clock::now();
        const std::size_t seeds = work();
        WARN(what << ": " << seeds << " seeds in "
                  << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << " s");
    };
    time("2D lattice", [&] { return seedsOf(plate, gridBox(2, {0, 0, 0}, 0.02, {500, 500, 1}), {2}).size(); });
    time("2D jittered", [&] { return seedsOf(plate, gridBox(2, {0, 0, 0}, 0.02, {500, 500, 1}), {2, true}).size(); });
    time("3D ball", [&] { return seedsOf(ball, gridBox(3, {0, 0, 0}, 0.2, {50, 50, 50}), {2}).size(); });
}

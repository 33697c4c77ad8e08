// Lattice boxes cut by regions: exact volumes and centroids, slivers, jitter, and what is refused.
#include "base/error.hpp"
#include "geometry/region2D.hpp"
#include "geometry/region3D.hpp"
#include "seeding/seedLattice.hpp"
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

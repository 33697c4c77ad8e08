// The normal between two clouds: flat rows, edges, corners, mixed clouds, against closed forms and brute force.
#include "nodal/hullDistance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace mpm;
using nodal::separatingNormal;

namespace
{
using Cloud = std::vector<Vector3>;

/// Width of the strip between two clouds along n.
double strip(const Cloud& a, const Cloud& b, const Vector3& n)
{
    double most = -1e300, least = 1e300;
    for (const auto& x : a)
        most = std::max(most, x[0] * n[0] + x[1] * n[1] + x[2] * n[2]);
    for (const auto& x : b)
        least = std::min(least, x[0] * n[0] + x[1] * n[1] + x[2] * n[2]);
    return least - most;
}
} // namespace

TEST_CASE("flat rows have their normal, wherever one of them ends")
{
    Cloud below, above;
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 3; ++j)
            below.push_back({0.1 * i, -0.1 * j, 0});
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 2; ++j)
            above.push_back({0.33 + 0.1 * i, 0.1 + 0.1 * j, 0});
    const auto n = separatingNormal(below, above, 1e-9);
    REQUIRE(n);
    CHECK(std::abs((*n)[0]) < 1e-14);
    CHECK((*n)[1] == Approx(1));
    const auto back = separatingNormal(above, below, 1e-9);
    REQUIRE(back);
    CHECK((*back)[1] == Approx(-1));
}

TEST_CASE("corners point at each other, and clouds that are mixed have no normal")
{
    const Cloud one{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}, other{{1, 2, 0}, {2, 2, 0}, {1, 3, 0}};
    const auto n = separatingNormal(one, other, 1e-9);
    REQUIRE(n);
    CHECK((*n)[0] == Approx(1 / std::sqrt(5.0)));
    CHECK((*n)[1] == Approx(2 / std::sqrt(5.0)));
    CHECK(!separatingNormal(one, {{-0.3, -0.3, 0}, {1, 2, 0}}, 1e-9));
    CHECK(!separatingNormal(one, {}, 1e-9));
    CHECK(!separatingNormal(one, one, 1e-9));
}

TEST_CASE("no other plane leaves a wider strip")
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (const int dim : {2, 3})
        for (int trial = 0; trial < 60; ++trial)
        {
            Cloud a, b;
            for (int i = 0; i < 20; ++i)
            {
                a.push_back({number(random), number(random), dim == 3 ? number(random) : 0});
                b.push_back({number(random) + 1.9, number(random) + 0.8, dim == 3 ? number(random) + 0.4 : 0});
            }
            const auto n = separatingNormal(a, b, 1e-9);
            double best = -1e300;
            for (int k = 0; k < 4000; ++k)
            {
                Vector3 other{number(random), number(random), dim == 3 ? number(random) : 0};
                const double length = std::sqrt(other[0] * other[0] + other[1] * other[1] + other[2] * other[2]);
                for (double& component : other)
                    component /= length;
                best = std::max(best, strip(a, b, other));
            }
            if (!n)
            {
                CHECK(best <= 1e-6);
                continue;
            }
            CHECK(strip(a, b, *n) >= best - 1e-12);
            CHECK(strip(a, b, *n) > 0);
        }
}

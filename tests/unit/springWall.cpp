// The wall on a spring against the closed form of the oscillator; its books; its repeated windows.
#include "reference/springWall.hpp"

#include "base/error.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace mpm;
using Catch::Contains;
using reference::SpringWall;

namespace
{
// x(t), v(t) of m x'' + c x' + k x = a + b t from x0, v0 (underdamped): particular solution plus a decaying
// oscillation.
struct Oscillator
{
    double m, c, k, a, b, x0, v0;
    std::pair<double, double> operator()(double t) const
    {
        const double d = c / (2 * m), w = std::sqrt(k / m - d * d);
        const double offset = a / k - b * c / (k * k), slope = b / k;
        const double A = x0 - offset, B = (v0 - slope + d * A) / w;
        const double decay = std::exp(-d * t), s = std::sin(w * t), r = std::cos(w * t);
        return {offset + slope * t + decay * (A * r + B * s),
                slope + decay * ((B * w - d * A) * r - (A * w + d * B) * s)};
    }
};
} // namespace

TEST_CASE("closed form of the driven, damped oscillator, window by window")
{
    const Oscillator exact{2, 0.8, 50, 3, 1.5, 0.1, -0.4};
    SpringWall wall({2, 0.8, 50}, {0, 0.1, -0.4});
    const double window = 0.07;
    for (int k = 0; k < 60; ++k)
    {
        wall.advance(window, 3 + 1.5 * k * window, 3 + 1.5 * (k + 1) * window);
        const auto [x, v] = exact((k + 1) * window);
        REQUIRE(std::abs(wall.state().position - x) < 1e-9);
        REQUIRE(std::abs(wall.state().velocity - v) < 1e-8);
    }
    CHECK(wall.state().time == Approx(4.2));
}

TEST_CASE("energies of the wall account for the work of the force and the heat of the damper")
{
    SpringWall wall({500, 200, 4e5}, {0, 0.01, 0.3});
    const double before = wall.kineticEnergy() + wall.springEnergy();
    for (int k = 0; k < 50; ++k)
        wall.advance(0.02, 1e3 * k, 1e3 * (k + 1));
    const auto& s = wall.state();
    CHECK(s.heat > 0);
    const double now = wall.kineticEnergy() + wall.springEnergy() + s.heat;
    CHECK(std::abs(now - before - s.work) < 1e-8 * std::abs(s.work));
}

TEST_CASE("a light wall on a hard spring swings hundreds of times a window and stays on the closed form")
{
    const Oscillator exact{1e-3, 0, 4e5, 10, 0, 0, 0};
    SpringWall wall({1e-3, 0, 4e5});
    wall.advance(0.1, 10, 10); // 318 periods
    const auto [x, v] = exact(0.1);
    CHECK(std::abs(wall.state().position - x) < 1e-4 * 10 / 4e5);
    CHECK(wall.springEnergy() + wall.kineticEnergy() == Approx(wall.state().work));
}

TEST_CASE("a repeated window is bitwise the same, whatever was tried before")
{
    SpringWall wall({10, 1, 300}, {0, 0.2, 0});
    wall.advance(0.1, 5, 7);
    const auto start = wall.save();
    wall.advance(0.1, 7, 9);
    const auto first = wall.state();
    wall.restore(start);
    wall.advance(0.03, 1e4, -1e5);
    wall.restore(start);
    wall.advance(0.1, 7, 9);
    CHECK(wall.state().position == first.position);
    CHECK(wall.state().velocity == first.velocity);
    CHECK(wall.state().work == first.work);
    CHECK(wall.state().heat == first.heat);
}

TEST_CASE("what no wall can be is refused")
{
    CHECK_THROWS_WITH(SpringWall({0, 0, 1}), Contains("mass of 0") && Contains("> 0"));
    CHECK_THROWS_AS(SpringWall({1, -1, 1}), InputError);
    CHECK_THROWS_AS(SpringWall({1, 0, NAN}), InputError);
    SpringWall wall({1, 0, 1});
    CHECK_THROWS_AS(wall.advance(0, 1, 1), InputError);
}

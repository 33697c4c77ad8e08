#include "base/error.hpp"
#include "smoothing/stressQuality.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace mpm;
using namespace mpm::smoothing;

namespace
{
constexpr double rho = 1000, g = 9.8;

/// A level block of nx x ny lattice particles, two a cell and axis, lower left corner at the origin, grid around it.
state::State block(Index nx, Index ny, double h)
{
    state::State state(2);
    state.grid = {2, {-2 * h, -2 * h, 0}, h, {nx / 2 + 4, ny / 2 + 4, 1}};
    auto& p = state.particles;
    p.resize(nx * ny);
    const double d = h / 2;
    for (Index i = 0; i < nx * ny; ++i)
    {
        const auto k = std::size_t(i);
        p.x[0][k] = d * (double(i % nx) + 0.5);
        p.x[1][k] = d * (double(i / nx) + 0.5);
        p.length0[0][k] = p.length0[1][k] = d;
        p.volume0[k] = p.volume[k] = d * d;
        p.mass[k] = rho * d * d;
        p.id[k] = i;
    }
    p.padLastChunk();
    state.nextId = nx * ny;
    return state;
}

/// Bilinear weights, written down independently of libmpm/shape.
WeightTable bilinear(const state::State& state)
{
    WeightTable table;
    table.nodesPerAxis = 2;
    const auto& grid = state.grid;
    const Index row = grid.cells[0] + 1;
    for (Index j = 0; j <= grid.cells[1]; ++j)
        for (Index i = 0; i < row; ++i)
            table.position.push_back({grid.origin[0] + grid.h * double(i), grid.origin[1] + grid.h * double(j), 0});
    for (std::size_t p = 0; p < std::size_t(state.particles.size()); ++p)
    {
        const double sx = (state.particles.x[0][p] - grid.origin[0]) / grid.h;
        const double sy = (state.particles.x[1][p] - grid.origin[1]) / grid.h;
        const Index i = Index(sx), j = Index(sy);
        const double a = sx - double(i), b = sy - double(j);
        table.cell.push_back(std::int32_t(p));
        table.rows.insert(table.rows.end(), {j * row + i, (j + 1) * row + i});
        table.weight.insert(table.weight.end(), {1 - a, a, 1 - b, b});
    }
    return table;
}

void randomise(state::Particles& p)
{
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> uniform(0.1, 1);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.mass[i] *= uniform(engine);
        p.x[0][i] += 0.1 * p.length0[0][i] * uniform(engine);
        for (std::size_t c = 0; c < 4; ++c)
            p.stress[c][i] = -1e5 * uniform(engine);
    }
}
} // namespace

TEST_CASE("smoothing keeps a constant stress")
{
    auto state = block(8, 12, 0.5);
    randomise(state.particles);
    const double constant[4] = {-3e4, -7e4, -2e4, 1e3};
    for (std::size_t c = 0; c < 4; ++c)
        std::fill(state.particles.stress[c].begin(), state.particles.stress[c].end(), constant[c]);
    for (const auto& table : {bilinear(state), weightTable(state, "uGIMP"), weightTable(state, "cpGIMP")})
    {
        const auto out = smoothStress(state.particles, table);
        REQUIRE(out.nodal.size() == 4);
        REQUIRE(out.smoothed[0].size() == 96);
        for (std::size_t c = 0; c < 4; ++c)
        {
            for (double value : out.smoothed[c])
                CHECK(value == Approx(constant[c]).epsilon(1e-13));
            for (double value : out.nodal[c])
                CHECK(value == Approx(constant[c]).epsilon(1e-13));
        }
    }
}

TEST_CASE("smoothing keeps the sum of mass times stress and makes no new extremes")
{
    auto state = block(10, 14, 0.5);
    randomise(state.particles);
    const auto& p = state.particles;
    for (const auto& table : {bilinear(state), weightTable(state, "linear"), weightTable(state, "uGIMP")})
    {
        const auto out = smoothStress(p, table);
        for (std::size_t c = 0; c < 4; ++c)
        {
            double before = 0, after = 0, atNodes = 0;
            const auto [low, high] = std::minmax_element(p.stress[c].begin(), p.stress[c].begin() + p.size());
            for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            {
                before += p.mass[i] * p.stress[c][i];
                after += p.mass[i] * out.smoothed[c][i];
                CHECK(out.smoothed[c][i] > *low);
                CHECK(out.smoothed[c][i] < *high);
            }
            for (std::size_t n = 0; n < out.nodeMass.size(); ++n)
                atNodes += out.nodeMass[n] * out.nodal[c][n];
            CHECK(after == Approx(before).epsilon(1e-12));
            CHECK(atNodes == Approx(before).epsilon(1e-12));
        }
    }
}

TEST_CASE("nodal stress is weighted by mass")
{
    // Two particles in one cell, mirrored about its centre: each has 0.81 at its own corner, 0.01 at the other's.
    auto state = block(2, 1, 1.0);
    auto& p = state.particles;
    p.x[0][0] = p.x[1][0] = 0.1;
    p.x[0][1] = p.x[1][1] = 0.9;
    p.mass[0] = 3;
    p.mass[1] = 1;
    p.stress[1][0] = -10;
    p.stress[1][1] = -50;
    const auto table = bilinear(state);
    const auto out = smoothStress(p, table);
    REQUIRE(out.nodePosition.size() == 4);
    const auto at = [&](double x, double y) {
        for (std::size_t n = 0; n < 4; ++n)
            if (std::abs(out.nodePosition[n][0] - x) + std::abs(out.nodePosition[n][1] - y) < 1e-12)
                return out.nodal[1][n];
        return std::nan("");
    };
    const double nearFirst = (3 * 0.81 * -10 + 1 * 0.01 * -50) / (3 * 0.81 + 0.01);
    const double nearSecond = (3 * 0.01 * -10 + 1 * 0.81 * -50) / (3 * 0.01 + 0.81);
    const double between = (3 * -10 - 50) / 4.0;
    CHECK(at(0, 0) == Approx(nearFirst).epsilon(1e-13));
    CHECK(at(1, 1) == Approx(nearSecond).epsilon(1e-13));
    CHECK(at(1, 0) == Approx(between).epsilon(1e-13));
    CHECK(out.smoothed[1][0] == Approx(0.81 * nearFirst + 0.18 * between + 0.01 * nearSecond).epsilon(1e-13));
}

TEST_CASE("the table of a shape is the solver's: linear equals bilinear, wide domains reach further, rows sum to one")
{
    auto state = block(6, 6, 0.5);
    randomise(state.particles);
    const auto out = smoothStress(state.particles, weightTable(state, "linear"));
    const auto expected = smoothStress(state.particles, bilinear(state));
    CHECK(out.nodeMass.size() == expected.nodeMass.size());
    for (std::size_t i = 0; i < out.smoothed[1].size(); ++i)
        CHECK(out.smoothed[1][i] == Approx(expected.smoothed[1][i]).epsilon(1e-12));

    for (const auto& shape : shapeNames())
    {
        const auto table = weightTable(state, shape);
        REQUIRE(table.particles() == 36);
        for (Index p = 0; p < 36; ++p)
        {
            double sum = 0;
            Vector3 centre{};
            table.visitNodes(p, [&](std::size_t node, double weight) {
                sum += weight;
                for (std::size_t a = 0; a < 2; ++a)
                    centre[a] += weight * table.position[node][a];
            });
            CHECK(sum == Approx(1).epsilon(1e-13));
            for (std::size_t a = 0; a < 2; ++a) // all shapes keep linear fields
                CHECK(centre[a] == Approx(state.particles.x[a][std::size_t(p)]).margin(1e-13));
        }
    }
    // uGIMP keeps its box when the particle stretches, cpGIMP follows.
    auto stretched = state;
    for (auto& value : stretched.particles.F[0])
        value = 2;
    CHECK(weightTable(stretched, "uGIMP").weight == weightTable(state, "uGIMP").weight);
    const auto reached = [](const WeightTable& table) {
        Index count = 0;
        for (Index p = 0; p < table.particles(); ++p)
            table.visitNodes(p, [&](std::size_t, double) { ++count; });
        return count;
    };
    CHECK(reached(weightTable(stretched, "cpGIMP")) > reached(weightTable(state, "cpGIMP")));
    CHECK_THROWS_WITH(weightTable(state, "gimp"),
                      Catch::Contains("linear, uGIMP, cpGIMP, CPDI, quadraticBSpline or cubicBSpline"));
    state.particles.x[0][3] = -100;
    CHECK_THROWS_WITH(weightTable(state, "linear"), Catch::Contains("id 3 lies outside"));
}

TEST_CASE("3D weights: a constant stress and the sum stay")
{
    state::State state(3);
    state.grid = {3, {0, 0, 0}, 1.0, {6, 6, 6}};
    auto& p = state.particles;
    p.resize(27);
    for (std::size_t i = 0; i < 27; ++i)
    {
        p.x[0][i] = 2.3 + 0.5 * double(i % 3);
        p.x[1][i] = 2.1 + 0.5 * double(i / 3 % 3);
        p.x[2][i] = 2.7 + 0.5 * double(i / 9);
        for (std::size_t a = 0; a < 3; ++a)
            p.length0[a][i] = 0.5;
        p.mass[i] = 1 + double(i);
        p.stress[5][i] = double(i * i);
        p.stress[2][i] = -4;
        p.id[i] = Index(i);
    }
    p.padLastChunk();
    const auto out = smoothStress(p, weightTable(state, "uGIMP"));
    double before = 0, after = 0;
    for (std::size_t i = 0; i < 27; ++i)
    {
        CHECK(out.smoothed[2][i] == Approx(-4).epsilon(1e-13));
        before += p.mass[i] * p.stress[5][i];
        after += p.mass[i] * out.smoothed[5][i];
    }
    CHECK(after == Approx(before).epsilon(1e-12));
}

TEST_CASE("overburden of a level layer is rho g depth, at particles and nodes")
{
    const auto state = block(8, 20, 0.5); // 2 m wide, 5 m high
    const Overburden above(state, {0, -g, 0});
    CHECK(above.axis() == 1);
    for (Index i = 0; i < state.particles.size(); ++i)
        CHECK(above.atParticle(i) == Approx(-rho * g * (5 - state.particles.x[1][std::size_t(i)])).epsilon(1e-12));
    CHECK(above.atPoint({1, 2, 0}) == Approx(-rho * g * 3).epsilon(1e-12));
    CHECK(above.atPoint({0, 2, 0}) ==
          Approx(-rho * g * 3).epsilon(1e-12)); // at the side: from the column that is there
    CHECK(above.atPoint({1, 6, 0}) == 0);
    CHECK(above.atPoint({-1, 2, 0}) == 0);
    const Overburden below(state, {0, g, 0}); // gravity upwards
    CHECK(below.atPoint({1, 2, 0}) == Approx(-rho * g * 2).epsilon(1e-12));
    CHECK_THROWS_AS(Overburden(state, {1, -g, 0}), InputError);
    CHECK_THROWS_AS(Overburden(state, {0, 0, 0}), InputError);
}

TEST_CASE("overburden follows the deformed domains")
{
    // Sheared by 45 degrees in x: columns of the grid cut every domain, yet the total weight stays and away from the
    // slopes the layer is level still.
    auto state = block(40, 8, 0.5); // 10 m wide, 2 m high
    auto& p = state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.x[0][i] += p.x[1][i];
        p.F[1][i] = 1;
    }
    state.grid.cells[0] += 8;
    const Overburden above(state, {0, -g, 0});
    double onBase = 0;
    for (Index c = 0; c < 28; ++c)
        onBase += 0.5 * above.atPoint({-1 + 0.5 * (double(c) + 0.5), -0.01, 0});
    CHECK(onBase == Approx(-rho * g * 20).epsilon(1e-12));
    CHECK(above.atPoint({5.25, 0.5, 0}) == Approx(-rho * g * 1.5).epsilon(0.02));
    // Compressed to half its height, the layer weighs the same on its base.
    auto flat = block(8, 20, 0.5);
    for (std::size_t i = 0; i < 160; ++i)
    {
        flat.particles.x[1][i] *= 0.5;
        flat.particles.F[3][i] = 0.5;
    }
    CHECK(Overburden(flat, {0, -g, 0}).atPoint({1, 0.5, 0}) == Approx(-rho * g * 4).epsilon(1e-12));
}

TEST_CASE("overburden in 3D")
{
    state::State state(3);
    state.grid = {3, {0, 0, 0}, 1.0, {2, 2, 4}};
    auto& p = state.particles;
    p.resize(4 * 4 * 8);
    for (std::size_t i = 0; i < 128; ++i)
    {
        p.x[0][i] = 0.25 + 0.5 * double(i % 4);
        p.x[1][i] = 0.25 + 0.5 * double(i / 4 % 4);
        p.x[2][i] = 0.25 + 0.5 * double(i / 16);
        for (std::size_t a = 0; a < 3; ++a)
            p.length0[a][i] = 0.5;
        p.mass[i] = rho / 8;
        p.id[i] = Index(i);
    }
    const Overburden above(state, {0, 0, -g});
    CHECK(above.axis() == 2);
    for (Index i = 0; i < 128; ++i)
        CHECK(above.atParticle(i) == Approx(-rho * g * (4 - p.x[2][std::size_t(i)])).epsilon(1e-12));
    CHECK(above.atPoint({1, 1, 1}) == Approx(-rho * g * 3).epsilon(1e-12));
}

TEST_CASE("quality numbers against values by hand")
{
    const auto quality = fieldQuality({-1, -3, -2}, {-2, -4, -3});
    CHECK(quality.min == -3);
    CHECK(quality.max == -1);
    CHECK(quality.error == Approx(1));
    CHECK(quality.correlation == Approx(1));
    CHECK(fieldQuality({1, 2, 3}, {3, 2, 1}).correlation == Approx(-1));
    CHECK(fieldQuality({1, 2, 4}, {1, 1, 3}).correlation == Approx(std::sqrt(25.0 / 28.0)));
    CHECK(std::isnan(fieldQuality({1, 1}, {1, 2}).correlation));
    CHECK(relativeDifference({3, 4}, {0, 5}) == Approx(std::sqrt(10.0) / 5));
}

TEST_CASE("a linear heap has no noise beyond its floor, a checkerboard has much")
{
    auto state = block(16, 32, 0.5);
    auto& p = state.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        p.stress[1][i] = -rho * g * (8 - p.x[1][i]);
    const auto table = weightTable(state, "uGIMP");
    std::vector<double> overburden;
    const auto calm = stressQuality(state, table, smoothStress(p, table), {0, -g, 0}, &overburden);
    CHECK(calm.noise == Approx(calm.noiseFloor).epsilon(1e-9));
    CHECK(calm.noise > 0.005);
    CHECK(calm.noise < 0.05);
    CHECK(calm.raw.correlation == Approx(1));
    CHECK(calm.raw.error < 1e-6);
    CHECK(calm.raw.min == Approx(-rho * g * 7.875));
    CHECK(calm.smoothed.correlation > 0.999);
    CHECK(std::abs(calm.worstPlace[1] - 4) > 3.5); // Eq. 12 bends linear fields at the top and the base only
    CHECK(overburden.size() == 512);

    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        p.stress[1][i] *= (i + i / 16) % 2 ? 2 : 0;
    const auto erratic = stressQuality(state, table, smoothStress(p, table), {0, -g, 0});
    CHECK(erratic.noise > 0.9);
    CHECK(erratic.noiseFloor == Approx(calm.noiseFloor));
    CHECK(erratic.raw.correlation < 0.6);
    CHECK(erratic.smoothed.correlation > 0.95);

    const auto weightless = stressQuality(state, table, smoothStress(p, table), {0, 0, 0});
    CHECK(weightless.noise == erratic.noise);
    CHECK(std::isnan(weightless.raw.correlation));
    CHECK(std::isnan(weightless.noiseFloor));
}

TEST_CASE("across a periodic side stresses are smoothed as anywhere else")
{
    // a wave of stress over seven cells, and the same wave moved by three: smoothing must move with it
    std::vector<double> first;
    for (const double shift : {0.0, 3.0})
    {
        state::State state(2);
        state.grid = {2, {0, 0, 0}, 1, {7, 7, 1}, {true, true, false}};
        auto& p = state.particles;
        p.resize(14 * 14);
        for (std::size_t i = 0; i < 14 * 14; ++i)
        {
            p.x[0][i] = 0.25 + 0.5 * double(i % 14);
            p.x[1][i] = 0.25 + 0.5 * double(i / 14);
            p.length0[0][i] = p.length0[1][i] = 0.5;
            p.mass[i] = 2;
            p.stress[0][i] = std::sin(2 * M_PI * (p.x[0][i] - shift) / 7) + std::cos(2 * M_PI * p.x[1][i] / 7);
        }
        p.padLastChunk();
        const auto out = smoothStress(p, weightTable(state, "uGIMP"));
        std::vector<double> row;
        for (std::size_t i = 0; i < 14; ++i)
            row.push_back(out.smoothed[0][14 * 6 + (i + std::size_t(2 * shift)) % 14]);
        if (first.empty())
            first = row;
        for (std::size_t i = 0; i < 14; ++i)
            CHECK(row[i] == Approx(first[i]).margin(1e-13));
        for (const double mass : out.nodeMass)
            CHECK(mass == Approx(8).epsilon(1e-14)); // every node carries a full cell
    }
}

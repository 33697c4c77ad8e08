// What targets of stress relaxation make of fields: linear ones, checkerboards, waves, periodic ones.
#include "support/particleValues.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::test;

namespace
{
/// Rayleigh quotient of I - O on a wave of `cells` along x in a periodic box.
double lost(StressTarget target, int dim, const std::string& shape, Index cells)
{
    const auto state = block(dim, {cells, 3, 3}, true);
    const double k = 2 * M_PI / (double(cells) * h);
    const Values wave = field(state.particles, [&](double x, double, double) { return std::sin(k * x + 0.3); });
    const Values kept = apply(target, state, weightTable(state, shape), wave);
    return 1 - inner(state, wave, kept) / inner(state, wave, wave);
}
} // namespace

TEST_CASE("least squares leave linear fields alone at corners, walls and a sloping surface")
{
    for (const int dim : {2, 3})
    {
        auto state = block(dim, dim == 2 ? std::array<Index, 3>{8, 8, 1} : std::array<Index, 3>{5, 5, 4});
        disturb(state);
        auto& p = state.particles;
        std::size_t kept = 0; // what lies below the slope
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            if (p.x[1][i] + 0.7 * p.x[0][i] < 2.9)
            {
                for (std::size_t a = 0; a < std::size_t(dim); ++a)
                    p.x[a][kept] = p.x[a][i];
                p.mass[kept++] = p.mass[i];
            }
        REQUIRE(kept > 90);
        p.resize(Index(kept));
        p.padLastChunk();
        const Values linear = field(p, [](double x, double y, double z) { return 0.3 + 2 * x - 3 * y + 1.5 * z; });
        for (const auto& shape : shapeNames())
        {
            INFO(dim << "D " << shape);
            const auto table = weightTable(state, shape);
            CHECK(largest(minus(apply(StressTarget::leastSquares, state, table, linear), linear)) < 1e-12);
            CHECK(largest(minus(apply(StressTarget::smoothed, state, table, linear), linear)) > 0.1);
        }
    }
}

TEST_CASE("a checkerboard of particles goes entirely inside")
{
    for (const int dim : {2, 3})
    {
        auto state = block(dim, {4, 4, 4}, true);
        for (double& x : state.particles.x[0])
            x += 0.07; // wherever the lattice lies in the cells
        const Values board = field(state.particles, [](double x, double y, double z) {
            const auto index = [](double v) { return int(std::floor(v / (h / 2))); };
            return (index(x) + index(y) + index(z)) % 2 ? 1.0 : -1.0;
        });
        for (const auto& shape : shapeNames())
        {
            const auto table = weightTable(state, shape);
            for (const auto target : targets)
            {
                INFO(dim << "D " << shape << " " << stressTargetNames()[std::size_t(target)]);
                CHECK(largest(apply(target, state, table, board)) < 1e-13);
            }
        }
    }
}

TEST_CASE("stripes at a free surface leave what can be worked out by hand")
{
    // linear shapes, stripes +1, -1, +1, ... from the surface y = 0 on, at h/4, 3h/4, ...: only the node at the surface
    // sees them (3/4 - 1/4 = 1/2; its line is that of the two particles next to it, which it cannot tell from noise)
    const auto state = block(2, {4, 6, 1});
    const Values stripes =
        field(state.particles, [](double, double y, double) { return int(y / (h / 2)) % 2 ? -1.0 : 1.0; });
    const auto table = weightTable(state, "linear");
    const double expected[3][4] = {
        {3. / 8, 1. / 8, 0, 0}, {63. / 128, 13. / 128, -9. / 128, -3. / 128}, {3. / 4, -1. / 4, 0, 0}};
    for (const auto target : targets)
    {
        const Values out = apply(target, state, table, stripes);
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t i = 0; i < 8; ++i)
                CHECK(out[8 * row + i] == Approx(expected[int(target)][row]).margin(1e-13));
    }
}

TEST_CASE("waves lose the second order of k h under smoothing, the fourth under the others")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapeNames())
            for (const auto target : targets)
            {
                const double coarse = lost(target, dim, shape, 16), fine = lost(target, dim, shape, 32);
                INFO(dim << "D " << shape << " " << stressTargetNames()[std::size_t(target)] << " " << fine);
                CHECK(std::log2(coarse / fine) == Approx(target == StressTarget::smoothed ? 2 : 4).margin(0.06));
            }
    CHECK(lost(StressTarget::smoothed, 2, "linear", 64) == Approx(0.1875 * std::pow(2 * M_PI / 64, 2)).epsilon(0.01));
}

TEST_CASE("no place along a periodic axis is special")
{
    for (const int dim : {2, 3})
    {
        auto state = block(dim, {5, 4, 4}, true);
        disturb(state);
        auto& p = state.particles;
        const Values s = noise(p.size(), 4);
        const auto wrap = [&] {
            for (std::size_t a = 0; a < std::size_t(dim); ++a)
                for (double& x : p.x[a])
                    x -= std::floor(x / (h * double(state.grid.cells[a]))) * h * double(state.grid.cells[a]);
        };
        wrap();
        for (const auto& shape : shapeNames())
            for (const auto target : targets)
            {
                const Values before = apply(target, state, weightTable(state, shape), s);
                const auto places = p.x;
                for (std::size_t a = 0; a < std::size_t(dim); ++a)
                    for (double& x : p.x[a])
                        x += h * double(1 + a);
                wrap();
                INFO(dim << "D " << shape << " " << stressTargetNames()[std::size_t(target)]);
                CHECK(largest(minus(apply(target, state, weightTable(state, shape), s), before)) < 1e-11);
                p.x = places;
            }
    }
}

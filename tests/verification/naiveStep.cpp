// The step against the naive one of libmpm/benchmark, which shares with it no line of weights, transfer and nodes.
#include "benchmark/column.hpp"
#include "benchmark/naiveStepper.hpp"
#include "case/makeStepper.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <omp.h>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
/// Columns of the state in the order of ids.
std::vector<double> byId(const state::Particles& p, const state::Column<double>& column)
{
    std::vector<std::size_t> order(std::size_t(p.size()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p.id[a] < p.id[b]; });
    std::vector<double> out;
    for (const std::size_t i : order)
        out.push_back(column[i]);
    return out;
}

/// Largest difference over a group of columns, relative to the group's largest number.
template <std::size_t n>
double difference(const state::Particles& a, const state::Particles& b, const std::array<state::Column<double>, n>& x,
                  const std::array<state::Column<double>, n>& y, int columns)
{
    double largest = 0, apart = 0;
    for (int k = 0; k < columns; ++k)
    {
        const auto u = byId(a, x[k]), v = byId(b, y[k]);
        for (std::size_t i = 0; i < u.size(); ++i)
        {
            largest = std::max(largest, std::abs(u[i]));
            apart = std::max(apart, std::abs(u[i] - v[i]));
        }
    }
    return apart / largest;
}

struct Sums
{
    double kinetic = 0, momentum = 0, volume = 0, strainLike = 0;
};

Sums sumsOf(const state::Particles& p)
{
    Sums sums;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        for (int a = 0; a < p.dim; ++a)
        {
            sums.kinetic += 0.5 * p.mass[i] * p.v[a][i] * p.v[a][i];
            sums.momentum += p.mass[i] * p.v[a][i];
        }
        for (int k = 0; k < stressComponents(p.dim); ++k)
            sums.strainLike += p.volume[i] * p.stress[k][i] * p.stress[k][i];
        sums.volume += p.volume[i];
    }
    return sums;
}

/// The column beside the lattice, so that no domain ends at a node: what such an end touches carries a mass of
/// round-off squared, and the velocity there only the digits of round-off.
state::State shiftedColumn(int dim, Index across)
{
    auto state = benchmark::seedColumn(dim, across);
    for (int a = 0; a < dim; ++a)
        for (double& x : state.particles.x[a])
            x += (0.07 + 0.04 * a) * state.grid.h;
    return state;
}

void runBoth(state::State& ours, state::State& naive, const std::string& shape, const stepping::Scene& scene)
{
    omp_set_num_threads(1); // small work; waiting threads would cost more
    const auto reference = benchmark::makeNaiveStepper(shape, naive, scene);
    const auto stepper = cases::makeStepper(shape, ours, scene);
    const double dt = 0.9 * benchmark::columnDeltaT(*stepper, ours, scene, cases::limitIgnoresMass(shape));
    for (int i = 0; i < 50; ++i)
    {
        stepper->step(dt);
        reference->step(dt);
    }
    reference->store(naive);
}

void requireEqual(const state::State& a, const state::State& b)
{
    const auto &p = a.particles, &q = b.particles;
    REQUIRE(p.size() == q.size());
    CHECK(difference(p, q, p.x, q.x, p.dim) < 1e-9);
    CHECK(difference(p, q, p.v, q.v, p.dim) < 1e-9);
    CHECK(difference(p, q, p.F, q.F, p.dim * p.dim) < 1e-9);
    CHECK(difference(p, q, p.stress, q.stress, stressComponents(p.dim)) < 1e-9);
    const Sums s = sumsOf(p), t = sumsOf(q);
    CHECK(s.kinetic == Approx(t.kinetic).epsilon(1e-9));
    CHECK(s.momentum == Approx(t.momentum).epsilon(1e-9));
    CHECK(s.volume == Approx(t.volume).epsilon(1e-9));
    CHECK(s.strainLike == Approx(t.strainLike).epsilon(1e-9));
}
} // namespace

TEST_CASE("50 steps of the column equal the naive step's")
{
    const int dim = GENERATE(2, 3);
    const std::string shape = GENERATE("linear", "uGIMP", "cpGIMP");
    const StressUpdate update = GENERATE(StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL);
    CAPTURE(dim, shape, int(update));
    auto scene = benchmark::columnScene("mohrCoulomb", update);
    scene.picRate = 2;
    auto ours = shiftedColumn(dim, dim == 2 ? 14 : 6), naive = ours;
    runBoth(ours, naive, shape, scene);
    REQUIRE(benchmark::yieldingShare(ours, scene.materials) > 0.3); // the law had something to do
    requireEqual(ours, naive);
}

TEST_CASE("The naive step and ours agree at fixed walls and rollers, and without material friction")
{
    const std::string shape = GENERATE("linear", "uGIMP", "cpGIMP");
    auto scene = benchmark::columnScene("linearElastic", StressUpdate::MUSL);
    auto ours = shiftedColumn(2, 14), naive = ours;
    scene.walls = {{"base", nodal::WallType::fixed, 1, -1, 0, 0, false},
                   {"right", nodal::WallType::roller, 0, 1, -Index(ours.grid.origin[0] / ours.grid.h) + 7, 0, true}};
    runBoth(ours, naive, shape, scene);
    requireEqual(ours, naive);
}

TEST_CASE("The naive step refuses what it leaves out")
{
    auto state = benchmark::seedColumn(2, 4);
    auto scene = benchmark::columnScene("mohrCoulomb", StressUpdate::MUSL);
    REQUIRE_THROWS_WITH(benchmark::makeNaiveStepper("bSpline", state, scene), Catch::Contains("bSpline"));
    scene.splitting = benchmark::columnSplitting();
    REQUIRE_THROWS_WITH(benchmark::makeNaiveStepper("uGIMP", state, scene), Catch::Contains("splitting"));
}

// RK2 and RK4 on the semi-discrete equations: orders against CVODE, conservation, threads, restart, stability.
#include "case/makeStepper.hpp"
#include "reference/semiDiscreteSolution.hpp"
#include "stepping/energyBudget.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <omp.h>
#include <random>

using namespace mpm;
using stepping::RungeKuttaOrder;

namespace
{
constexpr double E = 1e7, density = 1000;

/// A free block in all its bending, stretching and turning; 3 x 3 (x 2) particles a cell, off the lattice of nodes.
state::State freeBlock(int dim, double speed)
{
    auto s = scenes::seedBlock({.dim = dim,
                                .corner = {2.03, 2.21, 2.11},
                                .n = {10, 6, 4},
                                .spacing = 0.5,
                                .h = 1,
                                .density = density,
                                .cells = {12, 10, 8}});
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        const double x = p.x[0][i] - 4.5, y = p.x[1][i] - 3.7, z = dim == 3 ? p.x[2][i] - 3.1 : 0;
        p.v[0][i] = speed * (std::sin(0.6 * x) - 0.4 * y + 0.1 * z + 0.2);
        p.v[1][i] = speed * (0.4 * x + 0.3 * std::cos(0.8 * x) - 0.3 * y);
        if (dim == 3)
            p.v[2][i] = speed * (0.2 * x * y - 0.5 * z);
    }
    return s;
}

stepping::Scene elasticScene()
{
    stepping::Scene scene;
    scene.materials = {scenes::elastic(E, 0.3, density)};
    return scene;
}

double waveSpeed()
{
    return scenes::elastic(E, 0.3, density).waveSpeed();
}

/// RMS distance of positions, particles matched by id.
double distance(const state::State& a, const state::State& b)
{
    const std::size_t n = std::size_t(a.particles.size());
    std::vector<std::size_t> at(n);
    for (std::size_t i = 0; i < n; ++i)
        at[std::size_t(b.particles.id[i])] = i;
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < std::size_t(a.particles.dim); ++k)
        {
            const double d = a.particles.x[k][i] - b.particles.x[k][at[std::size_t(a.particles.id[i])]];
            sum += d * d;
        }
    return std::sqrt(sum / double(n));
}

state::State exactEnd(const std::string& shape, const state::State& start, const stepping::Scene& scene, double window)
{
    auto equations = cases::makeSemiDiscrete(shape, start, scene);
    const auto exact =
        reference::integrateSemiDiscrete(*equations, start, stepping::semiDiscreteModel(scene), window, 1e-13);
    state::State end = start;
    equations->unpack(exact.y.data(), end);
    return end;
}

void run(const std::string& shape, RungeKuttaOrder order, state::State& s, const stepping::Scene& scene, double dt,
         int steps)
{
    stepping::beginLedger(s, scene.materials);
    auto stepper = cases::makeRungeKutta(shape, order, s, scene);
    for (int n = 0; n < steps; ++n)
        stepper->step(dt);
}
} // namespace

TEST_CASE("Runge-Kutta steps converge to the semi-discrete equations with their orders")
{
    const std::vector<std::pair<int, std::string>> pairs = {
        {2, "uGIMP"}, {2, "cpGIMP"}, {2, "quadraticBSpline"}, {2, "cubicBSpline"}, {3, "cpGIMP"}};
    for (const auto& [dim, shape] : pairs)
    {
        const auto start = freeBlock(dim, 0.02);
        auto scene = elasticScene();
        scene.gravity = Vector3{1, -9.8, 0};
        scene.relaxationTime = 0.02;
        const double window = 16 * 0.4 / waveSpeed();
        const auto exact = exactEnd(shape, start, scene, window);
        for (const auto order : {RungeKuttaOrder::RK2, RungeKuttaOrder::RK4})
        {
            double before = 0, seen = 0;
            for (const int steps : {32, 64})
            {
                auto s = start;
                run(shape, order, s, scene, window / steps, steps);
                const double error = distance(s, exact);
                seen = before > 0 ? std::log2(before / error) : 0;
                fmt::print("{}D {} RK{} dt c/h {:.2f} error {:.3e} order {:.2f}\n", dim, shape, int(order), 6.4 / steps,
                           error, seen);
                before = error;
            }
            CHECK(seen == Approx(int(order)).margin(order == RungeKuttaOrder::RK2 ? 0.1 : 0.25));
            CHECK(before < (order == RungeKuttaOrder::RK2 ? 3e-7 : 2e-10));
        }
    }
}

TEST_CASE("free motion keeps mass and momentum, and energy up to the order of the step")
{
    for (const auto order : {RungeKuttaOrder::RK2, RungeKuttaOrder::RK4})
    {
        std::vector<double> left;
        for (const int steps : {40, 80})
        {
            auto s = freeBlock(2, 1.0); // crosses cells, 10 % strain
            const auto scene = elasticScene();
            run("cpGIMP", order, s, scene, 16 / waveSpeed() / steps, steps);
            const auto t = stepping::totals(s, scene.materials);
            for (std::size_t a = 0; a < 2; ++a)
                CHECK(std::abs(t.momentum[a] - s.ledger.initialMomentum[a]) <= 1e-13 * t.mass * 1.0 * steps);
            left.push_back(std::abs(stepping::residual(s.ledger, t.strainEnergy)) / s.ledger.initialKineticEnergy);
        }
        fmt::print("RK{}: energy residual {:.2e} and {:.2e} of the initial energy, order {:.2f}\n", int(order), left[0],
                   left[1], std::log2(left[0] / left[1]));
        CHECK(std::log2(left[0] / left[1]) > int(order) + 0.7); // |growth| - 1 of an oscillation is of order p + 1
        CHECK(left[1] < (order == RungeKuttaOrder::RK2 ? 2e-3 : 2e-6));
    }
}

TEST_CASE("a column on a roller in gravity: impulses of wall and gravity add up to the momentum, energy closes")
{
    auto s = scenes::seedBlock({.n = {4, 12, 1}, .spacing = 0.5, .h = 1, .density = density, .cells = {4, 8, 1}});
    auto scene = elasticScene();
    scene.gravity = Vector3{0, -9.8, 0};
    using nodal::WallType;
    scene.walls = {{"base", WallType::fixed, 1, -1, 0, 0, false}, {"left", WallType::roller, 0, -1, 0, 0, false}};
    stepping::beginLedger(s, scene.materials);
    run("uGIMP", RungeKuttaOrder::RK4, s, scene, 0.2 / waveSpeed(), 200);
    const auto t = stepping::totals(s, scene.materials);
    const auto& l = s.ledger;
    for (std::size_t a = 0; a < 2; ++a)
        CHECK(std::abs(t.momentum[a] - l.gravityImpulse[a] - l.wallImpulse[a]) <=
              1e-12 * std::abs(l.gravityImpulse[1]));
    CHECK(l.wallImpulse[1] > 0);
    CHECK(std::abs(stepping::residual(l, t.strainEnergy)) <= 1e-6 * l.gravityWork);
    CHECK(l.gravityWork > 0);
}

TEST_CASE("Runge-Kutta steps do not depend on threads, and go on bitwise from a state")
{
    const auto scene = elasticScene();
    const double dt = 0.4 / waveSpeed();
    std::vector<state::State> ends;
    for (const int threads : {1, 3})
    {
        omp_set_num_threads(threads);
        auto s = freeBlock(2, 6); // particles leave their windows between sorts
        run("cpGIMP", RungeKuttaOrder::RK4, s, scene, dt, 45);
        ends.push_back(s);
    }
    auto s = freeBlock(2, 6);
    run("cpGIMP", RungeKuttaOrder::RK4, s, scene, dt, 23);
    auto stepper = cases::makeRungeKutta("cpGIMP", RungeKuttaOrder::RK4, s, scene); // as after loading
    for (int n = 23; n < 45; ++n)
        stepper->step(dt);
    ends.push_back(s);
    omp_set_num_threads(1);
    for (std::size_t k = 1; k < ends.size(); ++k)
    {
        CHECK(ends[0].particles.x == ends[k].particles.x);
        CHECK(ends[0].particles.stress == ends[k].particles.stress);
        CHECK(ends[0].ledger.kineticEnergy == ends[k].ledger.kineticEnergy);
    }
}

namespace
{
/// A free block of a law with nu, particles anywhere in their cells, moved off a lattice by up to `disorder` of their
/// spacing.
state::State disorderedBlock(int dim, Index perCell, double disorder, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0, 1);
    const double spacing = 1.0 / double(perCell);
    const Index n = 3 * perCell;
    auto s = scenes::seedBlock({.dim = dim,
                                .corner = {2 + any(random), 2 + any(random), 2 + any(random)},
                                .n = {n, n, n},
                                .spacing = spacing,
                                .h = 1,
                                .density = density,
                                .cells = {8, 8, 8}});
    for (int a = 0; a < dim; ++a)
        for (double& x : s.particles.x[std::size_t(a)])
            x += disorder * spacing * (any(random) - 0.5);
    return s;
}

/// Largest frequency of small vibrations over c_p/h. At rest and without stress the equations are sigma' = T v,
/// v' = - T* sigma with T* the adjoint of T in kinetic and elastic energy: skew, so all frequencies are real and the
/// largest is the norm of T, by power iteration on T* T.
double largestFrequency(const std::string& shape, const state::State& start, double poisson)
{
    stepping::Scene scene;
    scene.materials = {scenes::elastic(E, poisson, density)};
    auto equations = cases::makeSemiDiscrete(shape, start, scene);
    std::vector<double> y, rate;
    equations->pack(start, y);
    rate.resize(y.size());
    const std::size_t n = std::size_t(start.particles.size()), dim = std::size_t(start.particles.dim);
    const auto v = dim * n, F = 2 * dim * n, sigma = F + dim * dim * n;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (std::size_t i = v; i < F; ++i)
        y[i] = any(random);
    double growth = 0;
    for (int k = 0; k < 200; ++k)
    {
        equations->rates(0, y.data(), rate.data());
        std::fill(y.begin() + Index(v), y.begin() + Index(F), 0.0);
        std::copy(rate.begin() + Index(sigma), rate.end(), y.begin() + Index(sigma));
        equations->rates(0, y.data(), rate.data());
        std::fill(y.begin() + Index(sigma), y.end(), 0.0);
        double norm = 0;
        for (std::size_t i = v; i < F; ++i)
            norm += rate[i] * rate[i];
        growth = norm = std::sqrt(norm);
        for (std::size_t i = v; i < F; ++i)
            y[i] = rate[i] / norm;
    }
    return std::sqrt(growth) / scene.materials[0].waveSpeed();
}
} // namespace

TEST_CASE("vibrations lie under the frequency the limits are made for", "[long]")
{
    double most[2] = {};
    for (const int dim : {2, 3})
        for (const std::string shape : {"uGIMP", "cpGIMP", "quadraticBSpline", "cubicBSpline"})
            for (const double poisson : {0.0, 0.3, 0.499})
                for (const Index perCell : {1, 2, 3})
                    for (unsigned seed = 1; seed <= (dim == 2 ? 8 : 2); ++seed)
                    {
                        if (dim == 3 && perCell == 3)
                            continue;
                        const double disorder = seed % 2 ? 0 : 0.8;
                        const double omega =
                            largestFrequency(shape, disorderedBlock(dim, perCell, disorder, seed), poisson);
                        if (omega > most[dim - 2])
                            fmt::print("{}D {} nu {} {} a cell disorder {}: omega h/c {:.3f}\n", dim, shape, poisson,
                                       perCell, disorder, omega);
                        most[dim - 2] = std::max(most[dim - 2], omega);
                    }
    for (const int dim : {2, 3})
        CHECK(most[dim - 2] <= 2.828 / stepping::rungeKuttaCourant(RungeKuttaOrder::RK4, dim));
}

TEST_CASE("growth of noise: RK4 is stable up to z = 2.83, RK2 grows by z^4/8 a step")
{
    const auto start = disorderedBlock(2, 2, 0, 3);
    const auto scene = elasticScene();
    const double omega = largestFrequency("uGIMP", start, 0.3) * waveSpeed();
    const auto energyGrowth = [&](RungeKuttaOrder order, double z, int steps) {
        auto s = start;
        std::mt19937 random(5);
        std::uniform_real_distribution<double> any(-1e-9, 1e-9);
        for (std::size_t a = 0; a < 2; ++a)
            for (double& v : s.particles.v[a])
                v = any(random);
        stepping::beginLedger(s, scene.materials);
        auto stepper = cases::makeRungeKutta("uGIMP", order, s, scene);
        for (int n = 0; n < steps; ++n)
            stepper->step(z / omega);
        return (s.ledger.kineticEnergy + stepper->report().strainEnergy) / s.ledger.initialKineticEnergy;
    };
    CHECK(energyGrowth(RungeKuttaOrder::RK4, 2.8, 400) <= 1);
    CHECK(energyGrowth(RungeKuttaOrder::RK4, 2.9, 100) > 10);
    const double allowed = stepping::rungeKuttaCourant(RungeKuttaOrder::RK2, 2) * 1.5;
    CHECK(energyGrowth(RungeKuttaOrder::RK2, allowed, 990) <= std::exp(2.0)); // all modes grow at most as the fastest
    CHECK(energyGrowth(RungeKuttaOrder::RK2, 1, 100) > 1e3);
}

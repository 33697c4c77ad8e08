#pragma once
// Clouds of particles with values, and the targets of stress relaxation on them.
#include "smoothing/stressTargets.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace mpm::test
{
using namespace mpm::smoothing;

constexpr double h = 0.5;
constexpr StressTarget targets[] = {StressTarget::smoothed, StressTarget::filtered, StressTarget::leastSquares};
using Values = std::vector<double>;

/// Two particles an axis in each of `cells`; empty grid around them unless all axes are periodic.
inline state::State block(int dim, std::array<Index, 3> cells, bool periodic = false)
{
    state::State state(dim);
    const Index margin = periodic ? 0 : 3;
    state.grid = {dim, {}, h, {1, 1, 1}};
    Index particles = 1;
    for (std::size_t a = 0; a < std::size_t(dim); ++a)
    {
        state.grid.origin[a] = -h * double(margin);
        state.grid.cells[a] = cells[a] + 2 * margin;
        state.grid.periodic[a] = periodic;
        particles *= 2 * cells[a];
    }
    auto& p = state.particles;
    p.resize(particles);
    for (Index i = 0; i < particles; ++i)
    {
        Index rest = i;
        for (std::size_t a = 0; a < std::size_t(dim); ++a)
        {
            p.x[a][std::size_t(i)] = h / 2 * (double(rest % (2 * cells[a])) + 0.5);
            p.length0[a][std::size_t(i)] = state::Stored(h / 2);
            rest /= 2 * cells[a];
        }
        p.mass[std::size_t(i)] = 1;
        p.id[std::size_t(i)] = i;
    }
    p.padLastChunk();
    state.nextId = particles;
    return state;
}

/// Particles out of their places, of all kinds of mass and stretch.
inline void disturb(state::State& state)
{
    auto& p = state.particles;
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.mass[i] = 0.1 + uniform(engine);
        for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
        {
            p.x[a][i] += 0.2 * h * (uniform(engine) - 0.5);
            p.F[a * std::size_t(p.dim + 1)][i] = 0.8 + 0.5 * uniform(engine);
        }
    }
    p.padLastChunk();
}

inline Values noise(Index n, unsigned seed)
{
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    Values values(static_cast<std::size_t>(n));
    for (double& value : values)
        value = normal(engine);
    return values;
}

template <class Function>
Values field(const state::Particles& p, Function&& f)
{
    Values values;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        values.push_back(f(p.x[0][i], p.x[1][i], p.dim == 3 ? p.x[2][i] : 0.0));
    return values;
}

inline Values apply(StressTarget target, const state::State& state, const WeightTable& table, const Values& values)
{
    StressColumns out;
    stressTarget(target, {values.data()}, state.particles, table, out);
    return out.at(0);
}

inline double inner(const state::State& state, const Values& a, const Values& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += state.particles.mass[i] * a[i] * b[i];
    return sum;
}

inline Values minus(Values a, const Values& b)
{
    for (std::size_t i = 0; i < a.size(); ++i)
        a[i] -= b[i];
    return a;
}

inline double largest(const Values& values)
{
    double most = 0;
    for (const double value : values)
        most = std::max(most, std::abs(value));
    return most;
}
} // namespace mpm::test

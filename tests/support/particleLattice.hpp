#pragma once
// Lattices of particles on a grid, for tests of what is made of stored states.
#include "state/state.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace mpm::test
{
/// A lattice of particles, two a cell and axis, over cells^dim cells of size h from `origin` on, with a frame of empty
/// cells around it unless the grid is periodic.
inline state::State lattice(int dim, Index cells, double h, bool periodic = false, Vector3 origin = {})
{
    state::State state(dim);
    const Index frame = periodic ? 0 : 3, n = 2 * cells;
    state.grid.dim = dim;
    state.grid.h = h;
    state.grid.cells = {1, 1, 1};
    auto& p = state.particles;
    p.resize(dim == 2 ? n * n : n * n * n);
    for (std::size_t a = 0; a < std::size_t(dim); ++a)
    {
        state.grid.origin[a] = origin[a] - h * double(frame);
        state.grid.cells[a] = cells + 2 * frame;
        state.grid.periodic[a] = periodic;
        state.seedSpacing[a] = h / 2;
    }
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        std::size_t rest = i;
        for (std::size_t a = 0; a < std::size_t(dim); ++a, rest /= std::size_t(n))
        {
            p.x[a][i] = origin[a] + 0.5 * h * (double(rest % std::size_t(n)) + 0.5);
            p.length0[a][i] = state::Stored(h / 2);
        }
        p.volume0[i] = p.volume[i] = std::pow(h / 2, dim);
        p.mass[i] = 1000 * p.volume0[i];
        p.id[i] = Index(i);
    }
    p.padLastChunk();
    return state;
}

/// Cell of a particle along an axis.
inline Index cellOf(const state::State& state, std::size_t i, std::size_t axis)
{
    return Index(std::floor((state.particles.x[axis][i] - state.grid.origin[axis]) / state.grid.h));
}

inline double signOfCell(const state::State& state, std::size_t i)
{
    Index sum = 0;
    for (std::size_t a = 0; a < std::size_t(state.particles.dim); ++a)
        sum += cellOf(state, i, a);
    return sum % 2 ? -1 : 1;
}

/// +-1 from particle to particle of a lattice.
inline double signOfParticle(const state::State& state, std::size_t i)
{
    Index sum = 0;
    for (std::size_t a = 0; a < std::size_t(state.particles.dim); ++a)
        sum += Index(std::floor((state.particles.x[a][i] - state.grid.origin[a]) / (0.5 * state.grid.h)));
    return sum % 2 ? -1 : 1;
}

template <class Field>
std::vector<double> valuesOf(const state::State& state, Field&& field)
{
    std::vector<double> out(std::size_t(state.particles.size()));
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = field(i);
    return out;
}

inline void scatter(state::State& state)
{
    std::mt19937_64 engine(7);
    std::uniform_real_distribution<double> uniform(-0.2, 0.2);
    for (std::size_t i = 0; i < std::size_t(state.particles.size()); ++i)
    {
        for (std::size_t a = 0; a < std::size_t(state.particles.dim); ++a)
            state.particles.x[a][i] += uniform(engine) * state.grid.h;
        state.particles.mass[i] *= 1 + uniform(engine);
    }
}
} // namespace mpm::test

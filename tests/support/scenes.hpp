#pragma once
/// Small scenes built in memory: a block of particles on a regular lattice.
#include "constitutive/linearElastic.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/stepper.hpp"

#include <cmath>

namespace scenes
{
using namespace mpm;

/// n[k] particles along axis k, `spacing` apart, the lower corner of the block at `corner`; cells of side h from `low`.
struct Block
{
    int dim = 2;
    Vector3 corner{};
    std::array<Index, 3> n{1, 1, 1};
    double spacing = 1, h = 2, density = 1000;
    Vector3 low{};
    std::array<Index, 3> cells{1, 1, 1};
    Vector3 velocity{};
};

inline state::State seedBlock(const Block& b)
{
    state::State s(b.dim);
    s.grid.h = b.h;
    s.grid.origin = b.low;
    s.grid.cells = b.cells;
    auto& p = s.particles;
    const Index nz = b.dim == 3 ? b.n[2] : 1;
    p.resize(b.n[0] * b.n[1] * nz);
    Index i = 0;
    for (Index z = 0; z < nz; ++z)
        for (Index y = 0; y < b.n[1]; ++y)
            for (Index x = 0; x < b.n[0]; ++x, ++i)
            {
                const std::size_t k = std::size_t(i);
                const Index index[3] = {x, y, z};
                for (int a = 0; a < b.dim; ++a)
                {
                    p.x[a][k] = b.corner[a] + (double(index[a]) + 0.5) * b.spacing;
                    p.v[a][k] = b.velocity[a];
                    p.length0[a][k] = b.spacing;
                }
                p.volume0[k] = p.volume[k] = std::pow(b.spacing, b.dim);
                p.mass[k] = b.density * p.volume[k];
                p.id[k] = i;
            }
    p.padLastChunk();
    s.nextId = i;
    for (int a = 0; a < b.dim; ++a)
        s.seedSpacing[a] = b.spacing;
    s.materials = {"solid"};
    return s;
}

inline constitutive::Material elastic(double E, double nu, double density = 1000)
{
    return {"solid", density, std::make_shared<constitutive::LinearElastic>(constitutive::ElasticModuli{E, nu})};
}
} // namespace scenes

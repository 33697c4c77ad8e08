// Transfer of one chunk between particles and nodes: weights, records, projection, gathers. The chunk is one row of
// cells along a tile with 4 (8 in 3D) particles a cell, which share their first nodes, in the window of that tile.
#include "microBenchmark.hpp"
#include "shape/cpGIMP.hpp"
#include "shape/linear.hpp"
#include "shape/quadraticBSpline.hpp"
#include "shape/uGIMP.hpp"
#include "transfer/gridToParticle.hpp"
#include "transfer/particleToGrid.hpp"

#include <vector>

using namespace mpm;

namespace
{
template <int dim, class Shape>
struct Row
{
    state::GridBox grid{dim, {0, 0, 0}, 0.25, {64, 64, dim == 3 ? 64 : 1}};
    state::NodeBox window{{15, 15, dim == 3 ? 15 : 0}, {1, 1, 1}};
    alignas(64) double x[dim][lanes], half[dim][lanes], mass[1][lanes], volume[1][lanes];
    alignas(64) double v[dim][lanes], stress[stressSize<dim>][lanes], L[dim * dim][lanes];
    transfer::Values<dim> value;
    transfer::ChunkWeights<dim, Shape> w;
    transfer::ParticleRecords<dim, transfer::Momentum> momentum;
    transfer::ParticleRecords<dim, transfer::Forces> forces;
    std::vector<Record> sums, velocity, gradient; ///< of half records too, where half will do

    Row()
    {
        constexpr int side = 1 << state::TileLayout::bitsOf(dim);
        for (int a = 0; a < dim; ++a)
            window.n[a] = side + Shape::nodes + 1;
        kernels::fill(x, 0, 0.02, 1);
        for (int l = 0; l < lanes; ++l)
            for (int a = 0; a < dim; ++a)
            {
                const int cell = a == 0 ? l >> dim : side / 2;
                x[a][l] += grid.h * (16 + cell + 0.5 * (Shape::nodes - 2) + ((l >> a) % 2 == 0 ? 0.25 : 0.75));
            }
        // a domain wider than a cell for the shape that has room for it
        kernels::fill(half, Shape::nodes == 4 ? 0.55 : 0.25, 0.02, 2);
        kernels::fill(mass, 30, 1, 3);
        kernels::fill(volume, 0.015, 0.001, 4);
        kernels::fill(v, 0, 2, 5);
        kernels::fill(stress, -30e3, 20e3, 6);
        w.evaluate(x, half, grid);
        momentum.build(mass[0], v);
        forces.build(mass[0], v, volume[0], stress);
        sums.assign(std::size_t(window.size()), Record{});
        velocity.assign(sums.size(), splat<Record>(0.5));
        gradient.assign(sums.size(), splat<Record>(0.25));
    }

    template <class R>
    static R* as(std::vector<Record>& records)
    {
        return reinterpret_cast<R*>(records.data());
    }
};

void nothing() {}

template <int dim, class Shape, class Kernel>
void repeat(benchmark::State& run, const Kernel& kernel)
{
    Row<dim, Shape> row;
    if (!row.w.locate(row.window))
        run.SkipWithError("the row leaves its window");
    for (int l = 1; l < lanes; ++l)
        if ((row.w.offset[l] == row.w.offset[l - 1]) != (l % (1 << dim) != 0))
            run.SkipWithError("particles of a cell do not share their first node");
    for (auto _ : run)
    {
        kernel(row);
        benchmark::DoNotOptimize(row);
        benchmark::ClobberMemory();
    }
    kernels::perParticle(run);
}

template <int dim, class Shape>
void weights(benchmark::State& run)
{
    repeat<dim, Shape>(run, [](auto& r) {
        r.w.evaluate(r.x, r.half, r.grid);
        benchmark::DoNotOptimize(r.w.locate(r.window));
    });
}

template <int dim>
void recordsOfMomentum(benchmark::State& run)
{
    repeat<dim, shape::UGIMP>(run, [](auto& r) { r.momentum.build(r.mass[0], r.v); });
}

template <int dim>
void recordsOfForces(benchmark::State& run)
{
    repeat<dim, shape::UGIMP>(run, [](auto& r) { r.forces.build(r.mass[0], r.v, r.volume[0], r.stress); });
}

template <int dim, class Shape>
void projectMomentum(benchmark::State& run)
{
    repeat<dim, Shape>(run, [](auto& r) {
        projectChunk(r.w, r.momentum, lanes, r.template as<HalfRecord>(r.sums), r.window, nothing);
    });
}

template <int dim, class Shape>
void projectForces(benchmark::State& run)
{
    repeat<dim, Shape>(
        run, [](auto& r) { projectChunk(r.w, r.forces, lanes, r.template as<Record>(r.sums), r.window, nothing); });
}

template <int dim, class Shape>
void values(benchmark::State& run)
{
    using Node = typename transfer::ValueNode<dim>::Type;
    repeat<dim, Shape>(run,
                       [](auto& r) { gatherValues(r.w, r.template as<Node>(r.velocity), r.window, r.value, nothing); });
}

template <int dim, class Shape>
void velocityGradient(benchmark::State& run)
{
    using Node = typename transfer::GradientNode<dim, 1>::Type;
    repeat<dim, Shape>(run,
                       [](auto& r) { gatherGradient(r.w, r.template as<Node>(r.gradient), r.window, r.L, nothing); });
}

BENCHMARK_TEMPLATE(weights, 2, shape::Linear);
BENCHMARK_TEMPLATE(weights, 2, shape::UGIMP);
BENCHMARK_TEMPLATE(weights, 2, shape::QuadraticBSpline);
BENCHMARK_TEMPLATE(weights, 2, shape::CpGIMP);
BENCHMARK_TEMPLATE(weights, 3, shape::Linear);
BENCHMARK_TEMPLATE(weights, 3, shape::UGIMP);
BENCHMARK_TEMPLATE(weights, 3, shape::QuadraticBSpline);
BENCHMARK_TEMPLATE(weights, 3, shape::CpGIMP);
BENCHMARK_TEMPLATE(recordsOfMomentum, 2);
BENCHMARK_TEMPLATE(recordsOfMomentum, 3);
BENCHMARK_TEMPLATE(recordsOfForces, 2);
BENCHMARK_TEMPLATE(recordsOfForces, 3);
BENCHMARK_TEMPLATE(projectMomentum, 2, shape::UGIMP);
BENCHMARK_TEMPLATE(projectMomentum, 2, shape::CpGIMP);
BENCHMARK_TEMPLATE(projectMomentum, 3, shape::UGIMP);
BENCHMARK_TEMPLATE(projectMomentum, 3, shape::CpGIMP);
BENCHMARK_TEMPLATE(projectForces, 2, shape::UGIMP);
BENCHMARK_TEMPLATE(projectForces, 2, shape::CpGIMP);
BENCHMARK_TEMPLATE(projectForces, 3, shape::UGIMP);
BENCHMARK_TEMPLATE(projectForces, 3, shape::CpGIMP);
BENCHMARK_TEMPLATE(values, 2, shape::UGIMP);
BENCHMARK_TEMPLATE(values, 2, shape::CpGIMP);
BENCHMARK_TEMPLATE(values, 3, shape::UGIMP);
BENCHMARK_TEMPLATE(values, 3, shape::CpGIMP);
BENCHMARK_TEMPLATE(velocityGradient, 2, shape::UGIMP);
BENCHMARK_TEMPLATE(velocityGradient, 2, shape::CpGIMP);
BENCHMARK_TEMPLATE(velocityGradient, 3, shape::UGIMP);
BENCHMARK_TEMPLATE(velocityGradient, 3, shape::CpGIMP);
} // namespace

// Sorting the particles of the column by position, after each of them moved by a quarter of a cell.
#include "benchmark/column.hpp"
#include "microBenchmark.hpp"
#include "stepping/sortParticles.hpp"

namespace
{
template <int dim>
void sortMoved(benchmark::State& run)
{
    auto state = mpm::benchmark::seedColumn(dim, run.range(0));
    const mpm::state::TileLayout layout(state.grid);
    mpm::stepping::sortByPosition(state, layout, 3);
    double move = 0.25 * state.grid.h;
    for (auto _ : run)
    {
        for (double& x : state.particles.x[0])
            x += move;
        move = -move;
        mpm::stepping::sortByPosition(state, layout, 3);
    }
    kernels::perParticle(run, state.particles.size());
}

BENCHMARK_TEMPLATE(sortMoved, 2)->Arg(60)->Arg(240)->Arg(720)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(sortMoved, 3)->Arg(36)->Arg(80)->Unit(benchmark::kMillisecond);
} // namespace

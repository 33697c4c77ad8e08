// What happens to one chunk before and after its law (stepping/strainSweep.hpp).
#include "microBenchmark.hpp"
#include "stepping/strainSweep.hpp"

#include <algorithm>

using namespace mpm;

namespace
{
/// A whole chunk and its columns; |dt L| of some `size`.
template <int dim>
struct Swept
{
    stepping::StrainLanes<dim> chunk;
    alignas(64) constitutive::TensorLanes<dim> L, F, startF;
    alignas(64) constitutive::StressLanes<dim> stress;
    alignas(64) double volume[1][lanes], volume0[1][lanes];
    stepping::StrainColumns<dim> columns;
    stepping::StrainStep step{constitutive::TakenOver::start, 1};
    transfer::Prefetch ahead;

    explicit Swept(double size)
    {
        kernels::fill(L, 0, size, 1);
        kernels::fill(startF, 0, 0.2, 2);
        kernels::fill(stress, -30e3, 20e3, 3);
        kernels::fill(volume, 0.015, 0.001, 4);
        kernels::fill(volume0, 0.015, 0.001, 5);
        for (int k = 0; k < dim; ++k)
            for (double& value : startF[k * dim + k])
                value += 1;
        for (int k = 0; k < dim * dim; ++k)
            columns.F[k] = F[k];
        for (int k = 0; k < stressSize<dim>; ++k)
            columns.stress[k] = stress[k];
        columns.volume = volume[0];
        columns.volume0 = volume0[0];
        std::fill_n(chunk.halfOverBulk, lanes, 1e-8);
        std::fill_n(chunk.quarterOverShear, lanes, 1e-8);
        constitutive::reportElastic(chunk.law);
        ahead.clear();
    }
    void strain()
    {
        std::copy_n(&L[0][0], dim * dim * lanes, &chunk.L[0][0]);
        std::copy_n(&startF[0][0], dim * dim * lanes, &F[0][0]); // it would grow without bound
        stepping::strainSweep(chunk, columns, step, ahead);
    }
};

template <int dim>
void beforeTheLaw(benchmark::State& run)
{
    Swept<dim> swept(1e-3 * double(run.range(0)));
    for (auto _ : run)
    {
        swept.strain();
        benchmark::DoNotOptimize(swept);
        benchmark::ClobberMemory();
    }
    kernels::perParticle(run);
}

template <int dim>
void afterTheLaw(benchmark::State& run)
{
    Swept<dim> swept(1e-3);
    swept.strain();
    for (auto _ : run)
    {
        stepping::bookSweep(swept.chunk, swept.columns, swept.step);
        benchmark::DoNotOptimize(swept);
        benchmark::ClobberMemory();
    }
    kernels::perParticle(run);
}

// small motion and, in thousandths of dt L, large
BENCHMARK_TEMPLATE(beforeTheLaw, 2)->Arg(1)->Arg(50);
BENCHMARK_TEMPLATE(beforeTheLaw, 3)->Arg(1)->Arg(50);
BENCHMARK_TEMPLATE(afterTheLaw, 2);
BENCHMARK_TEMPLATE(afterTheLaw, 3);
} // namespace

// Stress updates of one chunk: elastic trial, return to the surface, plastic work.
#include "constitutive/linearElastic.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "microBenchmark.hpp"

#include <algorithm>

using namespace mpm;

namespace
{
constexpr constitutive::ElasticModuli moduli{20e6, 0.42};

/// Stresses like in the soil of the column and steps of a strain that makes most lanes yield, at faces, edges and apex.
template <int dim>
void update(benchmark::State& run, const constitutive::Law& law)
{
    constitutive::Chunk<dim> chunk;
    double stress[stressSize<dim>][lanes];
    kernels::fill(stress, 0, 20e3, 1);
    for (int k = 0; k < 3; ++k)
        for (double& value : stress[k])
            value -= 30e3;
    kernels::fill(chunk.dStrain, 0, 1e-3, 2);
    for (auto _ : run)
    {
        std::copy_n(&stress[0][0], stressSize<dim> * lanes, &chunk.stress[0][0]);
        law.update(chunk);
        benchmark::DoNotOptimize(chunk.stress);
        benchmark::ClobberMemory();
    }
    int yielding = 0;
    for (const auto region : chunk.region)
        yielding += region != constitutive::Region::elastic;
    run.counters["yielding"] = law.plastic() ? double(yielding) / lanes : 0;
    kernels::perParticle(run);
}

template <int dim>
void linearElastic(benchmark::State& run)
{
    update<dim>(run, constitutive::LinearElastic(moduli));
}

template <int dim>
void mohrCoulomb(benchmark::State& run)
{
    update<dim>(run, constitutive::MohrCoulomb({moduli, 1e3, 42, 0}));
}

BENCHMARK_TEMPLATE(linearElastic, 2);
BENCHMARK_TEMPLATE(linearElastic, 3);
BENCHMARK_TEMPLATE(mohrCoulomb, 2);
BENCHMARK_TEMPLATE(mohrCoulomb, 3);
} // namespace

// Finite motion of one chunk: F, J, dR sigma dR^T, dt D, U.
#include "constitutive/kinematics.hpp"
#include "microBenchmark.hpp"

#include <algorithm>

using namespace mpm;
using namespace mpm::constitutive;

namespace
{
constexpr double dt = 1e-3;

/// A chunk in motion: |dt L| of some 1e-2, F near the identity.
template <int dim>
struct Motion
{
    alignas(64) TensorLanes<dim> L, F;
    alignas(64) StressLanes<dim> stress;
    alignas(64) double J[lanes], U[dim][lanes];

    Motion()
    {
        kernels::fill(L, 0, 10, 1);
        kernels::fill(F, 0, 0.2, 2);
        kernels::fill(stress, -30e3, 20e3, 3);
        for (int k = 0; k < dim; ++k)
            for (double& value : F[k * dim + k])
                value += 1;
    }
};

template <int dim, class Kernel>
void repeat(benchmark::State& run, const Kernel& kernel)
{
    Motion<dim> motion;
    for (auto _ : run)
    {
        kernel(motion);
        benchmark::DoNotOptimize(motion);
        benchmark::ClobberMemory();
    }
    kernels::perParticle(run);
}

template <int dim>
void expDtLTimesF(benchmark::State& run)
{
    const Motion<dim> start;
    repeat<dim>(run, [&](Motion<dim>& m) {
        std::copy_n(&start.F[0][0], dim * dim * lanes, &m.F[0][0]); // F would grow without bound
        advanceDeformation(m.L, dt, m.F);
    });
}

template <int dim>
void rotation(benchmark::State& run)
{
    repeat<dim>(run, [](Motion<dim>& m) { rotateStress(m.L, dt, m.stress); });
}

template <int dim>
void symmetricPart(benchmark::State& run)
{
    repeat<dim>(run, [](Motion<dim>& m) { strainIncrement(m.L, dt, m.stress); });
}

template <int dim>
void jacobian(benchmark::State& run)
{
    repeat<dim>(run, [](Motion<dim>& m) { determinant(m.F, m.J); });
}

template <int dim>
void rightStretch(benchmark::State& run)
{
    repeat<dim>(run, [](Motion<dim>& m) { stretchDiagonal(m.F, m.U); });
}

BENCHMARK_TEMPLATE(expDtLTimesF, 2);
BENCHMARK_TEMPLATE(expDtLTimesF, 3);
BENCHMARK_TEMPLATE(rotation, 2);
BENCHMARK_TEMPLATE(rotation, 3);
BENCHMARK_TEMPLATE(symmetricPart, 2);
BENCHMARK_TEMPLATE(symmetricPart, 3);
BENCHMARK_TEMPLATE(jacobian, 2);
BENCHMARK_TEMPLATE(jacobian, 3);
BENCHMARK_TEMPLATE(rightStretch, 2);
BENCHMARK_TEMPLATE(rightStretch, 3);
} // namespace

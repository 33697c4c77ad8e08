#pragma once
/// What the benchmarks of kernels share: numbers to work on and the time of one particle.
#include "constitutive/law.hpp"

#include <benchmark/benchmark.h>
#include <random>

namespace kernels
{
using mpm::Index;
using mpm::lanes;

/// Shows the time of one particle beside that of one iteration over `particles` of them.
inline void perParticle(benchmark::State& run, Index particles = lanes)
{
    run.counters["perParticle"] = benchmark::Counter(double(particles), benchmark::Counter::kIsIterationInvariantRate |
                                                                            benchmark::Counter::kInvert);
}

/// Fills columns of lanes with middle +- width.
template <std::size_t n>
void fill(double (&columns)[n][lanes], double middle, double width, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(middle - width, middle + width);
    for (auto& column : columns)
        for (double& value : column)
            value = number(random);
}
} // namespace kernels

#include "benchmark/peaks.hpp"

#include "base/alignedVector.hpp"
#include "base/clock.hpp"

#include <algorithm>
#include <memory>
#include <omp.h>

namespace mpm::benchmark
{
namespace
{
#if defined(__AVX512F__)
constexpr int registerBytes = 64;
#elif defined(__AVX__)
constexpr int registerBytes = 32;
#else
constexpr int registerBytes = 16;
#endif
typedef double Wide __attribute__((vector_size(registerBytes)));
constexpr int wide = registerBytes / 8;
constexpr int chains = 12; ///< more than latency times units of any x86 core, less than the registers there are

constexpr int repetitions = 7;

template <class Body>
double fastest(const Body& body)
{
    double best = 1e300;
    for (int i = 0; i < repetitions; ++i)
    {
        double seconds = 0;
        {
            Clock clock(seconds);
            body();
        }
        best = std::min(best, seconds);
    }
    return best;
}

/// a <- a f + g with |f| < 1: the numbers stay near g/(1 - f).
double fmaChains(long rounds)
{
    Wide a[chains];
    for (int c = 0; c < chains; ++c)
        for (int l = 0; l < wide; ++l)
            a[c][l] = 1e-3 * (c + l);
    Wide f, g;
    for (int l = 0; l < wide; ++l)
    {
        f[l] = 0.999;
        g[l] = 1e-3;
    }
    for (long i = 0; i < rounds; ++i)
        for (int c = 0; c < chains; ++c)
            a[c] = a[c] * f + g;
    double sum = 0;
    for (int c = 0; c < chains; ++c)
        for (int l = 0; l < wide; ++l)
            sum += a[c][l];
    return sum;
}
} // namespace

double triadBytesPerSecond(int threads)
{
    constexpr long n = 12'000'000; // 3 x 96 MB
    // pages belong to the thread that touches them first
    const auto column = [] {
        return std::unique_ptr<double[]>(new double[n]); // not initialised
    };
    const auto a = column(), b = column(), c = column();
    double *pa = a.get(), *pb = b.get(), *pc = c.get();
#pragma omp parallel for schedule(static) num_threads(threads)
    for (long i = 0; i < n; ++i)
    {
        pa[i] = 0;
        pb[i] = 1;
        pc[i] = 2;
    }
    const double seconds = fastest([&] {
#pragma omp parallel for schedule(static) num_threads(threads)
        for (long i = 0; i < n; ++i)
            pa[i] = pb[i] + 3.0 * pc[i];
        std::swap(pa, pb); // every result is used
    });
    return 24.0 * double(n) / seconds;
}

double fmaFlopsPerSecond(int threads)
{
    constexpr long rounds = 2'000'000;
    volatile double sink = 0;
    const double seconds = fastest([&] {
        double sum = 0;
#pragma omp parallel num_threads(threads) reduction(+ : sum)
        sum += fmaChains(rounds);
        sink = sum;
    });
    return 2.0 * wide * chains * double(rounds) * threads / seconds;
}
} // namespace mpm::benchmark

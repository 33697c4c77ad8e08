#include "state/particles.hpp"

#include <algorithm>
#include <tuple>

namespace mpm::state
{
namespace
{
constexpr Index manyParticles = 100000; ///< worth a second thread

Index padded(Index n)
{
    return (n + lanes - 1) / lanes * lanes;
}
} // namespace

Particles::Particles(int dimension) : dim(dimension) {}

void Particles::resize(Index n)
{
    const Index old = size_, padding = std::min(n, padded(old));
    forEachColumn([&](auto& column) {
        column.resize(std::size_t(padded(n))); // zeros, but for the old padding
        if (old < padding)
            std::fill(column.begin() + old, column.begin() + padding, 0);
    });
    for (int k = 0; k < dim && old < n; ++k)
        std::fill(F[k * dim + k].begin() + old, F[k * dim + k].begin() + n, 1.0);
    size_ = n;
}

void Particles::enableX()
{
    hasX_ = true;
    for (int k = 0; k < dim; ++k)
        X[k] = x[k];
}

void Particles::enableAffine()
{
    hasAffine_ = true;
    for (int k = 0; k < dim * dim; ++k)
        affine[k].assign(mass.size(), 0.0);
}

void Particles::disableAffine()
{
    hasAffine_ = false;
    for (auto& column : affine)
        column = {};
}

namespace
{
void keepColumn(bool keep, std::size_t size, bool& has, Column<double>& column)
{
    if (keep && !has)
        column.assign(size, 0.0);
    if (!keep)
        column = {};
    has = keep;
}
} // namespace

void Particles::keepTensionGap(bool keep)
{
    keepColumn(keep, mass.size(), hasTensionGap_, tensionGap);
}

void Particles::keepDilationRate(bool keep)
{
    keepColumn(keep, mass.size(), hasDilationRate_, dilationRate);
}

void Particles::keepFlowMemory(bool keep)
{
    keepColumn(keep, mass.size(), hasFlowMemory_, flowMemory);
}

void Particles::keepViscousStress(bool keep)
{
    keepColumn(keep, mass.size(), hasViscousStress_, viscousStress);
}

void Particles::padLastChunk()
{
    if (size_ == 0)
        return;
    const std::size_t last = std::size_t(size_ - 1);
    forEachColumn([&](auto& column) { std::fill(column.begin() + size_, column.end(), column[last]); });
    for (std::size_t i = std::size_t(size_); i < mass.size(); ++i)
        mass[i] = volume0[i] = volume[i] = 0;
}

void Particles::permute(const std::vector<Index>& order)
{
    std::tuple<Column<double>, Column<float>, Column<std::int64_t>, Column<std::int32_t>> scratch;
    const Index* from = order.data();
    forEachColumn([&]<class T>(Column<T>& column) {
        auto& sorted = std::get<Column<T>>(scratch);
        sorted.resize(column.size());
        const T* in = column.data();
        T* out = sorted.data();
#pragma omp parallel for schedule(static) if (size_ > manyParticles)
        for (Index i = 0; i < size_; ++i)
            out[i] = in[from[i]];
        column.swap(sorted);
    });
    padLastChunk();
}

Index Particles::appendCopy(Index i)
{
    const Index j = size_;
    resize(size_ + 1);
    forEachColumn([&](auto& column) { column[std::size_t(j)] = column[std::size_t(i)]; });
    return j;
}
} // namespace mpm::state

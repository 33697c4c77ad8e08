#include "state/particles.hpp"

namespace mpm::state
{
namespace
{
Index padded(Index n)
{
    return (n + lanes - 1) / lanes * lanes;
}
} // namespace

Particles::Particles(int dimension) : dim(dimension) {}

void Particles::resize(Index n)
{
    const Index old = size_;
    forEachColumn([&](auto& column) { column.resize(std::size_t(padded(n))); });
    for (Index i = old; i < n; ++i)
    {
        forEachColumn([&](auto& column) { column[std::size_t(i)] = 0; });
        for (int k = 0; k < dim; ++k)
            F[k * dim + k][std::size_t(i)] = 1;
    }
    size_ = n;
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
    forEachColumn([&](auto& column) {
        auto copy = column;
        for (Index i = 0; i < size_; ++i)
            column[std::size_t(i)] = copy[std::size_t(order[std::size_t(i)])];
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

#include "state/permutation.hpp"

#include <algorithm>
#include <cstring>

namespace mpm::state
{
Permutation::Permutation(Order order) : from_(std::move(order))
{
    const std::size_t n = from_.size(), pieces = (n + piece - 1) / piece;
    changes_.resize(pieces);
    wanted_.resize(pieces);
    for (std::size_t k = 0; k < pieces; ++k)
    {
        const std::size_t first = k * piece, end = std::min(n, first + piece);
        const std::size_t low = k < reach ? 0 : first - reach * piece, high = first + (reach + 1) * piece;
        std::uint32_t moved = 0;
        for (std::size_t i = first; i < end; ++i)
        {
            const std::uint32_t old = from_[i];
            moved |= old ^ std::uint32_t(i);
            from_[i] = old & (ring - 1);
            if (old < low || old >= high)
            {
                from_[i] = std::uint32_t(ring + strangers_.size());
                strangers_.push_back(old);
            }
        }
        changes_[k] = moved != 0;
        for (std::size_t near = k < reach ? 0 : k - reach; moved && near < std::min(pieces, k + reach + 1); ++near)
            wanted_[near] = 1;
    }
}

namespace
{
/// Pairs of loads and one store; the processor's gathers take half as long again.
template <class T>
void gather(T* __restrict to, const T* __restrict old, const std::uint32_t* __restrict from, std::size_t count)
{
    constexpr std::size_t row = 8;
    std::size_t i = 0;
    for (; i + row <= count; i += row)
    {
        const T v[row] = {old[from[i]],     old[from[i + 1]], old[from[i + 2]], old[from[i + 3]],
                          old[from[i + 4]], old[from[i + 5]], old[from[i + 6]], old[from[i + 7]]};
        std::copy_n(v, row, to + i);
    }
    for (; i < count; ++i)
        to[i] = old[from[i]];
}
} // namespace

template <class T>
void Permutation::move(Column<T>& values, Column<T>& kept) const
{
    const std::size_t n = from_.size(), pieces = changes_.size();
    T* const column = values.data();
    if (n < 2 || std::memcmp(column, column + 1, (n - 1) * sizeof(T)) == 0) // all the same
        return;
    kept.resize(ring + strangers_.size());
    T* const old = kept.data();
    for (std::size_t s = 0; s < strangers_.size(); ++s)
        old[ring + s] = column[strangers_[s]];
    for (std::size_t k = 0, known = 0; k < pieces; ++k)
    {
        for (; known < std::min(pieces, k + reach + 1); ++known)
            if (wanted_[known])
                std::copy_n(column + known * piece, std::min(piece, n - known * piece), old + (known * piece) % ring);
        if (!changes_[k])
            continue;
        gather(column + k * piece, old, from_.data() + k * piece, std::min(piece, n - k * piece));
    }
}

template void Permutation::move(Column<double>&, Column<double>&) const;
template void Permutation::move(Column<float>&, Column<float>&) const;
template void Permutation::move(Column<std::int64_t>&, Column<std::int64_t>&) const;
template void Permutation::move(Column<std::int32_t>&, Column<std::int32_t>&) const;
} // namespace mpm::state

#pragma once
/// Columns of one chunk, copied to and from aligned local arrays: a chunk may start anywhere in a column, and the last
/// chunk of a tile may hold fewer than 64 particles. Verified in tests/unit/chunk.cpp.
#include "base/record.hpp"
#include "base/types.hpp"

#include <algorithm>
#include <cstring>

namespace mpm::transfer
{
using Lanes = double[lanes];

/// Asks for the columns of the next chunk while one is worked on: a few cache lines at a time, because a core can wait
/// for about two dozen only.
class Prefetch
{
  public:
    void clear() { count_ = 0; }
    void add(const double* column) { columns_[count_++] = column; }
    /// From now on, ask for the 64 particles from `first` on.
    void begin(Index first)
    {
        first_ = first;
        half_ = 0;
    }
    /// Asks for the next half column, four lines.
    void some()
    {
        if (half_ == 2 * count_)
            return;
        const double* line = columns_[half_ / 2] + first_ + half_ % 2 * 32;
        ++half_;
        for (int k = 0; k < 4; ++k)
            __builtin_prefetch(line + 8 * k);
    }
    void some(int halves)
    {
        for (; halves > 0; --halves)
            some();
    }

  private:
    const double* columns_[40];
    unsigned count_ = 0, half_ = 0;
    Index first_ = 0;
};

/// sum a b over the lanes of a chunk, in a fixed order.
inline double sumOfProducts(const Lanes& a, const Lanes& b)
{
    Record sum{};
    for (int g = 0; g < lanes; g += 8)
        sum += load(a + g) * load(b + g);
    return sumOf(sum);
}

/// A NaN may hide other values: ask allWithin first where it matters.
inline double largest(const Lanes& a)
{
    Record most = load(a);
    for (int g = 8; g < lanes; g += 8)
        most = largerOf(load(a + g), most);
    double value = most[0];
    for (int l = 1; l < 8; ++l)
        value = most[l] > value ? most[l] : value;
    return value;
}

inline double smallest(const Lanes& a)
{
    Record least = load(a);
    for (int g = 8; g < lanes; g += 8)
        least = smallerOf(load(a + g), least);
    double value = least[0];
    for (int l = 1; l < 8; ++l)
        value = least[l] < value ? least[l] : value;
    return value;
}

/// Is low <= a <= high in all lanes? (Not where a is NaN.)
inline bool allWithin(const Lanes& a, double low, double high)
{
    const Record lows = splat<Record>(low), highs = splat<Record>(high);
    auto within = lows == lows;
    for (int g = 0; g < lanes; g += 8)
        within &= (load(a + g) >= lows) & (load(a + g) <= highs);
    bool all = true;
    for (int l = 0; l < 8; ++l)
        all = all && within[l];
    return all;
}

/// out = column[0 .. count), repeated from the last value on, so that all lanes hold numbers kernels can work with.
inline void loadLanes(const double* column, int count, Lanes& out)
{
    if (count == lanes)
    {
        for (int l = 0; l < lanes; ++l)
            out[l] = column[l];
        return;
    }
    std::memcpy(out, column, std::size_t(count) * sizeof(double));
    std::fill(out + count, out + lanes, column[count - 1]);
}

/// The same with zero in the lanes beyond: masses and volumes, so that sums over all lanes are those of the particles.
inline void loadLanesOrZero(const double* column, int count, Lanes& out)
{
    loadLanes(column, count, out);
    for (int l = count; l < lanes; ++l)
        out[l] = 0;
}

inline void storeLanes(double* column, int count, const Lanes& in)
{
    if (count == lanes)
        for (int l = 0; l < lanes; ++l)
            column[l] = in[l];
    else
        std::copy_n(in, count, column);
}
} // namespace mpm::transfer

#pragma once
/// Columns of one chunk, copied to and from aligned local arrays: a chunk may start anywhere in a column, and the last
/// chunk of a tile may hold fewer than 64 particles. Columns hold doubles or floats (state::Stored), the arrays
/// doubles. Verified in tests/unit/chunk.cpp and chunkColumns.cpp.
#include "base/record.hpp"
#include "base/types.hpp"

#include <algorithm>
#include <type_traits>

namespace mpm::transfer
{
using Lanes = double[lanes];

/// Asks for the columns of the next chunk while one is worked on: a few cache lines at a time, because a core can wait
/// for about two dozen only.
class Prefetch
{
  public:
    void clear() { count_ = 0; }
    /// 64 doubles are two pieces of four lines, 64 floats are one.
    template <class T>
    void add(const T* column)
    {
        constexpr int perPiece = 256 / sizeof(T);
        for (int from = 0; from < lanes; from += perPiece)
            pieces_[count_++] = {reinterpret_cast<const char*>(column + from), sizeof(T)};
    }
    /// From now on, ask for the 64 particles from `first` on.
    void begin(Index first)
    {
        first_ = first;
        next_ = 0;
    }
    /// Asks for the next piece, four lines.
    void some()
    {
        if (next_ == count_)
            return;
        const Piece& piece = pieces_[next_++];
        const char* line = piece.column + first_ * piece.size;
        for (int k = 0; k < 4; ++k)
            __builtin_prefetch(line + 64 * k);
    }
    void some(int pieces)
    {
        for (; pieces > 0; --pieces)
            some();
    }

  private:
    struct Piece
    {
        const char* column;
        Index size; ///< of an element
    };
    Piece pieces_[80];
    unsigned count_ = 0, next_ = 0;
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

/// sum a over the lanes of a chunk, in a fixed order.
inline double sumOfLanes(const Lanes& a)
{
    Record sum{};
    for (int g = 0; g < lanes; g += 8)
        sum += load(a + g);
    return sumOf(sum);
}

/// A NaN may hide other values: ask allWithin first where it matters.
inline double largest(const Lanes& a)
{
    Record most = load(a);
    for (int g = 8; g < lanes; g += 8)
        most = largerOf(load(a + g), most);
    return largestOf(most);
}

inline double smallest(const Lanes& a)
{
    Record least = load(a);
    for (int g = 8; g < lanes; g += 8)
        least = smallerOf(load(a + g), least);
    return smallestOf(least);
}

/// Is low <= a <= high in all lanes? (Not where a is NaN.)
inline bool allWithin(const Lanes& a, double low, double high)
{
    const Record lows = splat<Record>(low), highs = splat<Record>(high);
    auto within = lows == lows;
    for (int g = 0; g < lanes; g += 8)
        within &= (load(a + g) >= lows) & (load(a + g) <= highs);
    return allOf(within);
}

/// out = column[0 .. count), repeated from the last value on, so that all lanes hold numbers kernels can work with.
template <class T>
[[gnu::always_inline]] inline void loadLanes(const T* column, int count, Lanes& out)
{
    if (count == lanes)
    {
        for (int l = 0; l < lanes; ++l)
            out[l] = column[l];
        return;
    }
    std::copy_n(column, count, out);
    std::fill(out + count, out + lanes, column[count - 1]);
}

/// Lanes a sweep may change in place: the column's own, or a copy where it holds fewer particles or floats; the copy
/// goes back by storeLanes.
template <class T>
[[gnu::always_inline]] inline double* lanesInPlace(T* column, int count, Lanes& copy)
{
    if constexpr (std::is_same_v<T, double>)
        if (count == lanes)
            return column;
    loadLanes(column, count, copy);
    return copy;
}

/// The same with zero in the lanes beyond: masses and volumes, so that sums over all lanes are those of the particles.
template <class T>
[[gnu::always_inline]] inline void loadLanesOrZero(const T* column, int count, Lanes& out)
{
    loadLanes(column, count, out);
    for (int l = count; l < lanes; ++l)
        out[l] = 0;
}

/// column = in. What a column of floats cannot hold is taken from `in` as well: what follows in a pass works with the
/// numbers that a pass of its own, or a restart, would load.
template <class T>
[[gnu::always_inline]] inline void storeLanes(T* column, int count, Lanes& in)
{
    if constexpr (!std::is_same_v<T, double>)
        for (int l = 0; l < lanes; ++l)
            in[l] = T(in[l]);
    if (count == lanes)
        for (int l = 0; l < lanes; ++l)
            column[l] = T(in[l]);
    else
        std::transform(in, in + count, column, [](double value) { return T(value); });
}
} // namespace mpm::transfer

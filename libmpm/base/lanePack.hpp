#pragma once
/// Doubles that travel together on a machine whose registers do not hold all of them: a row of registers that works
/// like one of the compiler's vectors (arithmetic lane by lane, a number times a vector, r[i]). A vector of the compiler
/// that is wider than a register lives in memory, where every operation reads and writes it (g++ 12: 8 times slower in
/// the transfer of uGIMP).
///
/// For kernels only, by way of base/record.hpp. Verified in tests/unit/record.cpp.
#include <cstddef>
#include <utility>

#define MPM_INLINE __attribute__((always_inline)) inline

namespace mpm
{
/// n lanes in registers of type Part, a vector of the compiler.
template <int n, class Part>
struct alignas(sizeof(double) * n) LanePack
{
    static constexpr int width = sizeof(Part) / sizeof(double);
    static constexpr int parts = n / width;
    Part part[parts];

    LanePack() = default;
    /// Values of the first lanes; the others are zero.
    template <class... Numbers>
    MPM_INLINE explicit(sizeof...(Numbers) == 0) LanePack(double first, Numbers... others) : part{}
    {
        static_assert(sizeof...(Numbers) < n);
        const double given[n] = {first, double(others)...};
        for (int p = 0; p < parts; ++p)
            for (int i = 0; i < width; ++i)
                part[p][i] = given[p * width + i];
    }

    /// Lanes in memory, aligned like the pack.
    MPM_INLINE static LanePack load(const double* from)
    {
        LanePack r;
        for (int p = 0; p < parts; ++p)
            r.part[p] = reinterpret_cast<const Aliasing*>(from)[p];
        return r;
    }
    MPM_INLINE void store(double* to) const
    {
        for (int p = 0; p < parts; ++p)
            reinterpret_cast<Aliasing*>(to)[p] = part[p];
    }

    MPM_INLINE double& operator[](std::ptrdiff_t i) { return reinterpret_cast<double*>(part)[i]; }
    MPM_INLINE double operator[](std::ptrdiff_t i) const { return reinterpret_cast<const double*>(part)[i]; }

    MPM_INLINE LanePack& operator+=(const LanePack& b) { return *this = *this + b; }
    MPM_INLINE LanePack& operator-=(const LanePack& b) { return *this = *this - b; }
    MPM_INLINE LanePack& operator*=(const LanePack& b) { return *this = *this * b; }

    /// f(part of a, part of b), part by part.
    template <class F>
    MPM_INLINE static LanePack map(const LanePack& a, const LanePack& b, F&& f)
    {
        return mapParts(a, b, f, std::make_index_sequence<parts>());
    }
    friend MPM_INLINE LanePack operator+(const LanePack& a, const LanePack& b)
    {
        return map(a, b, [](Part x, Part y) __attribute__((always_inline)) { return x + y; });
    }
    friend MPM_INLINE LanePack operator-(const LanePack& a, const LanePack& b)
    {
        return map(a, b, [](Part x, Part y) __attribute__((always_inline)) { return x - y; });
    }
    friend MPM_INLINE LanePack operator*(const LanePack& a, const LanePack& b)
    {
        return map(a, b, [](Part x, Part y) __attribute__((always_inline)) { return x * y; });
    }
    friend MPM_INLINE LanePack operator-(const LanePack& a)
    {
        return map(a, a, [](Part x, Part) __attribute__((always_inline)) { return -x; });
    }
    friend MPM_INLINE LanePack operator*(double s, const LanePack& a)
    {
        return map(a, a, [s](Part x, Part) __attribute__((always_inline)) { return s * x; });
    }
    friend MPM_INLINE LanePack operator*(const LanePack& a, double s) { return s * a; }

  private:
    typedef Part Aliasing __attribute__((may_alias));

    template <class F, std::size_t... p>
    MPM_INLINE static LanePack mapParts(const LanePack& a, const LanePack& b, F& f, std::index_sequence<p...>)
    {
        LanePack r;
        ((r.part[p] = f(a.part[p], b.part[p])), ...);
        return r;
    }
};

/// Where the lanes of register p of a shuffle come from: registers of a and b by number, lanes within them.
template <int p, int width, int... from>
struct ShuffleSource
{
    static constexpr int lane[sizeof...(from)] = {from...};
    static constexpr int part(int i) { return lane[p * width + i] / width; }
    static constexpr int first() { return part(0); }
    static constexpr int second()
    {
        for (int i = 1; i < width; ++i)
            if (part(i) != first())
                return part(i);
        return first();
    }
    static constexpr bool two() ///< no third register
    {
        for (int i = 0; i < width; ++i)
            if (part(i) != first() && part(i) != second())
                return false;
        return true;
    }
    /// Number of lane i among those of the first and the second register.
    static constexpr int at(int i) { return lane[p * width + i] % width + (part(i) == first() ? 0 : width); }
};

template <int p, int... from, int n, class Part>
MPM_INLINE Part shufflePart(const LanePack<n, Part>& a, const LanePack<n, Part>& b)
{
    constexpr int parts = LanePack<n, Part>::parts, width = LanePack<n, Part>::width;
    using Source = ShuffleSource<p, width, from...>;
    constexpr int first = Source::first(), second = Source::second();
    const Part x = first < parts ? a.part[first % parts] : b.part[first % parts];
    const Part y = second < parts ? a.part[second % parts] : b.part[second % parts];
    if constexpr (!Source::two())
    {
        Part r;
        for (int i = 0; i < width; ++i)
        {
            const int lane = Source::lane[p * width + i];
            r[i] = lane < n ? a.part[lane / width][lane % width] : b.part[(lane - n) / width][lane % width];
        }
        return r;
    }
    else if constexpr (width == 2)
        return __builtin_shufflevector(x, y, Source::at(0), Source::at(1));
    else
        return __builtin_shufflevector(x, y, Source::at(0), Source::at(1), Source::at(2), Source::at(3));
}

/// Lanes of a (0 .. n - 1) and b (n .. 2n - 1) by number, as __builtin_shufflevector has it.
template <int... from, int n, class Part>
MPM_INLINE LanePack<n, Part> shuffle(const LanePack<n, Part>& a, const LanePack<n, Part>& b)
{
    static_assert(sizeof...(from) == n);
    LanePack<n, Part> r;
    [&]<int... p>(std::integer_sequence<int, p...>) __attribute__((always_inline))
    {
        ((r.part[p] = shufflePart<p, from...>(a, b)), ...);
    }
    (std::make_integer_sequence<int, LanePack<n, Part>::parts>());
    return r;
}
} // namespace mpm

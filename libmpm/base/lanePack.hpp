#pragma once
/// Doubles that travel together on a machine whose registers do not hold all of them: a row of registers that works
/// like one of the compiler's vectors (arithmetic lane by lane, a number times a vector, r[i]). A vector of the
/// compiler that is wider than a register lives in memory, where every operation reads and writes it (g++ 12: 8 times
/// slower in the transfer of uGIMP).
///
/// For kernels only, by way of base/record.hpp. Verified in tests/unit/record.cpp.
#include <cstddef>
#include <utility>

#define MPM_INLINE __attribute__((always_inline)) inline

namespace mpm
{
/// What comparing n lanes says: -1 or 0 in each lane.
template <int n, class Part>
struct alignas(sizeof(double) * n) LaneMask
{
    using Word = decltype(Part{} < Part{});
    static constexpr int width = sizeof(Part) / sizeof(double);
    static constexpr int parts = n / width;
    Word part[parts];

    LaneMask() = default;
    template <class... Numbers>
    MPM_INLINE explicit LaneMask(Numbers... all) : part{}
    {
        static_assert(sizeof...(Numbers) == n);
        const long long given[n] = {all...};
        for (int i = 0; i < n; ++i)
            part[i / width][i % width] = given[i];
    }
    MPM_INLINE long long operator[](int i) const { return part[i / width][i % width]; }

    friend MPM_INLINE LaneMask operator&(LaneMask a, const LaneMask& b) { return a &= b; }
    friend MPM_INLINE LaneMask operator|(LaneMask a, const LaneMask& b) { return a |= b; }
    MPM_INLINE LaneMask& operator&=(const LaneMask& b)
    {
        for (int p = 0; p < parts; ++p)
            part[p] &= b.part[p];
        return *this;
    }
    MPM_INLINE LaneMask& operator|=(const LaneMask& b)
    {
        for (int p = 0; p < parts; ++p)
            part[p] |= b.part[p];
        return *this;
    }
};

/// n lanes in registers of type Part, a vector of the compiler.
template <int n, class Part>
struct alignas(sizeof(double) * n) LanePack
{
    static constexpr int width = sizeof(Part) / sizeof(double);
    static constexpr int parts = n / width;
    typedef Part Aliasing __attribute__((may_alias));
    typedef Part Anywhere __attribute__((may_alias, aligned(8)));
    Part part[parts];

    LanePack() = default;
    /// Values of the first lanes, at least two; the others are zero.
    template <class... Numbers>
    MPM_INLINE LanePack(double first, double second, Numbers... others) : part{}
    {
        static_assert(sizeof...(Numbers) + 2 <= n);
        const double given[n] = {first, second, double(others)...};
        for (int i = 0; i < n; ++i)
            part[i / width][i % width] = given[i];
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
    /// Lanes in memory at any address.
    MPM_INLINE static LanePack loadAnywhere(const double* from)
    {
        LanePack r;
        for (int p = 0; p < parts; ++p)
            r.part[p] = reinterpret_cast<const Anywhere*>(from)[p];
        return r;
    }
    MPM_INLINE void storeAnywhere(double* to) const
    {
        for (int p = 0; p < parts; ++p)
            reinterpret_cast<Anywhere*>(to)[p] = part[p];
    }
    /// The same number in all lanes.
    MPM_INLINE static LanePack splat(double x)
    {
        LanePack r;
        for (int p = 0; p < parts; ++p)
            r.part[p] = x - Part{}; // not x + 0, which makes 0 of -0
        return r;
    }

    MPM_INLINE double& operator[](std::ptrdiff_t i) { return reinterpret_cast<double*>(part)[i]; }
    MPM_INLINE double operator[](std::ptrdiff_t i) const { return reinterpret_cast<const double*>(part)[i]; }

    MPM_INLINE LanePack operator-() const
    {
        LanePack r;
        for (int p = 0; p < parts; ++p)
            r.part[p] = -part[p];
        return r;
    }
};

/// a op b, lane by lane or with one number for all lanes, and a op= b.
#define MPM_LANE_OPERATOR(op)                                                                                          \
    template <int n, class Part>                                                                                       \
    MPM_INLINE LanePack<n, Part> operator op(const LanePack<n, Part>& a, const LanePack<n, Part>& b)                   \
    {                                                                                                                  \
        LanePack<n, Part> r;                                                                                           \
        for (int p = 0; p < r.parts; ++p)                                                                              \
            r.part[p] = a.part[p] op b.part[p];                                                                        \
        return r;                                                                                                      \
    }                                                                                                                  \
    template <int n, class Part>                                                                                       \
    MPM_INLINE LanePack<n, Part> operator op(double a, const LanePack<n, Part>& b)                                     \
    {                                                                                                                  \
        LanePack<n, Part> r;                                                                                           \
        for (int p = 0; p < r.parts; ++p)                                                                              \
            r.part[p] = a op b.part[p];                                                                                \
        return r;                                                                                                      \
    }                                                                                                                  \
    template <int n, class Part>                                                                                       \
    MPM_INLINE LanePack<n, Part> operator op(const LanePack<n, Part>& a, double b)                                     \
    {                                                                                                                  \
        LanePack<n, Part> r;                                                                                           \
        for (int p = 0; p < r.parts; ++p)                                                                              \
            r.part[p] = a.part[p] op b;                                                                                \
        return r;                                                                                                      \
    }                                                                                                                  \
    template <int n, class Part, class Other>                                                                          \
    MPM_INLINE LanePack<n, Part>& operator op##=(LanePack<n, Part>& a, const Other& b)                                 \
    {                                                                                                                  \
        return a = a op b;                                                                                             \
    }
MPM_LANE_OPERATOR(+)
MPM_LANE_OPERATOR(-)
MPM_LANE_OPERATOR(*)
MPM_LANE_OPERATOR(/)
#undef MPM_LANE_OPERATOR

#define MPM_LANE_COMPARISON(op)                                                                                        \
    template <int n, class Part>                                                                                       \
    MPM_INLINE LaneMask<n, Part> operator op(const LanePack<n, Part>& a, const LanePack<n, Part>& b)                   \
    {                                                                                                                  \
        LaneMask<n, Part> r;                                                                                           \
        for (int p = 0; p < r.parts; ++p)                                                                              \
            r.part[p] = a.part[p] op b.part[p];                                                                        \
        return r;                                                                                                      \
    }
MPM_LANE_COMPARISON(<)
MPM_LANE_COMPARISON(<=)
MPM_LANE_COMPARISON(>)
MPM_LANE_COMPARISON(>=)
MPM_LANE_COMPARISON(==)
MPM_LANE_COMPARISON(!=)
#undef MPM_LANE_COMPARISON

/// a where the mask is set, b elsewhere.
template <int n, class Part>
MPM_INLINE LanePack<n, Part> select(const LaneMask<n, Part>& mask, const LanePack<n, Part>& a,
                                    const LanePack<n, Part>& b)
{
    LanePack<n, Part> r;
    for (int p = 0; p < r.parts; ++p)
        r.part[p] = mask.part[p] ? a.part[p] : b.part[p];
    return r;
}

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

/// Lanes of a (0 .. n - 1) and b (n .. 2n - 1) by number, n or n/2 of them, as __builtin_shufflevector has it.
template <int... from, int n, class Part>
MPM_INLINE auto shuffle(const LanePack<n, Part>& a, const LanePack<n, Part>& b)
{
    constexpr int lanes = sizeof...(from);
    static_assert(lanes == n || 2 * lanes == n);
    if constexpr (lanes == LanePack<n, Part>::width)
        return shufflePart<0, from...>(a, b);
    else
    {
        LanePack<lanes, Part> r;
        [&]<int... p>(std::integer_sequence<int, p...>) __attribute__((always_inline))
        {
            ((r.part[p] = shufflePart<p, from...>(a, b)), ...);
        }
        (std::make_integer_sequence<int, LanePack<lanes, Part>::parts>());
        return r;
    }
}
} // namespace mpm

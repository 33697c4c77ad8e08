#pragma once
/// Eight doubles that travel together: the record of a grid node, one AVX-512 register or one cache line.
/// Written with the vector extension g++ and clang++ share, so that the same source runs on any instruction set.
///
/// Layout of a node record in d dimensions: lane 0 mass, lanes 1..d momentum (later velocity), lanes d+1..2d force
/// (later acceleration, or the velocity strains are taken from). Half a record carries four numbers where no more are
/// needed.
///
/// For kernels only: how such a value is passed between functions depends on the instruction set, so it stays out of
/// the headers utilities include.
namespace mpm
{
typedef double Record __attribute__((vector_size(64)));
typedef double AliasingRecord __attribute__((vector_size(64), may_alias));
typedef double HalfRecord __attribute__((vector_size(32)));
typedef double AliasingHalfRecord __attribute__((vector_size(32), may_alias));
typedef long long Mask __attribute__((vector_size(64))); ///< -1 or 0 in each lane
typedef long long HalfMask __attribute__((vector_size(32)));

/// Before a short loop over nodes or lanes whose values are to stay in registers.
#ifdef __clang__
#define MPM_UNROLL _Pragma("unroll")
#else
#define MPM_UNROLL _Pragma("GCC unroll 16")
#endif

/// The same number in all lanes.
template <class R>
__attribute__((always_inline)) inline R splat(double x)
{
    if constexpr (sizeof(R) == sizeof(Record))
        return R{x, x, x, x, x, x, x, x};
    else
        return R{x, x, x, x};
}

/// Eight doubles of a column that starts on a 64-byte boundary.
__attribute__((always_inline)) inline Record load(const double* p)
{
    return *reinterpret_cast<const AliasingRecord*>(p);
}
__attribute__((always_inline)) inline void store(double* p, const Record& r)
{
    *reinterpret_cast<AliasingRecord*>(p) = r;
}
__attribute__((always_inline)) inline void store(double* p, const HalfRecord& r)
{
    *reinterpret_cast<AliasingHalfRecord*>(p) = r;
}

/// The number a where the mask is set, b elsewhere.
__attribute__((always_inline)) inline Record choose(Mask mask, double a, double b)
{
    return mask ? splat<Record>(a) : splat<Record>(b);
}
__attribute__((always_inline)) inline HalfRecord choose(HalfMask mask, double a, double b)
{
    return mask ? splat<HalfRecord>(a) : splat<HalfRecord>(b);
}

/// Sum of the lanes, always in the same order.
__attribute__((always_inline)) inline double sumOf(const Record& r)
{
    return ((r[0] + r[1]) + (r[2] + r[3])) + ((r[4] + r[5]) + (r[6] + r[7]));
}
/// Lane by lane; a NaN in `a` is passed over.
__attribute__((always_inline)) inline Record largerOf(const Record& a, const Record& b)
{
    return a > b ? a : b;
}
__attribute__((always_inline)) inline Record smallerOf(const Record& a, const Record& b)
{
    return a < b ? a : b;
}

/// Transposes an 8 x 8 block in place: eight records of eight lanes become eight columns and back.
__attribute__((always_inline)) inline void transpose(Record (&r)[8])
{
    Record t[8];
    for (int i = 0; i < 8; i += 2)
    {
        t[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
        t[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
    }
    Record s[8];
    for (int i = 0; i < 8; i += 4)
        for (int k = 0; k < 2; ++k)
        {
            s[i + k] = __builtin_shufflevector(t[i + k], t[i + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
            s[i + k + 2] = __builtin_shufflevector(t[i + k], t[i + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
        }
    for (int k = 0; k < 4; ++k)
    {
        r[k] = __builtin_shufflevector(s[k], s[k + 4], 0, 1, 2, 3, 8, 9, 10, 11);
        r[k + 4] = __builtin_shufflevector(s[k], s[k + 4], 4, 5, 6, 7, 12, 13, 14, 15);
    }
}

/// Transposes a 4 x 4 block in place.
__attribute__((always_inline)) inline void transpose(HalfRecord (&r)[4])
{
    const HalfRecord a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6);
    const HalfRecord b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
    const HalfRecord c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
    const HalfRecord d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
    r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}
} // namespace mpm

#pragma once
/// Eight doubles that travel together: the record of a grid node, one AVX-512 register or one cache line.
/// Written with the vector extension g++ and clang++ share, so that the same source runs on any instruction set; where
/// registers are narrower, a record is a row of them (base/lanePack.hpp).
///
/// Layout of a node record in d dimensions: lane 0 mass, lanes 1..d momentum (later velocity), lanes d+1..2d force
/// (later acceleration, or the velocity strains are taken from). Half a record carries four numbers where no more are
/// needed.
///
/// For kernels only: how such a value is passed between functions depends on the instruction set, so it stays out of
/// the headers utilities include.
#include "base/lanePack.hpp"

#include <type_traits>

namespace mpm
{
typedef double Lanes2 __attribute__((vector_size(16)));
typedef double Lanes4 __attribute__((vector_size(32)));
typedef double Lanes8 __attribute__((vector_size(64)));
#if defined(__AVX512F__)
using Record = Lanes8;
using HalfRecord = Lanes4;
#elif defined(__AVX__)
using Record = LanePack<8, Lanes4>;
using HalfRecord = Lanes4;
#else
using Record = LanePack<8, Lanes2>;
using HalfRecord = LanePack<4, Lanes2>;
#endif
static_assert(sizeof(Record) == 64 && alignof(Record) == 64 && sizeof(HalfRecord) == 32 && alignof(HalfRecord) == 32);
using Mask = decltype(Record{} < Record{}); ///< -1 or 0 in each lane
using HalfMask = decltype(HalfRecord{} < HalfRecord{});

/// Before a short loop over nodes or lanes whose values are to stay in registers.
#ifdef __clang__
#define MPM_UNROLL _Pragma("unroll")
#else
#define MPM_UNROLL _Pragma("GCC unroll 16")
#endif

/// Lanes of a (0 .. n - 1) and b (n .. 2n - 1) by number; four lanes of records make half a record.
template <int... from>
MPM_INLINE auto shuffle(const Lanes8& a, const Lanes8& b)
{
    return __builtin_shufflevector(a, b, from...);
}
template <int... from>
MPM_INLINE Lanes4 shuffle(const Lanes4& a, const Lanes4& b)
{
    return __builtin_shufflevector(a, b, from...);
}

/// The same number in all lanes; kernels may be written for one lane, too.
template <class R>
MPM_INLINE R splat(double x)
{
    if constexpr (std::is_same_v<R, double>)
        return x;
    else if constexpr (std::is_class_v<R>)
        return R::splat(x);
    else if constexpr (sizeof(R) == sizeof(Lanes8))
        return R{x, x, x, x, x, x, x, x};
    else
        return R{x, x, x, x};
}

/// The same address, of which the compiler no longer knows how it was made. Left to itself g++ addresses each of the 9
/// or 27 nodes of a support from the window's start and spends more on that than on the arithmetic.
template <class T>
MPM_INLINE T* opaque(T* address)
{
    asm("" : "+r"(address));
    return address;
}

/// The same number, in a register from here on: g++ would rather load it again for every use.
template <class R>
MPM_INLINE R inRegister(R r)
{
    if constexpr (!std::is_class_v<R>)
        asm("" : "+v"(r));
    return r;
}

/// Two halves of a record.
MPM_INLINE Record join(const HalfRecord& low, const HalfRecord& high)
{
#if defined(__AVX512F__)
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#else
    Record r;
    constexpr int parts = sizeof(HalfRecord) / sizeof(r.part[0]);
    for (int p = 0; p < parts; ++p)
    {
        r.part[p] = reinterpret_cast<std::add_pointer_t<const std::remove_reference_t<decltype(r.part[0])>>>(&low)[p];
        r.part[parts + p] =
            reinterpret_cast<std::add_pointer_t<const std::remove_reference_t<decltype(r.part[0])>>>(&high)[p];
    }
    return r;
#endif
}

/// Eight (four) doubles of a column, at an address that is a multiple of 64 (32) bytes.
template <class R>
MPM_INLINE R loadAs(const double* p)
{
    if constexpr (std::is_class_v<R>)
        return R::load(p);
    else
    {
        typedef R Aliasing __attribute__((may_alias));
        return *reinterpret_cast<const Aliasing*>(p);
    }
}
template <class R>
MPM_INLINE void storeAs(double* p, const R& r)
{
    if constexpr (std::is_class_v<R>)
        r.store(p);
    else
    {
        typedef R Aliasing __attribute__((may_alias));
        *reinterpret_cast<Aliasing*>(p) = r;
    }
}
/// The same at any address.
MPM_INLINE Record loadAnywhere(const double* p)
{
#if defined(__AVX512F__)
    typedef Record Anywhere __attribute__((may_alias, aligned(8)));
    return *reinterpret_cast<const Anywhere*>(p);
#else
    return Record::loadAnywhere(p);
#endif
}
MPM_INLINE void storeAnywhere(double* p, const Record& r)
{
#if defined(__AVX512F__)
    typedef Record Anywhere __attribute__((may_alias, aligned(8)));
    *reinterpret_cast<Anywhere*>(p) = r;
#else
    r.storeAnywhere(p);
#endif
}
MPM_INLINE Record load(const double* p)
{
    return loadAs<Record>(p);
}
MPM_INLINE void store(double* p, const Record& r)
{
    storeAs(p, r);
}
MPM_INLINE void store(double* p, const HalfRecord& r)
{
    storeAs(p, r);
}

/// The same place, a multiple of a register's lanes, in several columns of one chunk.
template <class R, int n, int length>
MPM_INLINE void loadRow(const double (&columns)[n][length], int at, R (&row)[n])
{
    MPM_UNROLL
    for (int k = 0; k < n; ++k)
        row[k] = loadAs<R>(columns[k] + at);
}
template <class R, int n, int length>
MPM_INLINE void storeRow(double (&columns)[n][length], int at, const R (&row)[n])
{
    MPM_UNROLL
    for (int k = 0; k < n; ++k)
        storeAs(columns[k] + at, row[k]);
}

/// Lane by lane: a where the mask is set, b elsewhere.
template <class M, class R>
requires(!std::is_class_v<R>) MPM_INLINE R select(const M& mask, const R& a, const R& b)
{
    return mask ? a : b;
}
MPM_INLINE double select(bool mask, double a, double b)
{
    return mask ? a : b;
}
/// The number a where the mask is set, b elsewhere.
MPM_INLINE Record choose(const Mask& mask, double a, double b)
{
    return select(mask, splat<Record>(a), splat<Record>(b));
}
MPM_INLINE HalfRecord choose(const HalfMask& mask, double a, double b)
{
    return select(mask, splat<HalfRecord>(a), splat<HalfRecord>(b));
}

/// Sum of the lanes, always in the same order.
MPM_INLINE double sumOf(const Record& r)
{
    return ((r[0] + r[1]) + (r[2] + r[3])) + ((r[4] + r[5]) + (r[6] + r[7]));
}
/// The largest of the lanes; a NaN may hide others.
MPM_INLINE double largestOf(const Record& r)
{
    double most = r[0];
    for (int l = 1; l < 8; ++l)
        most = r[l] > most ? r[l] : most;
    return most;
}
MPM_INLINE double smallestOf(const Record& r)
{
    return -largestOf(-r);
}
/// Is the mask set in all lanes?
MPM_INLINE bool allOf(const Mask& mask)
{
    bool all = true;
    for (int l = 0; l < 8; ++l)
        all = all && mask[l];
    return all;
}
/// Lane by lane; a NaN in `a` is passed over.
MPM_INLINE Record largerOf(const Record& a, const Record& b)
{
    return select(a > b, a, b);
}
MPM_INLINE Record smallerOf(const Record& a, const Record& b)
{
    return select(a < b, a, b);
}

/// Transposes an 8 x 8 block in place: eight records of eight lanes become eight columns and back.
MPM_INLINE void transpose(Record (&r)[8])
{
    Record t[8];
    for (int i = 0; i < 8; i += 2)
    {
        t[i] = shuffle<0, 8, 2, 10, 4, 12, 6, 14>(r[i], r[i + 1]);
        t[i + 1] = shuffle<1, 9, 3, 11, 5, 13, 7, 15>(r[i], r[i + 1]);
    }
    Record s[8];
    for (int i = 0; i < 8; i += 4)
        for (int k = 0; k < 2; ++k)
        {
            s[i + k] = shuffle<0, 1, 8, 9, 4, 5, 12, 13>(t[i + k], t[i + k + 2]);
            s[i + k + 2] = shuffle<2, 3, 10, 11, 6, 7, 14, 15>(t[i + k], t[i + k + 2]);
        }
    for (int k = 0; k < 4; ++k)
    {
        r[k] = shuffle<0, 1, 2, 3, 8, 9, 10, 11>(s[k], s[k + 4]);
        r[k + 4] = shuffle<4, 5, 6, 7, 12, 13, 14, 15>(s[k], s[k + 4]);
    }
}

/// Transposes a 4 x 4 block in place.
MPM_INLINE void transpose(HalfRecord (&r)[4])
{
    const HalfRecord a = shuffle<0, 4, 2, 6>(r[0], r[1]), b = shuffle<1, 5, 3, 7>(r[0], r[1]);
    const HalfRecord c = shuffle<0, 4, 2, 6>(r[2], r[3]), d = shuffle<1, 5, 3, 7>(r[2], r[3]);
    r[0] = shuffle<0, 1, 4, 5>(a, c);
    r[1] = shuffle<0, 1, 4, 5>(b, d);
    r[2] = shuffle<2, 3, 6, 7>(a, c);
    r[3] = shuffle<2, 3, 6, 7>(b, d);
}
} // namespace mpm

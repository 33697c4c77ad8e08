#pragma once
/// Eight doubles that travel together: the record of a grid node, one AVX-512 register or one cache line.
/// Written with the vector extension g++ and clang++ share, so that the same source runs on any instruction set.
///
/// Layout of a node record in d dimensions: lane 0 mass, lanes 1..d momentum (later velocity), lanes d+1..2d force
/// (later acceleration, or the velocity strains are taken from).
///
/// For kernels only: how such a value is passed between functions depends on the instruction set, so it stays out of
/// the headers utilities include.
namespace mpm
{
typedef double Record __attribute__((vector_size(64)));
typedef double AliasingRecord __attribute__((vector_size(64), may_alias));

/// Eight doubles of a column that starts on a 64-byte boundary.
__attribute__((always_inline)) inline Record load(const double* p)
{
    return *reinterpret_cast<const AliasingRecord*>(p);
}
__attribute__((always_inline)) inline void store(double* p, const Record& r)
{
    *reinterpret_cast<AliasingRecord*>(p) = r;
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
} // namespace mpm

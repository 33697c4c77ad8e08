#pragma once
/// std::vector on 64-byte boundaries (one cache line, one AVX-512 register). Large arrays do not all start at the same
/// place of a memory page: columns that are read side by side would otherwise compete for the same sets of the cache.
/// Arrays of 64 KB and more lie in huge pages, small ones of them side by side in regions that stay with the process.
/// Verified in tests/unit/alignedVector.cpp.
#include <cstddef>
#include <vector>

namespace mpm
{
/// Memory on a 64-byte boundary; throws std::bad_alloc.
void* allocateAligned(std::size_t bytes);
void freeAligned(void* memory) noexcept;
/// Gives the memory of freed arrays back to the system, which costs their pages when they are wanted again.
void trimAligned();

template <class T>
struct AlignedAllocator
{
    using value_type = T;
    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&)
    {}
    T* allocate(std::size_t n) { return static_cast<T*>(allocateAligned(n * sizeof(T))); }
    void deallocate(T* p, std::size_t) { freeAligned(p); }
    template <class U>
    bool operator==(const AlignedAllocator<U>&) const
    {
        return true;
    }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;
} // namespace mpm

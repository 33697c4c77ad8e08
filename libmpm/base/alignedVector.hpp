#pragma once
/// std::vector on 64-byte boundaries (one cache line, one AVX-512 register).
#include <cstddef>
#include <new>
#include <vector>

namespace mpm
{
template <class T>
struct AlignedAllocator
{
    using value_type = T;
    AlignedAllocator() = default;
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>&)
    {}
    T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64})); }
    void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
    template <class U>
    bool operator==(const AlignedAllocator<U>&) const
    {
        return true;
    }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;
} // namespace mpm

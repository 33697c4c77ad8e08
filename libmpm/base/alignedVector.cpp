#include "base/alignedVector.hpp"

#include <atomic>
#include <cstdlib>
#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace mpm
{
namespace
{
constexpr std::size_t line = 64, page = 4096, hugePage = std::size_t(1) << 21;

/// Where the block itself begins, kept in the line before the memory handed out.
struct Header
{
    void* block;
};
} // namespace

void* allocateAligned(std::size_t bytes)
{
    static std::atomic<std::size_t> count{0};
    // steps of 9 lines visit all 64 lines of a page; small arrays are not worth it
    const std::size_t shift = bytes < page ? line : line * (1 + count++ * 9 % (page / line));
    const std::size_t alignment = bytes < 4 * hugePage ? line : hugePage;
    const std::size_t whole = (bytes + shift + alignment - 1) / alignment * alignment;
    void* block = std::aligned_alloc(alignment, whole);
    if (!block)
        throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    if (alignment == hugePage)
        madvise(block, whole, MADV_HUGEPAGE); // fewer misses of the page table; a wish, not a need
#endif
    char* memory = static_cast<char*>(block) + shift;
    reinterpret_cast<Header*>(memory - line)->block = block;
    return memory;
}

void freeAligned(void* memory) noexcept
{
    if (memory)
        std::free(reinterpret_cast<Header*>(static_cast<char*>(memory) - line)->block);
}
} // namespace mpm

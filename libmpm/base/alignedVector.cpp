#include "base/alignedVector.hpp"

#include <atomic>
#include <cstdlib>
#include <map>
#include <mutex>
#include <new>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace mpm
{
namespace
{
constexpr std::size_t line = 64, page = 4096, hugePage = std::size_t(1) << 21;

/// A step reads thirty columns side by side; with pages of 4 KB each of them costs a look in the page table every 512
/// particles. Huge pages are a wish: without them everything works, some 10 % slower.
char* allocateHuge(std::size_t bytes)
{
    const std::size_t whole = (bytes + hugePage - 1) / hugePage * hugePage;
    auto* block = static_cast<char*>(std::aligned_alloc(hugePage, whole));
    if (!block)
        throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    madvise(block, whole, MADV_HUGEPAGE);
#endif
    return block;
}

/// Columns too small for huge pages of their own share regions of them. Freed pieces are used again; regions stay for
/// the life of the process.
class Pool
{
  public:
    static constexpr std::size_t smallest = 16 * page, largest = 4 * hugePage, region = 8 * largest;

    char* allocate(std::size_t bytes) // a multiple of the page
    {
        const std::lock_guard lock(mutex_);
        auto piece = free_.begin();
        while (piece != free_.end() && piece->second < bytes)
            ++piece;
        if (piece == free_.end())
            piece = free_.emplace(allocateHuge(region), region).first;
        const auto [begin, size] = *piece;
        free_.erase(piece);
        if (size > bytes)
            free_.emplace(begin + bytes, size - bytes);
        return begin;
    }

    void free(char* begin, std::size_t bytes)
    {
        const std::lock_guard lock(mutex_);
        auto next = free_.lower_bound(begin);
        if (next != free_.end() && begin + bytes == next->first)
        {
            bytes += next->second;
            next = free_.erase(next);
        }
        if (next != free_.begin())
        {
            const auto before = std::prev(next);
            if (before->first + before->second == begin)
            {
                before->second += bytes;
                return;
            }
        }
        free_.emplace(begin, bytes);
    }

    void trim()
    {
#ifdef MADV_DONTNEED
        const std::lock_guard lock(mutex_);
        for (const auto& [begin, size] : free_)
            madvise(begin, size, MADV_DONTNEED);
#endif
    }

  private:
    std::mutex mutex_;
    std::map<char*, std::size_t> free_; ///< pieces by address
};

Pool& pool()
{
    static Pool& all = *new Pool; // outlives every static column
    return all;
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool pooling = false; // a sanitizer looks at every array by itself
#else
constexpr bool pooling = true;
#endif

/// Kept in the line before the memory handed out.
struct Header
{
    char* block;
    std::size_t pooled; ///< size of the block if it is a piece of the pool, else 0
};
} // namespace

void* allocateAligned(std::size_t bytes)
{
    static std::atomic<std::size_t> count{0};
    // steps of 9 lines visit all 64 lines of a page; small arrays are not worth it
    const std::size_t shift = bytes < page ? line : line * (1 + count++ * 9 % (page / line));
    Header header{nullptr, 0};
    if (bytes >= Pool::largest)
        header.block = allocateHuge(bytes + shift);
    else if (pooling && bytes >= Pool::smallest)
    {
        header.pooled = (bytes + shift + page - 1) / page * page;
        header.block = pool().allocate(header.pooled);
    }
    else
    {
        header.block = static_cast<char*>(std::aligned_alloc(line, (bytes + shift + line - 1) / line * line));
        if (!header.block)
            throw std::bad_alloc();
    }
    char* memory = header.block + shift;
    *reinterpret_cast<Header*>(memory - line) = header;
    return memory;
}

void trimAligned()
{
    pool().trim();
}

void freeAligned(void* memory) noexcept
{
    if (!memory)
        return;
    const Header header = *reinterpret_cast<Header*>(static_cast<char*>(memory) - line);
    if (header.pooled)
        pool().free(header.block, header.pooled);
    else
        std::free(header.block);
}
} // namespace mpm

// Bytes as a state.h5. HDF5's checksums are set right after each mutation, or almost nothing would get past them.
#include "fuzz/fuzzing.hpp"
#include "output/stateFile.hpp"

#include <cstring>

using namespace mpm;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

namespace
{
std::uint32_t rotated(std::uint32_t x, int k)
{
    return (x << k) | (x >> (32 - k));
}

/// Bob Jenkins' lookup3 (hashlittle, initial value 0; public domain, 2006), HDF5's checksum of metadata.
std::uint32_t lookup3(const std::uint8_t* k, std::size_t length)
{
    std::uint32_t a = 0xdeadbeef + std::uint32_t(length), b = a, c = a;
    const auto word = [&](std::size_t at, std::size_t n) {
        std::uint32_t w = 0;
        for (std::size_t i = 0; i < 4 && at + i < n; ++i)
            w += std::uint32_t(k[at + i]) << (8 * i);
        return w;
    };
    for (; length > 12; length -= 12, k += 12)
    {
        a += word(0, 12), b += word(4, 12), c += word(8, 12);
        a -= c, a ^= rotated(c, 4), c += b;
        b -= a, b ^= rotated(a, 6), a += c;
        c -= b, c ^= rotated(b, 8), b += a;
        a -= c, a ^= rotated(c, 16), c += b;
        b -= a, b ^= rotated(a, 19), a += c;
        c -= b, c ^= rotated(b, 4), b += a;
    }
    if (length == 0)
        return c;
    a += word(0, length), b += word(4, length), c += word(8, length);
    c ^= b, c -= rotated(b, 14);
    a ^= c, a -= rotated(c, 11);
    b ^= a, b -= rotated(a, 25);
    c ^= b, c -= rotated(b, 16);
    a ^= c, a -= rotated(c, 4);
    b ^= a, b -= rotated(a, 14);
    c ^= b, c -= rotated(b, 24);
    return c;
}

void seal(std::uint8_t* data, std::size_t size, std::size_t begin, std::size_t length)
{
    if (begin + length + 4 > size)
        return;
    const std::uint32_t sum = lookup3(data + begin, length);
    for (std::size_t i = 0; i < 4; ++i)
        data[begin + length + i] = std::uint8_t(sum >> (8 * i));
}

/// HDF5 File Format Specification 3.0: superblock version 2 (II.B), object header version 2 (IV.A.1.b).
void sealAll(std::uint8_t* data, std::size_t size)
{
    seal(data, size, 0, 44);
    for (std::size_t at = 0; at + 16 < size; ++at)
        if (std::memcmp(data + at, "OHDR", 4) == 0)
        {
            const unsigned flags = data[at + 5];
            const std::size_t head = 6 + (flags & 0x20 ? 16u : 0u) + (flags & 0x10 ? 4u : 0u),
                              width = 1u << (flags & 3);
            std::size_t chunk = 0;
            for (std::size_t i = 0; i < width && at + head + i < size; ++i)
                chunk += std::size_t(data[at + head + i]) << (8 * i);
            if (chunk < size)
                seal(data, size, at, head + width + chunk);
        }
}
} // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize, unsigned seed)
{
    const std::size_t now = LLVMFuzzerMutate(data, size, maxSize);
    if (seed % 8 != 0)
        sealAll(data, now);
    return now;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::Folder folder;
    const auto file = folder.write("state.h5", std::string(reinterpret_cast<const char*>(data), size));
    fuzz::accepted([&] { output::readSummary(file); });
    fuzz::accepted([&] {
        const state::State state = output::readState(file);
        output::requireValid(state, file.string());
        fuzz::require(std::uint64_t(state.particles.size()) * 8 <= size, "no more particles than the file can hold");
    });
    return 0;
}

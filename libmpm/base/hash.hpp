#pragma once
/// FNV-1a in 64 bits (G. Fowler, L. C. Noll & K.-P. Vo; RFC 9923): tells whether bytes have changed, and keeps no
/// secret.
#include <cstdint>
#include <string_view>

namespace mpm
{
/// Goes on from `from`, the hash of what came before.
inline std::uint64_t hashOf(std::string_view bytes, std::uint64_t from = 0xcbf29ce484222325u)
{
    for (const char c : bytes)
        from = (from ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return from;
}
} // namespace mpm

#pragma once
/// Numbers into bytes and back, for snapshots that stay on one kind of machine. CouplingError (badState) where bytes
/// end before they should.
#include "coupling/couplingError.hpp"

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace mpm::coupling
{
inline void putBytes(std::vector<std::byte>& out, const void* from, std::size_t size)
{
    const std::size_t at = out.size();
    out.resize(at + size);
    if (size > 0)
        std::memcpy(out.data() + at, from, size);
}

template <class T>
void putBytes(std::vector<std::byte>& out, const T& value)
{
    static_assert(std::is_trivially_copyable_v<T>);
    putBytes(out, &value, sizeof value);
}

template <class T>
T takeBytes(std::span<const std::byte>& bytes)
{
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes.size() < sizeof(T))
        throw CouplingError(Fault::badState, "found the end of the bytes within a saved surface");
    T value;
    std::memcpy(&value, bytes.data(), sizeof value);
    bytes = bytes.subspan(sizeof value);
    return value;
}

inline void putBytes(std::vector<std::byte>& out, const std::vector<double>& values)
{
    putBytes(out, std::uint64_t(values.size()));
    putBytes(out, values.data(), values.size() * sizeof(double));
}

inline std::vector<double> takeDoubles(std::span<const std::byte>& bytes)
{
    const auto count = takeBytes<std::uint64_t>(bytes);
    if (count > bytes.size() / sizeof(double)) // before anything of that size is made
        throw CouplingError(Fault::badState, "found the end of the bytes within a saved surface");
    std::vector<double> values(count);
    if (count > 0)
        std::memcpy(values.data(), bytes.data(), count * sizeof(double));
    bytes = bytes.subspan(count * sizeof(double));
    return values;
}
} // namespace mpm::coupling

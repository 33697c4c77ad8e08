#pragma once
/// What stands between the calls of mpm.h and C++: arguments are checked, exceptions become a status and a text.
#include "capi/mpm.h"
#include "coupling/couplingError.hpp"

#include <string>
#include <type_traits>

namespace mpm::capi
{
/// The text of mpm_last_error(), cut where the thread's buffer ends.
void say(const char* text) noexcept;
const char* said() noexcept;

/// What only the C interface can find wrong.
struct Refusal
{
    mpm_status status;
    std::string text;
};

mpm_status statusOf(coupling::Fault fault);
/// Status and text of the exception that is being handled.
mpm_status caught() noexcept;

/// Runs a call; it may return a status, or nothing where it went well.
template <class Call>
mpm_status guarded(Call&& call) noexcept
{
    say("");
    try
    {
        if constexpr (std::is_void_v<std::invoke_result_t<Call>>)
            call();
        else
            return call();
        return MPM_OK;
    }
    catch (...)
    {
        return caught();
    }
}

template <class T>
T* required(T* pointer, const char* name)
{
    if (!pointer)
        throw Refusal{MPM_NULL_ARGUMENT, std::string("nullArgument: ") + name + " is null"};
    return pointer;
}

/// An array that may only be null where it is empty.
template <class T>
T* array(T* pointer, std::size_t count, const char* name)
{
    if (count > std::size_t(PTRDIFF_MAX) / sizeof(T))
        throw Refusal{MPM_WRONG_SIZE, std::string("wrongSize: no ") + name + " can have " + std::to_string(count)};
    return count ? required(pointer, name) : pointer;
}

/// An enumerator of mpm.h, from 0 to `last`, as one of C++.
template <class Enum>
Enum enumerator(std::int32_t value, Enum last, const char* name)
{
    if (value < 0 || value > std::int32_t(last))
        throw Refusal{MPM_BAD_VALUE, std::string("badValue: ") + name + " is " + std::to_string(value) +
                                         ", allowed are 0 to " + std::to_string(std::int32_t(last))};
    return Enum(value);
}

/// The two calls for what has a length of its own: how long it is, and a copy if there is room.
template <class T>
void deliver(const T* data, std::size_t length, T* out, std::size_t capacity, std::size_t* count)
{
    required(count, "count");
    *count = length;
    if (capacity == 0)
        return;
    required(out, "the buffer");
    if (capacity < length)
        throw Refusal{MPM_BUFFER_TOO_SMALL,
                      "bufferTooSmall: found " + std::to_string(capacity) + ", it takes " + std::to_string(length)};
    for (std::size_t i = 0; i < length; ++i)
        out[i] = data[i];
}
} // namespace mpm::capi

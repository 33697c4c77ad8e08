#include "capi/guard.hpp"
#include "base/error.hpp"

#include <cstring>
#include <filesystem>
#include <new>

namespace mpm::capi
{
namespace
{
// No text that grows: saying that there is no memory must not take any. Long enough for a path and a list of words.
thread_local char lastError[4096];

struct StatusWord
{
    mpm_status status;
    const char* word;
};

/// Those that are no Fault.
constexpr StatusWord ownWords[] = {{MPM_OK, "ok"},
                                   {MPM_INPUT, "input"},
                                   {MPM_DISCARDED, "discarded"},
                                   {MPM_NULL_ARGUMENT, "nullArgument"},
                                   {MPM_BUFFER_TOO_SMALL, "bufferTooSmall"},
                                   {MPM_BAD_HANDLE, "badHandle"},
                                   {MPM_BUSY, "busy"},
                                   {MPM_OUT_OF_MEMORY, "outOfMemory"},
                                   {MPM_INTERNAL, "internal"}};

mpm_status failed(mpm_status status, const char* text) noexcept
{
    say(text);
    return status;
}
} // namespace

void say(const char* text) noexcept
{
    std::size_t length = std::strlen(text);
    if (length >= sizeof(lastError))
    {
        length = sizeof(lastError) - 1;
        while (length > 0 && (text[length] & 0xC0) == 0x80) // not within a character of UTF-8
            --length;
    }
    std::memmove(lastError, text, length);
    lastError[length] = 0;
}

const char* said() noexcept
{
    return lastError;
}

mpm_status statusOf(coupling::Fault fault)
{
    using coupling::Fault;
    static_assert(int(Fault::callOrder) + 1 == MPM_CALL_ORDER &&
                  int(Fault::unknownSurface) + 1 == MPM_UNKNOWN_SURFACE &&
                  int(Fault::unknownField) + 1 == MPM_UNKNOWN_FIELD && int(Fault::wrongSize) + 1 == MPM_WRONG_SIZE &&
                  int(Fault::notFinite) + 1 == MPM_NOT_FINITE && int(Fault::badValue) + 1 == MPM_BAD_VALUE &&
                  int(Fault::badWindow) + 1 == MPM_BAD_WINDOW && int(Fault::badSurface) + 1 == MPM_BAD_SURFACE &&
                  int(Fault::jump) + 1 == MPM_JUMP && int(Fault::badState) + 1 == MPM_BAD_STATE &&
                  int(Fault::files) + 1 == MPM_FILES);
    return mpm_status(fault) + 1;
}

mpm_status caught() noexcept
{
    try
    {
        throw;
    }
    catch (const Refusal& refusal)
    {
        return failed(refusal.status, refusal.text.c_str());
    }
    catch (const coupling::CouplingError& error)
    {
        return failed(statusOf(error.fault()), error.what());
    }
    catch (const InputError& error)
    {
        return failed(MPM_INPUT, error.what());
    }
    catch (const StepError& error)
    {
        return failed(MPM_DISCARDED, error.what());
    }
    catch (const std::filesystem::filesystem_error& error)
    {
        return failed(MPM_FILES, error.what());
    }
    catch (const std::bad_alloc&)
    {
        return failed(MPM_OUT_OF_MEMORY, "outOfMemory: there is not enough memory");
    }
    catch (const std::exception& error)
    {
        return failed(MPM_INTERNAL, error.what());
    }
    catch (...)
    {
        return failed(MPM_INTERNAL, "internal: an unknown exception");
    }
}
} // namespace mpm::capi

extern "C" const char* mpm_last_error(void)
{
    return mpm::capi::said();
}

extern "C" const char* mpm_status_word(mpm_status status)
{
    if (status >= MPM_CALL_ORDER && status <= MPM_FILES)
        return mpm::coupling::faultName(mpm::coupling::Fault(status - 1));
    for (const auto& [number, word] : mpm::capi::ownWords)
        if (number == status)
            return word;
    return "unknown";
}

#pragma once
/// What every function of the C interface does around its work: no exception crosses, every refusal is logged.
#include "base/error.hpp"
#include "fmi/fmuInstance.hpp"

#include <exception>
#include <new>

namespace mpm::fmi
{
template <class Work>
fmi3Status guarded(fmi3Instance handle, const char* function, const Work& work)
{
    auto* instance = static_cast<Instance*>(handle);
    if (!instance)
        return fmi3Error;
    fmi3Status status = fmi3Error;
    try
    {
        try
        {
            work(*instance);
            return fmi3OK;
        }
        catch (const Refusal& refusal)
        {
            status = refusal.status();
            instance->log()(status, std::string(function) + ": " + refusal.what());
        }
        catch (const std::exception& error)
        {
            instance->log()(status, std::string(function) + ": " + error.what());
        }
    }
    catch (...) // no memory for the message
    {}
    return status;
}

/// Arrays of the importer: none of them may be null unless it is empty.
template <class T>
std::span<T> arrayOf(T* first, std::size_t size, const char* name)
{
    if (!first && size > 0)
        throw Refusal(std::string("found NULL for ") + name);
    return {first, size};
}

template <class T>
T& required(T* pointer, const char* name)
{
    if (!pointer)
        throw Refusal(std::string("found NULL for ") + name);
    return *pointer;
}
} // namespace mpm::fmi

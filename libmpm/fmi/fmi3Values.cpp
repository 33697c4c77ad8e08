// The functions of FMI 3.0 that read and set variables. There are Float64, Int64 and String; of the other types there
// is nothing to be asked for.
#include "fmi/fmi3Functions.h"
#include "fmi/guarded.hpp"

#include <cmath>

using namespace mpm::fmi;

namespace
{
fmi3Status noneOf(fmi3Instance instance, const char* function, size_t nReferences)
{
    return guarded(instance, function, [&](Instance&) {
        if (nReferences > 0)
            throw Refusal("the FMU has variables of the types Float64, Int64 and String only");
    });
}
} // namespace

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[], size_t nReferences,
                          fmi3Float64 values[], size_t nValues)
{
    return guarded(instance, "fmi3GetFloat64", [&](Instance& own) {
        own.get(arrayOf(references, nReferences, "valueReferences"), Type::float64, arrayOf(values, nValues, "values"));
    });
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[], size_t nReferences,
                          const fmi3Float64 values[], size_t nValues)
{
    return guarded(instance, "fmi3SetFloat64", [&](Instance& own) {
        own.set(arrayOf(references, nReferences, "valueReferences"), Type::float64, arrayOf(values, nValues, "values"));
    });
}

fmi3Status fmi3GetInt64(fmi3Instance instance, const fmi3ValueReference references[], size_t nReferences,
                        fmi3Int64 values[], size_t nValues)
{
    return guarded(instance, "fmi3GetInt64", [&](Instance& own) {
        const auto out = arrayOf(values, nValues, "values");
        std::vector<double> numbers(nValues);
        own.get(arrayOf(references, nReferences, "valueReferences"), Type::int64, numbers);
        std::transform(numbers.begin(), numbers.end(), out.begin(),
                       [](double n) { return fmi3Int64(std::llround(n)); });
    });
}

fmi3Status fmi3SetInt64(fmi3Instance instance, const fmi3ValueReference references[], size_t nReferences,
                        const fmi3Int64 values[], size_t nValues)
{
    return guarded(instance, "fmi3SetInt64", [&](Instance& own) {
        const auto in = arrayOf(values, nValues, "values");
        own.set(arrayOf(references, nReferences, "valueReferences"), Type::int64,
                std::vector<double>(in.begin(), in.end()));
    });
}

fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference references[], size_t nReferences,
                         fmi3String values[], size_t nValues)
{
    return guarded(instance, "fmi3GetString", [&](Instance& own) {
        const auto which = arrayOf(references, nReferences, "valueReferences");
        const auto out = arrayOf(values, nValues, "values");
        if (which.size() != out.size())
            throw Refusal("found room for another number of texts than there are value references");
        for (size_t i = 0; i < which.size(); ++i)
            out[i] = own.getText(which[i]).c_str();
    });
}

fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference references[], size_t nReferences,
                         const fmi3String values[], size_t nValues)
{
    return guarded(instance, "fmi3SetString", [&](Instance& own) {
        const auto which = arrayOf(references, nReferences, "valueReferences");
        const auto in = arrayOf(values, nValues, "values");
        if (which.size() != in.size())
            throw Refusal("found another number of texts than of value references");
        for (size_t i = 0; i < which.size(); ++i)
            own.setText(which[i], &required(in[i], "a text"));
    });
}

// One line a type without variables.
#define MPM_NO_VARIABLES(NAME)                                                                                         \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, const fmi3ValueReference[], size_t nReferences, fmi3##NAME[],      \
                             size_t)                                                                                   \
    {                                                                                                                  \
        return noneOf(instance, "fmi3Get" #NAME, nReferences);                                                         \
    }                                                                                                                  \
    fmi3Status fmi3Set##NAME(fmi3Instance instance, const fmi3ValueReference[], size_t nReferences,                    \
                             const fmi3##NAME[], size_t)                                                               \
    {                                                                                                                  \
        return noneOf(instance, "fmi3Set" #NAME, nReferences);                                                         \
    }
MPM_NO_VARIABLES(Float32)
MPM_NO_VARIABLES(Int8)
MPM_NO_VARIABLES(UInt8)
MPM_NO_VARIABLES(Int16)
MPM_NO_VARIABLES(UInt16)
MPM_NO_VARIABLES(Int32)
MPM_NO_VARIABLES(UInt32)
MPM_NO_VARIABLES(UInt64)
MPM_NO_VARIABLES(Boolean)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference[], size_t nReferences, size_t[], fmi3Binary[],
                         size_t)
{
    return noneOf(instance, "fmi3GetBinary", nReferences);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference[], size_t nReferences, const size_t[],
                         const fmi3Binary[], size_t)
{
    return noneOf(instance, "fmi3SetBinary", nReferences);
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference[], size_t nReferences, fmi3Clock[])
{
    return noneOf(instance, "fmi3GetClock", nReferences);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference[], size_t nReferences, const fmi3Clock[])
{
    return noneOf(instance, "fmi3SetClock", nReferences);
}

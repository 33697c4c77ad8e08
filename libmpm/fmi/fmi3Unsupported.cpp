// The functions of FMI 3.0 that serve what this FMU does not offer, and modelDescription.xml says so: other kinds of
// simulation, events and clocks, derivatives, dependencies of single elements. They answer fmi3Error with the reason.
#include "fmi/fmi3Functions.h"
#include "fmi/guarded.hpp"

using namespace mpm::fmi;

namespace
{
constexpr const char* modelExchange = "the FMU is for Co-Simulation, not for Model Exchange";
constexpr const char* scheduled = "the FMU is for Co-Simulation, not for Scheduled Execution";
constexpr const char* events = "the FMU has no Event Mode (hasEventMode false)";
constexpr const char* clocks = "the FMU has no clocks";
constexpr const char* structure = "the FMU has no structural parameters";
constexpr const char* derivatives = "the FMU has no partial derivatives";
constexpr const char* outputDerivatives = "the FMU has no derivatives of outputs (maxOutputDerivativeOrder 0)";
constexpr const char* elements =
    "the FMU has no dependencies of single elements (providesPerElementDependencies false)";

fmi3Status refuse(fmi3Instance instance, const char* function, const char* why)
{
    return guarded(instance, function, [&](Instance&) { throw Refusal(why); });
}

fmi3Instance refuseInstance(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logMessage, const char* why)
{
    try
    {
        Log(logMessage, environment, true)(fmi3Error, why);
    }
    catch (...)
    {}
    return nullptr;
}
} // namespace

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                          fmi3InstanceEnvironment environment, fmi3LogMessageCallback logMessage)
{
    return refuseInstance(environment, logMessage, modelExchange);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                               fmi3InstanceEnvironment environment, fmi3LogMessageCallback logMessage,
                                               fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback)
{
    return refuseInstance(environment, logMessage, scheduled);
}

// MPM_REFUSED(name, why, further arguments...)
#define MPM_REFUSED(NAME, WHY, ...)                                                                                    \
    fmi3Status NAME(fmi3Instance instance __VA_OPT__(, ) __VA_ARGS__)                                                  \
    {                                                                                                                  \
        return refuse(instance, #NAME, WHY);                                                                           \
    }

MPM_REFUSED(fmi3EnterEventMode, events)
MPM_REFUSED(fmi3EnterStepMode, events)
MPM_REFUSED(fmi3EvaluateDiscreteStates, events)
MPM_REFUSED(fmi3UpdateDiscreteStates, events, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
            fmi3Float64*)
MPM_REFUSED(fmi3EnterConfigurationMode, structure)
MPM_REFUSED(fmi3ExitConfigurationMode, structure)

MPM_REFUSED(fmi3GetNumberOfVariableDependencies, elements, fmi3ValueReference, size_t*)
MPM_REFUSED(fmi3GetVariableDependencies, elements, fmi3ValueReference, size_t[], fmi3ValueReference[], size_t[],
            fmi3DependencyKind[], size_t)
MPM_REFUSED(fmi3GetDirectionalDerivative, derivatives, const fmi3ValueReference[], size_t, const fmi3ValueReference[],
            size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t)
MPM_REFUSED(fmi3GetAdjointDerivative, derivatives, const fmi3ValueReference[], size_t, const fmi3ValueReference[],
            size_t, const fmi3Float64[], size_t, fmi3Float64[], size_t)
MPM_REFUSED(fmi3GetOutputDerivatives, outputDerivatives, const fmi3ValueReference[], size_t, const fmi3Int32[],
            fmi3Float64[], size_t)

MPM_REFUSED(fmi3GetIntervalDecimal, clocks, const fmi3ValueReference[], size_t, fmi3Float64[], fmi3IntervalQualifier[])
MPM_REFUSED(fmi3GetIntervalFraction, clocks, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[],
            fmi3IntervalQualifier[])
MPM_REFUSED(fmi3GetShiftDecimal, clocks, const fmi3ValueReference[], size_t, fmi3Float64[])
MPM_REFUSED(fmi3GetShiftFraction, clocks, const fmi3ValueReference[], size_t, fmi3UInt64[], fmi3UInt64[])
MPM_REFUSED(fmi3SetIntervalDecimal, clocks, const fmi3ValueReference[], size_t, const fmi3Float64[])
MPM_REFUSED(fmi3SetIntervalFraction, clocks, const fmi3ValueReference[], size_t, const fmi3UInt64[], const fmi3UInt64[])
MPM_REFUSED(fmi3SetShiftDecimal, clocks, const fmi3ValueReference[], size_t, const fmi3Float64[])
MPM_REFUSED(fmi3SetShiftFraction, clocks, const fmi3ValueReference[], size_t, const fmi3UInt64[], const fmi3UInt64[])

MPM_REFUSED(fmi3EnterContinuousTimeMode, modelExchange)
MPM_REFUSED(fmi3CompletedIntegratorStep, modelExchange, fmi3Boolean, fmi3Boolean*, fmi3Boolean*)
MPM_REFUSED(fmi3SetTime, modelExchange, fmi3Float64)
MPM_REFUSED(fmi3SetContinuousStates, modelExchange, const fmi3Float64[], size_t)
MPM_REFUSED(fmi3GetContinuousStateDerivatives, modelExchange, fmi3Float64[], size_t)
MPM_REFUSED(fmi3GetEventIndicators, modelExchange, fmi3Float64[], size_t)
MPM_REFUSED(fmi3GetContinuousStates, modelExchange, fmi3Float64[], size_t)
MPM_REFUSED(fmi3GetNominalsOfContinuousStates, modelExchange, fmi3Float64[], size_t)
MPM_REFUSED(fmi3GetNumberOfEventIndicators, modelExchange, size_t*)
MPM_REFUSED(fmi3GetNumberOfContinuousStates, modelExchange, size_t*)

MPM_REFUSED(fmi3ActivateModelPartition, scheduled, fmi3ValueReference, fmi3Float64)

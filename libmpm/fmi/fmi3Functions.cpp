// The functions of FMI 3.0 for Co-Simulation: instances, their states, steps, FMU states.
#include "fmi/fmi3Functions.h"

#include "fmi/guarded.hpp"

#include <algorithm>
#include <cstring>

using namespace mpm::fmi;

const char* fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    return guarded(instance, "fmi3SetDebugLogging",
                   [&](Instance& own) { own.log().set(loggingOn, nCategories, categories); });
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean, const fmi3ValueReference[],
                                         size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback)
{
    try
    {
        const Log log(logMessage, environment, loggingOn);
        const auto refuse = [&](const std::string& why) -> fmi3Instance {
            log(fmi3Error, "fmi3InstantiateCoSimulation: " + why);
            return nullptr;
        };
        try
        {
            if (!instanceName || !instantiationToken)
                return refuse("found NULL for instanceName or instantiationToken");
            if (std::all_of(instanceName, instanceName + std::strlen(instanceName), [](char c) { return c == ' '; }))
                return refuse("found an empty instanceName");
            if (!resourcePath)
                return refuse("found NULL for resourcePath, and the case lies there");
            if (eventModeUsed)
                return refuse("found eventModeUsed true, allowed false: the FMU has no Event Mode");
            if (nRequiredIntermediateVariables > 0)
                return refuse("found required intermediate variables, but the FMU has no intermediate update");
            return new Instance(instanceName, instantiationToken, resourcePath, log);
        }
        catch (const std::exception& error)
        {
            return refuse(error.what());
        }
    }
    catch (...) // no memory for the message
    {
        return nullptr;
    }
}

void fmi3FreeInstance(fmi3Instance instance)
{
    delete static_cast<Instance*>(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    return guarded(instance, "fmi3EnterInitializationMode", [&](Instance& own) {
        own.enterInitializationMode(startTime, stopTimeDefined ? std::optional(stopTime) : std::nullopt);
    });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    return guarded(instance, "fmi3ExitInitializationMode", [](Instance& own) { own.exitInitializationMode(); });
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    return guarded(instance, "fmi3Terminate", [](Instance& own) { own.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    return guarded(instance, "fmi3Reset", [](Instance& own) { own.reset(); });
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean* eventHandlingNeeded,
                      fmi3Boolean* terminateSimulation, fmi3Boolean* earlyReturn, fmi3Float64* lastSuccessfulTime)
{
    return guarded(instance, "fmi3DoStep", [&](Instance& own) {
        required(eventHandlingNeeded, "eventHandlingNeeded") = false;
        required(terminateSimulation, "terminateSimulation") = false;
        required(earlyReturn, "earlyReturn") = false;
        required(lastSuccessfulTime, "lastSuccessfulTime") = own.time();
        *lastSuccessfulTime =
            own.doStep(currentCommunicationPoint, communicationStepSize, noSetFMUStatePriorToCurrentPoint);
    });
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state)
{
    return guarded(instance, "fmi3GetFMUState", [&](Instance& own) {
        fmi3FMUState& handle = required(state, "FMUState");
        handle = own.saveState(handle);
    });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
    return guarded(instance, "fmi3SetFMUState", [&](Instance& own) { own.restoreState(state); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state)
{
    return guarded(instance, "fmi3FreeFMUState", [&](Instance& own) {
        if (own.owns(state)) // the state itself in place of its address, as fmusim passes it
            own.freeState(state);
        else if (state && *state)
        {
            own.freeState(*state);
            *state = nullptr;
        }
    });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t* size)
{
    return guarded(instance, "fmi3SerializedFMUStateSize",
                   [&](Instance& own) { required(size, "size") = own.serialise(state).size(); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte serialized[], size_t size)
{
    return guarded(instance, "fmi3SerializeFMUState", [&](Instance& own) {
        const auto& bytes = own.serialise(state);
        if (size != bytes.size())
            throw Refusal("found room for " + std::to_string(size) + " bytes, allowed " + std::to_string(bytes.size()));
        std::memcpy(arrayOf(serialized, size, "serializedState").data(), bytes.data(), size);
    });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serialized[], size_t size, fmi3FMUState* state)
{
    return guarded(instance, "fmi3DeserializeFMUState", [&](Instance& own) {
        const auto bytes = arrayOf(serialized, size, "serializedState");
        fmi3FMUState& handle = required(state, "FMUState");
        const fmi3FMUState made = own.deserialise(std::as_bytes(bytes));
        if (handle)
            own.freeState(handle);
        handle = made;
    });
}

// Variables of an instance: reading and setting them, and the states that are handed out.
#include "base/error.hpp"
#include "fmi/fmuInstance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mpm::fmi
{
namespace
{
const char* typeName(Type type)
{
    return type == Type::float64 ? "Float64" : type == Type::int64 ? "Int64" : "String";
}
} // namespace

const Variable& Instance::variable(fmi3ValueReference reference, Type type) const
{
    if (reference >= variables_.all.size())
        throw Refusal(
            fmt::format("found the value reference {}, allowed 0 to {}", reference, variables_.all.size() - 1));
    const Variable& v = variables_.all[reference];
    if (v.type != type)
        throw Refusal(fmt::format("{} is of type {}, not {}", v.name, typeName(v.type), typeName(type)));
    return v;
}

void Instance::requireSettable(const Variable& v) const
{
    if (v.causality != Causality::parameter && v.causality != Causality::input)
        throw Refusal(fmt::format("{} is neither a parameter nor an input", v.name));
    const bool before = phase_ == Phase::Instantiated || phase_ == Phase::InitializationMode;
    if (!before && !(phase_ == Phase::StepMode && v.causality == Causality::input))
        throw Refusal(fmt::format("{}: set in {}, allowed in {}", v.name, phaseName(phase_),
                                  v.causality == Causality::input ? "Instantiated, Initialization Mode or Step Mode"
                                                                  : "Instantiated or Initialization Mode"));
}

void Instance::get(std::span<const fmi3ValueReference> references, Type type, std::span<double> out)
{
    std::size_t size = 0;
    for (const auto reference : references)
    {
        const Variable& v = variable(reference, type);
        size += v.size();
        const bool calculated = v.causality == Causality::output || v.causality == Causality::calculatedParameter;
        if (calculated && phase_ == Phase::Instantiated)
            throw Refusal(fmt::format("{} is calculated: there after fmi3EnterInitializationMode", v.name));
    }
    if (size != out.size())
        throw Refusal(fmt::format("found room for {} values, allowed {}", out.size(), size));
    if (phase_ == Phase::InitializationMode && stale_)
        initialise();
    auto at = out.begin();
    for (const auto reference : references)
    {
        const Variable& v = variables_.all[reference];
        const auto from = values_.begin() + std::ptrdiff_t(v.first);
        at = std::copy(from, from + std::ptrdiff_t(v.size()), at);
    }
}

void Instance::set(std::span<const fmi3ValueReference> references, Type type, std::span<const double> in)
{
    std::size_t size = 0;
    for (const auto reference : references)
    {
        const Variable& v = variable(reference, type);
        requireSettable(v);
        for (std::size_t i = 0; i < v.size() && size + i < in.size(); ++i)
            if (!std::isfinite(in[size + i]))
                throw Refusal(fmt::format("{}: found {}, allowed: a finite number", v.name, in[size + i]));
        if (v.name == "threads" && size < in.size() && !(in[size] >= 0 && in[size] <= 1024))
            throw Refusal(fmt::format("threads: found {}, allowed 0 (as many as OpenMP takes) to 1024", in[size]));
        size += v.size();
    }
    if (size != in.size())
        throw Refusal(fmt::format("found {} values, allowed {}", in.size(), size));
    auto from = in.begin();
    for (const auto reference : references)
    {
        const Variable& v = variables_.all[reference];
        const auto at = values_.begin() + std::ptrdiff_t(v.first);
        const auto end = from + std::ptrdiff_t(v.size());
        if (v.causality == Causality::parameter && !std::equal(from, end, at))
            stale_ = true;
        std::copy(from, end, at);
        touched_[reference] = true;
        from = end;
    }
}

const std::string& Instance::getText(fmi3ValueReference reference) const
{
    variable(reference, Type::string);
    return outputFolder_;
}

void Instance::setText(fmi3ValueReference reference, const std::string& text)
{
    requireSettable(variable(reference, Type::string));
    if (text == outputFolder_)
        return;
    outputFolder_ = text;
    stale_ = true;
}

State& Instance::stateAt(fmi3FMUState handle)
{
    const auto found = states_.find(handle);
    if (found == states_.end())
        throw Refusal("found an FMU state that is none of this instance, or was freed");
    return *found->second;
}

fmi3FMUState Instance::saveState(fmi3FMUState reused)
{
    if (reused)
        stateAt(reused);
    if (phase_ == Phase::InitializationMode && stale_)
        initialise();
    auto state = std::make_unique<State>();
    *state = {phase_, values_, touched_, said_, saidOf_, stopTime_, pending_, window_, substeps_, {}, {}, {}};
    if (phase_ != Phase::Instantiated)
        state->snapshot = participant_->saveState();
    if (reused)
    {
        *states_.at(reused) = std::move(*state);
        return reused;
    }
    const fmi3FMUState handle = state.get();
    states_.emplace(handle, std::move(state));
    return handle;
}

void Instance::restoreState(fmi3FMUState handle)
{
    State& state = stateAt(handle);
    // where results go and how many threads make them is the instance's, not the state's
    std::vector<double> values = state.values;
    const std::size_t threads = variables_.all[variables_.at("threads")].first;
    values[threads] = values_[threads];
    if (state.phase == Phase::Instantiated)
    {
        const bool different = !sameParameters(values);
        if (phase_ != Phase::Instantiated || different)
            stale_ = true;
    }
    bool made = false; // what was not calculated here is not written here either
    if (state.phase != Phase::Instantiated)
    {
        const bool running = phase_ != Phase::Instantiated && !stale_;
        made = !running || !sameParameters(values);
        if (made)
        {
            const auto before = std::exchange(values_, values);
            stale_ = true;
            try
            {
                initialise();
            }
            catch (...)
            {
                values_ = before;
                throw;
            }
        }
        if (state.snapshot.empty())
            state.snapshot = participant_->deserialise(state.serialised);
        participant_->restoreState(state.snapshot);
    }
    phase_ = state.phase;
    values_ = std::move(values);
    touched_ = state.touched;
    said_ = state.said;
    saidOf_ = state.saidOf;
    stopTime_ = state.stopTime;
    pending_ = state.pending && !made;
    window_ = state.window;
    substeps_ = state.substeps;
}

void Instance::freeState(fmi3FMUState handle)
{
    stateAt(handle);
    states_.erase(handle);
}

const std::vector<std::byte>& Instance::serialise(fmi3FMUState handle)
{
    State& state = stateAt(handle);
    if (state.whole.empty())
    {
        if (!participant_)
            build();
        if (!state.snapshot.empty())
            state.serialised = participant_->serialise(state.snapshot);
        state.whole = bytesOf(state, state.serialised, token_);
    }
    return state.whole;
}

fmi3FMUState Instance::deserialise(std::span<const std::byte> bytes)
{
    auto state = std::make_unique<State>(
        stateOf(bytes, token_, variables_.all.size(), variables_.inputs.size(), variables_.valueCount));
    const fmi3FMUState handle = state.get();
    states_.emplace(handle, std::move(state));
    return handle;
}
} // namespace mpm::fmi

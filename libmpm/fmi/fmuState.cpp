#include "fmi/fmuState.hpp"

#include "base/hash.hpp"
#include "fmi/fmuCase.hpp"

#include <cstring>
#include <string_view>

namespace mpm::fmi
{
using coupling::CouplingError;
using coupling::Fault;

namespace
{
constexpr std::string_view magic = "libmpm FMU state 1\n";

std::string_view textOf(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class Writer
{
  public:
    template <class T>
    void put(const T& value)
    {
        const auto* at = reinterpret_cast<const std::byte*>(&value);
        bytes.insert(bytes.end(), at, at + sizeof value);
    }
    void put(std::string_view text)
    {
        put(std::uint64_t(text.size()));
        const auto* at = reinterpret_cast<const std::byte*>(text.data());
        bytes.insert(bytes.end(), at, at + text.size());
    }
    std::vector<std::byte> bytes;
};

class Reader
{
  public:
    explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}
    template <class T>
    T take()
    {
        T value;
        std::memcpy(&value, part(sizeof value).data(), sizeof value);
        return value;
    }
    std::span<const std::byte> text() { return part(take<std::uint64_t>()); }
    bool done() const { return rest_.empty(); }

  private:
    std::span<const std::byte> part(std::uint64_t size)
    {
        if (size > rest_.size())
            throw CouplingError(Fault::badState, "the serialised FMU state ends too early");
        const auto found = rest_.first(size);
        rest_ = rest_.subspan(size);
        return found;
    }
    std::span<const std::byte> rest_;
};
std::string digits(const std::vector<bool>& flags)
{
    std::string text;
    for (const bool flag : flags)
        text += flag ? '1' : '0';
    return text;
}

std::vector<bool> flags(std::string_view digits)
{
    std::vector<bool> out;
    for (const char digit : digits)
        out.push_back(digit == '1');
    return out;
}
} // namespace

const char* phaseName(Phase phase)
{
    switch (phase)
    {
    case Phase::Instantiated:
        return "Instantiated";
    case Phase::InitializationMode:
        return "Initialization Mode";
    case Phase::StepMode:
        return "Step Mode";
    default:
        return "Terminated";
    }
}

std::vector<std::byte> bytesOf(const State& state, std::span<const std::byte> participant, const std::string& token)
{
    Writer out;
    out.put(magic);
    out.put(std::string_view(token));
    out.put(std::uint8_t(state.phase));
    out.put(textOf(std::as_bytes(std::span(state.values))));
    out.put(textOf(std::as_bytes(std::span(state.said))));
    out.put(std::string_view(digits(state.touched)));
    out.put(std::string_view(digits(state.saidOf)));
    out.put(std::uint8_t(state.stopTime.has_value()));
    out.put(state.stopTime.value_or(0.0));
    out.put(std::uint8_t(state.pending));
    out.put(state.window);
    out.put(state.substeps);
    out.put(textOf(participant));
    out.put(hashOf(textOf(out.bytes)));
    return out.bytes;
}

State stateOf(std::span<const std::byte> bytes, const std::string& token, std::size_t variables, std::size_t inputs,
              std::size_t values)
{
    const auto refuse = [](const char* what) { throw CouplingError(Fault::badState, what); };
    if (bytes.size() < sizeof(std::uint64_t))
        refuse("these bytes are no FMU state");
    const auto body = bytes.first(bytes.size() - sizeof(std::uint64_t));
    Reader in(body);
    if (textOf(in.text()) != magic)
        refuse("these bytes are no FMU state");
    if (Reader(bytes.last(sizeof(std::uint64_t))).take<std::uint64_t>() != hashOf(textOf(body)))
        refuse("the serialised FMU state is damaged");
    if (textOf(in.text()) != token)
        refuse("the serialised state is of another FMU");
    State state;
    state.phase = Phase(in.take<std::uint8_t>());
    for (auto* numbers : {&state.values, &state.said})
    {
        const auto found = in.text();
        numbers->resize(values);
        if (found.size() != values * sizeof(double) || state.phase > Phase::Terminated)
            refuse("the serialised state is of another FMU");
        std::memcpy(numbers->data(), found.data(), found.size());
    }
    state.touched = flags(textOf(in.text()));
    state.saidOf = flags(textOf(in.text()));
    const bool stops = in.take<std::uint8_t>() != 0;
    const double stopTime = in.take<double>();
    if (stops)
        state.stopTime = stopTime;
    state.pending = in.take<std::uint8_t>() != 0;
    state.window = in.take<double>();
    state.substeps = in.take<Index>();
    const auto participant = in.text();
    state.serialised.assign(participant.begin(), participant.end());
    if (!in.done() || state.touched.size() != variables || state.saidOf.size() != inputs)
        refuse("the serialised FMU state is damaged");
    return state;
}
} // namespace mpm::fmi

#include "case/provenance.hpp"

#include "base/version.hpp"

#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
constexpr const char* word = "instructionSet";
constexpr const char* storageWord = "storage";
constexpr const char* separator = "; ";
constexpr const char* since = " from step ";

std::string recorded(const state::State& state)
{
    const auto found = state.provenance.find(word);
    return found == state.provenance.end() ? "" : found->second;
}

std::string recordedStorage(const state::State& state)
{
    const auto found = state.provenance.find(storageWord);
    return found == state.provenance.end() ? "double" : found->second;
}

/// What computed the last step.
std::string last(const std::string& record)
{
    const auto begin = record.rfind(separator);
    const auto entry = begin == std::string::npos ? record : record.substr(begin + std::string(separator).size());
    return entry.substr(0, entry.rfind(since));
}
} // namespace

void recordInstructionSet(state::State& state, const std::string& running)
{
    const auto before = recorded(state);
    if (before.empty() || state.step == 0)
        state.provenance[word] = running;
    else if (last(before) != running)
        state.provenance[word] = fmt::format("{}{}{}{}{}", before, separator, running, since, state.step);
}

std::string instructionSetNote(const state::State& state, const std::string& running)
{
    const auto before = recorded(state);
    if (before.empty() || before == running || state.step == 0)
        return "";
    if (last(before) == running)
        return fmt::format("this state was computed with more than one instruction set ({})", before);
    return fmt::format("this state was computed with {}, this is {}: results are no longer bitwise those of one "
                       "instruction set",
                       before, running);
}

void recordStorage(state::State& state, const std::string& running)
{
    const auto before = recordedStorage(state);
    if (state.step == 0 || before == running)
        state.provenance[storageWord] = running;
    else if (last(before) != running)
        state.provenance[storageWord] = fmt::format("{}{}{}{}{}", before, separator, running, since, state.step);
    if (state.provenance[storageWord] == "double")
        state.provenance.erase(storageWord);
}

std::string storageNote(const state::State& state, const std::string& running)
{
    const auto before = recordedStorage(state);
    if (before == running || state.step == 0)
        return "";
    if (last(before) == running)
        return fmt::format("this state was computed with more than one storage ({})", before);
    return fmt::format("this state was computed with storage {}, this is {}: results are no longer bitwise those of "
                       "one storage",
                       before, running);
}

void recordRun(state::State& state, const std::string& dictionaries)
{
    state.provenance["version"] = projectVersion();
    state.provenance["revision"] = gitRevision();
    state.provenance["compiler"] = compilerText() + ", " + compilerFlags();
    recordInstructionSet(state, instructionSet());
    recordStorage(state, storage());
    state.provenance["dictionaries"] = dictionaries;
}
} // namespace mpm::cases

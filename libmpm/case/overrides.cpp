#include "case/overrides.hpp"

#include <sstream>

namespace mpm::cases
{
namespace
{
constexpr const char* memoryName = "overrides"; // in the provenance of a state
constexpr const char* takenAway = "-";
} // namespace

void Overrides::set(const std::string& file, const std::string& word, const std::string& value)
{
    words_.push_back({file, word, value});
}

void Overrides::apply(const std::string& file, dictionary::Dictionary& dictionary) const
{
    for (const auto& o : words_)
        if (o.file == file && o.value.empty())
            dictionary.drop(o.word);
        else if (o.file == file)
            dictionary.set(o.word, o.value, reason_);
}

std::string Overrides::describe() const
{
    std::string text;
    for (const auto& o : words_)
        text += (text.empty() ? "" : ", ") + (o.value.empty() ? "no " + o.word : o.word + " " + o.value);
    return text;
}

void Overrides::remember(state::State& state) const
{
    state.provenance.erase(memoryName);
    if (empty())
        return;
    std::string text = reason_ + "\n";
    for (const auto& o : words_)
        text += o.file + " " + o.word + " " + (o.value.empty() ? takenAway : o.value) + "\n";
    state.provenance[memoryName] = text;
}

Overrides Overrides::recall(const state::State& state)
{
    const auto found = state.provenance.find(memoryName);
    if (found == state.provenance.end())
        return {};
    std::istringstream lines(found->second);
    std::string line;
    std::getline(lines, line);
    Overrides overrides(line);
    while (std::getline(lines, line))
    {
        std::istringstream words(line);
        Override o;
        words >> o.file >> o.word;
        std::getline(words >> std::ws, o.value);
        if (o.value.empty())
            throw InputError("state: found '" + line + "' below /provenance/overrides, allowed: FILE WORD VALUE");
        overrides.words_.push_back({o.file, o.word, o.value == takenAway ? "" : o.value});
    }
    return overrides;
}
} // namespace mpm::cases

// Questions for values: get() and choose(), each answer checked as a whole.
#include "dictionary/value.hpp"

#include <algorithm>

namespace mpm::dictionary
{
namespace
{
/// "a number > 0 [Pa]"
template <class T>
std::string allowedText(const Entry<T>& entry)
{
    std::string out = Type<T>::allowed;
    if (const std::string limits = entry.bound.text(); !limits.empty())
        out += " " + limits;
    if (const std::string unit = unitText(entry.dimensions); !unit.empty())
        out += " [" + unit + "]";
    return out;
}

/// ", what it is; is 'densty' in line 7 meant?"
std::string missingHint(const Node& node, const std::string& word, const std::string& help)
{
    std::string out = help.empty() ? "" : ", " + help;
    std::vector<std::string> unread;
    for (const NodeEntry& entry : node.entries)
        if (!entry.read)
            unread.push_back(entry.word);
    if (const std::string nearest = nearestWord(word, unread); !nearest.empty())
        out += fmt::format("; is '{}' in line {} meant?", nearest, node.entries[node.index.at(nearest)].where.line);
    return out;
}

/// One value was taken and more follows: a ';' is missing where the next token stands in a later line.
void rejectMissingEnd(const Node& node, const std::string& word, Rest all, Rest rest)
{
    if (rest.empty() || rest.at == all.at || rest.at->line == rest.at[-1].line)
        return;
    throw InputError(rest.at[-1].where(), fmt::format("{}: missing ';' at the end of this line (found {} in line {})",
                                                      node.pathOf(word), rest.at->shown(), rest.at->line));
}
} // namespace

/// Takes what may stand before a value: OpenFOAM's older repeated word, dimensions, `uniform`.
Rest Dictionary::Body::skipPrefix(const Dictionary& self, const std::string& word, Rest all,
                                  const Dimensions& dimensions, bool mayBeUniform)
{
    Rest rest = all;
    if (rest.end - rest.at > 1 && rest.at[0].text == word && rest.at[1].is('[')) // nu nu [0 2 -1 0 0] 1e-5;
        ++rest.at;
    if (rest.is('['))
    {
        Dimensions given{};
        if (!take(rest, given))
            self.fail(word, shownValue(all), fmt::format("{} before the value", Type<Dimensions>::allowed));
        const std::string unit = unitText(dimensions);
        if (given != dimensions)
            self.fail(word, "the dimensions " + exponentsText(given),
                      fmt::format("{} ({})", exponentsText(dimensions), unit.empty() ? "a pure number" : unit));
    }
    if (mayBeUniform && rest.end - rest.at > 1 && rest.at->kind == Kind::word && rest.at->text == "uniform")
        ++rest.at;
    return rest;
}

template <class T>
T Dictionary::get(const Entry<T>& entry) const
{
    body_->remember({entry.word, Type<T>::name, entry.help, unitText(entry.dimensions), entry.bound.text(),
                     entry.fallback ? shownDefault(*entry.fallback) : ""});
    NodeEntry* found = body_->node->find(entry.word);
    if (!found && entry.fallback)
        return *entry.fallback;
    if (!found)
        fail(entry.word, "nothing", allowedText(entry) + missingHint(*body_->node, entry.word, entry.help));
    found->read = true;
    if (found->dict)
        fail(entry.word, "a dictionary", allowedText(entry));

    const Rest all{found->value.data(), found->value.data() + found->value.size()};
    constexpr bool isNumber =
        std::is_same_v<T, double> || std::is_same_v<T, Vector3> || std::is_same_v<T, std::vector<FormulaText>>;
    constexpr bool isTable = std::is_same_v<T, std::vector<TableRow>>;
    constexpr bool isPlain = std::is_same_v<T, Dimensions> || std::is_same_v<T, bool> || std::is_same_v<T, std::string>;
    Rest rest = all;
    if constexpr (!isPlain)
        rest = Body::skipPrefix(*this, entry.word, all, entry.dimensions, isNumber);
    if (isTable && !rest.empty() && rest.at->kind == Kind::word && rest.at->text == "table")
        ++rest.at;
    T value{};
    const bool taken = take(rest, value);
    if (taken)
        rejectMissingEnd(*body_->node, entry.word, all, rest);
    if (!taken || !rest.empty())
        fail(entry.word, shownValue(all) + shownReason(all, rest), allowedText(entry));
    if (const auto bad = outside(entry.bound, value))
        fail(entry.word, fmt::format("{}", *bad), allowedText(entry));
    return value;
}

template double Dictionary::get(const Entry<double>&) const;
template Index Dictionary::get(const Entry<Index>&) const;
template bool Dictionary::get(const Entry<bool>&) const;
template std::string Dictionary::get(const Entry<std::string>&) const;
template Vector3 Dictionary::get(const Entry<Vector3>&) const;
template Dimensions Dictionary::get(const Entry<Dimensions>&) const;
template std::vector<double> Dictionary::get(const Entry<std::vector<double>>&) const;
template std::vector<std::string> Dictionary::get(const Entry<std::vector<std::string>>&) const;
template FormulaText Dictionary::get(const Entry<FormulaText>&) const;
template std::vector<FormulaText> Dictionary::get(const Entry<std::vector<FormulaText>>&) const;
template std::vector<Vector3> Dictionary::get(const Entry<std::vector<Vector3>>&) const;
template std::vector<TableRow> Dictionary::get(const Entry<std::vector<TableRow>>&) const;

bool Dictionary::holdsTable(const std::string& word) const
{
    body_->remember({word, "", "", "", "", ""});
    const NodeEntry* entry = body_->node->find(word);
    if (!entry || entry->dict)
        return false;
    Rest rest{entry->value.data(), entry->value.data() + entry->value.size()};
    if (rest.is('[')) // dimensions
        while (!rest.empty() && !(rest.at++)->is(']'))
            ;
    if (!rest.empty() && rest.at->kind == Kind::word && rest.at->text == "table")
        return true;
    return rest.is('(') && rest.end - rest.at > 1 && rest.at[1].is('(');
}
template std::vector<WordGroup> Dictionary::get(const Entry<std::vector<WordGroup>>&) const;
template std::vector<WordPair> Dictionary::get(const Entry<std::vector<WordPair>>&) const;

std::string Dictionary::choose(const std::string& word, const std::string& help, const std::vector<Choice>& catalogue,
                               const std::optional<std::string>& fallback) const
{
    std::vector<std::string> names;
    for (const Choice& choice : catalogue)
        names.push_back(choice.name);
    body_->remember({word, "name", help, "", joinWords(names), fallback.value_or("")});
    NodeEntry* found = body_->node->find(word);
    if (!found && fallback)
        return *fallback;
    if (!found)
        fail(word, "nothing", joinWords(names) + missingHint(*body_->node, word, help));
    found->read = true;
    if (found->dict)
        fail(word, "a dictionary", joinWords(names));

    const Rest all{found->value.data(), found->value.data() + found->value.size()};
    Rest rest = all;
    std::string name;
    const bool taken = take(rest, name);
    if (taken)
        rejectMissingEnd(*body_->node, word, all, rest);
    if (!taken || !rest.empty() || std::find(names.begin(), names.end(), name) == names.end())
        fail(word, shownValue(all), joinWords(names) + didYouMean(name, names));
    return name;
}
} // namespace mpm::dictionary

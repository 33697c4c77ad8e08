// From tokens to values: numbers, vectors, words and lists, each checked as a whole.
#include "dictionary/body.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace mpm::dictionary {
namespace {
/// What is left of an entry's tokens while a value is taken from their front.
struct Rest
{
    const Token* at;
    const Token* end;

    bool empty() const { return at == end; }
    bool is(char c) const { return !empty() && at->is(c); }
};

std::string shownValue(Rest rest)
{
    if (rest.empty())
        return "nothing";
    std::string out;
    const Token* before = nullptr;
    for (const Token* token = rest.at; token != rest.end && out.size() < 80; before = token++) {
        if (before && !before->is('(') && !before->is('[') && !token->is(')') && !token->is(']'))
            out += ' ';
        out += token->source();
    }
    return shownText(out);
}

bool take(Rest& rest, double& value)
{
    if (rest.empty() || rest.at->kind != Kind::number)
        return false;
    const std::string& s = rest.at->text;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (error != std::errc() || end != s.data() + s.size() || !std::isfinite(value))
        return false;
    ++rest.at;
    return true;
}

bool take(Rest& rest, Index& value)
{
    if (rest.empty() || rest.at->kind != Kind::number)
        return false;
    const std::string& s = rest.at->text;
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), value);
    if (error != std::errc() || end != s.data() + s.size())
        return false;
    ++rest.at;
    return true;
}

bool take(Rest& rest, bool& value)
{
    if (rest.empty() || rest.at->kind != Kind::word)
        return false;
    const std::string& s = rest.at->text;
    if (s == "on" || s == "yes" || s == "true")
        value = true;
    else if (s == "off" || s == "no" || s == "false")
        value = false;
    else
        return false;
    ++rest.at;
    return true;
}

bool take(Rest& rest, std::string& value)
{
    if (rest.empty() || (rest.at->kind != Kind::word && rest.at->kind != Kind::text))
        return false;
    value = (rest.at++)->text;
    return true;
}

bool take(Rest& rest, Vector3& value)
{
    if (!rest.is('('))
        return false;
    ++rest.at;
    for (double& component : value)
        if (!take(rest, component))
            return false;
    if (!rest.is(')'))
        return false;
    ++rest.at;
    return true;
}

/// `( a b c )`, or with the count that OpenFOAM writes before it: `3 ( a b c )`.
template <class T>
bool take(Rest& rest, std::vector<T>& values)
{
    Index count = -1;
    if (!rest.empty() && rest.at->kind == Kind::number && (!take(rest, count) || count < 0))
        return false;
    if (!rest.is('('))
        return false;
    for (++rest.at; !rest.is(')');) {
        T value{};
        if (!take(rest, value))
            return false;
        values.push_back(std::move(value));
    }
    ++rest.at;
    return count < 0 || count == Index(values.size());
}

bool take(Rest& rest, Dimensions& value)
{
    if (!rest.is('['))
        return false;
    ++rest.at;
    std::size_t count = 0;
    for (; count < value.size() && !rest.is(']'); ++count)
        if (!take(rest, value[count]))
            return false;
    if (!rest.is(']') || (count != 5 && count != 7))
        return false;
    ++rest.at;
    return true;
}

template <class T>
struct Type;
template <>
struct Type<double>
{
    static constexpr const char *name = "number", *allowed = "a number", *plural = "numbers";
};
template <>
struct Type<Index>
{
    static constexpr const char *name = "integer", *allowed = "an integer", *plural = "integers";
};
template <>
struct Type<bool>
{
    static constexpr const char *name = "switch", *allowed = "on, off, yes, no, true or false", *plural = "switches";
};
template <>
struct Type<std::string>
{
    static constexpr const char *name = "word", *allowed = "a word or a text in double quotes", *plural = "words";
};
template <>
struct Type<Vector3>
{
    static constexpr const char *name = "vector", *allowed = "three numbers (x y z)", *plural = "vectors (x y z)";
};
template <>
struct Type<Dimensions>
{
    static constexpr const char *name = "dimensions", *allowed = "5 or 7 exponents [kg m s K mol A cd]", *plural = "";
};
template <class T>
struct Type<std::vector<T>>
{
    static inline const std::string name = fmt::format("list of {}", Type<T>::plural);
    static inline const std::string allowed = fmt::format("a list ( ... ) of {}", Type<T>::plural);
};

/// The first number outside the bound, if any.
template <class T>
std::optional<double> outside(const Bound& bound, const T& value)
{
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Index>)
        return bound.contains(double(value)) ? std::nullopt : std::optional<double>(double(value));
    else if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, Vector3>) {
        for (const double component : value)
            if (!bound.contains(component))
                return component;
        return std::nullopt;
    } else if constexpr (std::is_same_v<T, std::vector<Vector3>>) {
        for (const Vector3& vector : value)
            if (const auto bad = outside(bound, vector))
                return bad;
        return std::nullopt;
    } else
        return std::nullopt;
}

std::string shownDefault(double value)
{
    return fmt::format("{}", value);
}
std::string shownDefault(Index value)
{
    return fmt::format("{}", value);
}
std::string shownDefault(bool value)
{
    return value ? "on" : "off";
}
std::string shownDefault(const std::string& value)
{
    return value;
}
std::string shownDefault(const Dimensions& value)
{
    return exponentsText(value);
}
std::string shownDefault(const Vector3& value)
{
    return fmt::format("({} {} {})", value[0], value[1], value[2]);
}
template <class T>
std::string shownDefault(const std::vector<T>& values)
{
    std::string out = "(";
    for (const T& value : values)
        out.append(out.size() > 1 ? " " : "").append(shownDefault(value));
    return out + ")";
}

/// "a number > 0 [Pa]"
std::string allowedText(const std::string& type, const Bound& bound, const Dimensions& dimensions)
{
    const std::string limits = bound.text(), unit = unitText(dimensions);
    return type + (limits.empty() ? "" : " " + limits) + (unit.empty() ? "" : " [" + unit + "]");
}
} // namespace

bool Bound::contains(double value) const
{
    return (lowOpen ? value > low : value >= low) && (highOpen ? value < high : value <= high);
}

std::string Bound::text() const
{
    const bool below = low == -std::numeric_limits<double>::infinity();
    const bool above = high == std::numeric_limits<double>::infinity();
    if (below && above)
        return "";
    if (above)
        return fmt::format("{} {}", lowOpen ? ">" : ">=", low);
    if (below)
        return fmt::format("{} {}", highOpen ? "<" : "<=", high);
    return fmt::format("in {}{}, {}{}", lowOpen ? '(' : '[', low, high, highOpen ? ')' : ']');
}

std::string exponentsText(const Dimensions& d)
{
    return fmt::format("[{} {} {} {} {} {} {}]", d[0], d[1], d[2], d[3], d[4], d[5], d[6]);
}

std::string unitText(const Dimensions& dimensions)
{
    if (dimensions == unit::pressure)
        return "Pa";
    static constexpr const char* names[] = {"kg", "m", "s", "K", "mol", "A", "cd"};
    std::string out;
    for (std::size_t i = 0; i < dimensions.size(); ++i)
        if (dimensions[i] != 0) {
            out.append(out.empty() ? "" : " ").append(names[i]);
            if (dimensions[i] != 1)
                out += fmt::format("^{}", dimensions[i]);
        }
    return out;
}

template <class T>
T Dictionary::get(const Entry<T>& entry) const
{
    const std::string allowed = allowedText(Type<T>::allowed, entry.bound, entry.dimensions);
    body_->remember({entry.word, Type<T>::name, entry.help, unitText(entry.dimensions), entry.bound.text(),
                     entry.fallback ? shownDefault(*entry.fallback) : ""});
    NodeEntry* found = body_->node->find(entry.word);
    if (!found) {
        if (entry.fallback)
            return *entry.fallback;
        std::vector<std::string> unread;
        for (const NodeEntry& other : body_->node->entries)
            if (!other.read)
                unread.push_back(other.word);
        const std::string nearest = nearestWord(entry.word, unread);
        fail(entry.word, "nothing",
             allowed + (entry.help.empty() ? "" : ", " + entry.help) +
                 (nearest.empty() ? "" : fmt::format("; is '{}' in line {} meant?", nearest, where(nearest).line)));
    }
    found->read = true;
    if (found->dict)
        fail(entry.word, "a dictionary", allowed);

    const Rest all{found->value.data(), found->value.data() + found->value.size()};
    Rest rest = all;
    // `nu nu [0 2 -1 0 0] 1e-5;`: OpenFOAM's older way repeats the word
    if (rest.end - rest.at > 1 && rest.at[0].text == entry.word && rest.at[1].is('['))
        ++rest.at;
    if (!std::is_same_v<T, Dimensions> && rest.is('[')) {
        Dimensions given{};
        if (!take(rest, given))
            fail(entry.word, shownValue(all), std::string(Type<Dimensions>::allowed) + " before the value");
        if (given != entry.dimensions)
            fail(entry.word, "the dimensions " + exponentsText(given),
                 exponentsText(entry.dimensions) + " (" +
                     (unitText(entry.dimensions).empty() ? "a pure number" : unitText(entry.dimensions)) + ")");
    }
    if ((std::is_same_v<T, double> || std::is_same_v<T, Vector3>)&&rest.end - rest.at > 1 &&
        rest.at->kind == Kind::word && rest.at->text == "uniform")
        ++rest.at;

    T value{};
    const bool taken = take(rest, value);
    if (taken && !rest.empty() && rest.at > all.at && rest.at->line > rest.at[-1].line)
        throw InputError({*rest.at[-1].file, rest.at[-1].line},
                         fmt::format("{}: missing ';' at the end of this line (found {} in line {})",
                                     body_->node->pathOf(entry.word), rest.at->shown(), rest.at->line));
    if (!taken || !rest.empty())
        fail(entry.word, shownValue(all), allowed);
    if (const auto bad = outside(entry.bound, value))
        fail(entry.word, fmt::format("{}", *bad), allowed);
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
template std::vector<Vector3> Dictionary::get(const Entry<std::vector<Vector3>>&) const;

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
        fail(word, "nothing", joinWords(names) + (help.empty() ? "" : ", " + help));
    found->read = true;
    if (found->dict)
        fail(word, "a dictionary", joinWords(names));
    const auto& value = found->value;
    if (value.size() == 1 && std::find(names.begin(), names.end(), value[0].text) != names.end() &&
        value[0].kind != Kind::text)
        return value[0].text;
    const Rest rest{value.data(), value.data() + value.size()};
    if (value.size() > 1 && value[1].line > value[0].line)
        throw InputError(value[0].where(), fmt::format("{}: missing ';' at the end of this line (found {} in line {})",
                                                       body_->node->pathOf(word), value[1].shown(), value[1].line));
    fail(word, shownValue(rest), joinWords(names) + (value.empty() ? "" : didYouMean(value[0].text, names)));
}
} // namespace mpm::dictionary

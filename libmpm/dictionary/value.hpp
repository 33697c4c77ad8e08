#pragma once
/// Internal to dictionary/: taking values from the front of an entry's tokens, and what each type is called in
/// messages.
#include "dictionary/body.hpp"

#include <fmt/format.h>

namespace mpm::dictionary
{
/// What is left of an entry's tokens while a value is taken from their front.
struct Rest
{
    const Token* at;
    const Token* end;

    bool empty() const { return at == end; }
    bool is(char c) const { return !empty() && at->is(c); }
};

/// The tokens as they would stand in a file, in quotes, for a message.
std::string shownValue(Rest rest);
/// What is wrong with the token a take() stopped at, where that is not plain: " (beyond double precision)", or nothing.
std::string shownReason(Rest all, Rest stopped);

// take() reads one value and moves `rest` behind it, or stops at the token that does not fit and returns false.
bool take(Rest& rest, double& value);      ///< finite; nothing but a number
bool take(Rest& rest, Index& value);       ///< digits only
bool take(Rest& rest, bool& value);        ///< on off yes no true false
bool take(Rest& rest, std::string& value); ///< a word or a quoted text
bool take(Rest& rest, FormulaText& value); ///< a number, a word or a quoted text
bool take(Rest& rest, Vector3& value);     ///< (x y z)
bool take(Rest& rest, Dimensions& value);  ///< [5 or 7 exponents]
bool take(Rest& rest, TableRow& value);    ///< (t value ...) or (t (x y z))
bool take(Rest& rest, WordGroup& value);   ///< a word or (a b c)
bool take(Rest& rest, WordPair& value);    ///< (a b 0.5)

/// `( a b c )`, or with the count that OpenFOAM writes before it: `3 ( a b c )`.
template <class T>
bool take(Rest& rest, std::vector<T>& values)
{
    Index count = -1;
    if (!rest.empty() && rest.at->kind == Kind::number && (!take(rest, count) || count < 0))
        return false;
    if (!rest.is('('))
        return false;
    const Token* const begin = rest.at;
    for (++rest.at; !rest.is(')');)
    {
        T value{};
        if (!take(rest, value))
            return false;
        values.push_back(std::move(value));
    }
    ++rest.at;
    if (count < 0 || count == Index(values.size()))
        return true;
    rest.at = begin - 1; // the count is what does not fit
    return false;
}

std::string shownDefault(double value);
std::string shownDefault(Index value);
std::string shownDefault(bool value);
std::string shownDefault(const std::string& value);
std::string shownDefault(const FormulaText& value);
std::string shownDefault(const Dimensions& value);
std::string shownDefault(const Vector3& value);
std::string shownDefault(const TableRow& value);
std::string shownDefault(const WordGroup& value);
std::string shownDefault(const WordPair& value);
template <class T>
std::string shownDefault(const std::vector<T>& values)
{
    std::string out = "(";
    for (const T& value : values)
        out.append(out.size() > 1 ? " " : "").append(shownDefault(value));
    return out + ")";
}

/// The first number outside the bound, if any.
template <class T>
std::optional<double> outside(const Bound& bound, const T& value)
{
    if constexpr (std::is_same_v<T, WordPair>)
        return outside(bound, value.value);
    else if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Index>)
        return bound.contains(double(value)) ? std::nullopt : std::optional<double>(double(value));
    else if constexpr (std::is_same_v<T, std::vector<double>> || std::is_same_v<T, Vector3> ||
                       std::is_same_v<T, std::vector<Vector3>> || std::is_same_v<T, std::vector<WordPair>>)
    {
        for (const auto& component : value)
            if (const auto bad = outside(bound, component))
                return bad;
    }
    return std::nullopt;
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
struct Type<FormulaText>
{
    static constexpr const char *name = "number or formula", *allowed = "a number or a formula in double quotes",
                                *plural = "numbers or formulas in double quotes";
};
template <>
struct Type<Vector3>
{
    static constexpr const char *name = "vector", *allowed = "three numbers (x y z)", *plural = "vectors (x y z)";
};
template <>
struct Type<TableRow>
{
    static constexpr const char *name = "row of a table", *allowed = "a time and its value, (t value) or (t (x y z))",
                                *plural = "rows (t value) or (t (x y z))";
};
template <>
struct Type<Dimensions>
{
    static constexpr const char *name = "dimensions", *allowed = "5 or 7 exponents [kg m s K mol A cd]", *plural = "";
};
template <>
struct Type<WordGroup>
{
    static constexpr const char *name = "words", *allowed = "a word or a list of words",
                                *plural = "words or lists of words";
};
template <>
struct Type<WordPair>
{
    static constexpr const char *name = "pair", *allowed = "two words and a number (a b 0.5)",
                                *plural = "two words and a number (a b 0.5)";
};
template <class T>
struct Type<std::vector<T>>
{
    static inline const std::string name = fmt::format("list of {}", Type<T>::plural);
    static inline const std::string allowed = fmt::format("a list ( ... ) of {}", Type<T>::plural);
};
} // namespace mpm::dictionary

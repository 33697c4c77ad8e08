#include "dictionary/value.hpp"

#include <charconv>
#include <cmath>

namespace mpm::dictionary
{
std::string shownValue(Rest rest)
{
    if (rest.empty())
        return "nothing";
    std::string out;
    const Token* before = nullptr;
    for (const Token* token = rest.at; token != rest.end && out.size() < 80; before = token++)
    {
        if (before && !before->is('(') && !before->is('[') && !token->is(')') && !token->is(']'))
            out += ' ';
        out += token->source();
    }
    return shownText(out);
}

std::string shownReason(Rest all, Rest stopped)
{
    if (stopped.empty())
        return "";
    std::string reason;
    if (all.end - all.at > 1)
        reason = fmt::format(", wrong at {}", stopped.at->shown());
    if (stopped.at->line > all.at->line)
        reason += fmt::format(" in line {}", stopped.at->line);
    double number = 0;
    Rest copy = stopped;
    if (stopped.at->kind == Kind::number && !take(copy, number))
        reason += " (beyond double precision)";
    return reason;
}

namespace
{
template <class Number>
bool takeNumber(Rest& rest, Number& value)
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
} // namespace

bool take(Rest& rest, double& value)
{
    return takeNumber(rest, value);
}

bool take(Rest& rest, Index& value)
{
    return takeNumber(rest, value);
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

bool take(Rest& rest, FormulaText& value)
{
    if (rest.empty())
        return false;
    const Token& token = *rest.at;
    double number = 0;
    if (token.kind == Kind::number ? !take(rest, number) : !take(rest, value.text))
        return false;
    value = {token.text, token.where()};
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

bool take(Rest& rest, TableRow& value)
{
    if (!rest.is('('))
        return false;
    value.where = rest.at->where();
    ++rest.at;
    if (!take(rest, value.at))
        return false;
    value.values.clear();
    if (rest.is('('))
    {
        if (!take(rest, value.values))
            return false;
    }
    else
        for (double number = 0; take(rest, number);)
            value.values.push_back(number);
    if (value.values.empty() || !rest.is(')'))
        return false;
    ++rest.at;
    return true;
}

bool take(Rest& rest, WordGroup& value)
{
    if (rest.is('('))
        return take(rest, value.words) && !value.words.empty();
    value.words.resize(1);
    return take(rest, value.words.front());
}

bool take(Rest& rest, WordPair& value)
{
    if (!rest.is('('))
        return false;
    ++rest.at;
    if (!take(rest, value.one) || !take(rest, value.other) || !take(rest, value.value) || !rest.is(')'))
        return false;
    ++rest.at;
    return true;
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

std::string shownDefault(const FormulaText& value)
{
    return value.text;
}

std::string shownDefault(const Dimensions& value)
{
    return exponentsText(value);
}

std::string shownDefault(const Vector3& value)
{
    return fmt::format("({} {} {})", value[0], value[1], value[2]);
}

std::string shownDefault(const TableRow& value)
{
    return fmt::format("({} ...)", value.at);
}

std::string shownDefault(const WordGroup& value)
{
    return value.words.size() == 1 ? value.words.front() : shownDefault(value.words);
}

std::string shownDefault(const WordPair& value)
{
    return fmt::format("({} {} {})", value.one, value.other, value.value);
}
} // namespace mpm::dictionary

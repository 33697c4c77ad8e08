#include "dictionary/expression.hpp"

#include "dictionary/token.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <muParser.h>
#include <mutex>
#include <numbers>

namespace mpm::dictionary
{
namespace
{
constexpr std::size_t longest = 1000;

/// muParser with a place for each variable. Its parsers keep values inside, so each serves one thread at a time.
struct Engine
{
    mu::Parser parser;
    std::vector<double> values;
};

std::unique_ptr<Engine> makeEngine(const std::string& text, const std::vector<std::string>& variables,
                                   const Constants& constants)
{
    auto engine = std::make_unique<Engine>();
    engine->values.assign(variables.size(), 0.0);
    auto& parser = engine->parser;
    parser.ClearConst();
    parser.DefineConst("pi", std::numbers::pi);
    for (const auto& [name, value] : constants)
        parser.DefineConst(name, value);
    for (std::size_t k = 0; k < variables.size(); ++k)
        parser.DefineVar(variables[k], &engine->values[k]);
    parser.SetExpr(text);
    return engine;
}

std::vector<std::string> functionNames()
{
    const mu::Parser parser;
    std::vector<std::string> names;
    for (const auto& [name, function] : parser.GetFunDef())
        names.push_back(name);
    return names;
}

std::string quoted(const std::string& text)
{
    return shownText('"' + text + '"');
}

/// Of the form letter or _, then letters, digits or _.
bool isName(const std::string& s)
{
    const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
    return !s.empty() && letter(s[0]) &&
           std::all_of(s.begin(), s.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

/// An '=' that is no comparison.
bool assigns(const std::string& s)
{
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s[i] == '=')
        {
            if (i + 1 < s.size() && s[i + 1] == '=')
                ++i;
            else if (i == 0 || (s[i - 1] != '<' && s[i - 1] != '>' && s[i - 1] != '!'))
                return true;
        }
    return false;
}

std::string allowedNames(const std::vector<std::string>& variables, const Constants& constants)
{
    std::vector<std::string> names = variables;
    names.push_back("pi");
    for (const auto& [name, value] : constants)
        names.push_back(name);
    return joinWords(names, ", ") + " and functions";
}

/// The name the parser stopped at, if it is one.
std::string nameAt(const std::string& text, int position)
{
    if (position < 0 || std::size_t(position) >= text.size())
        return "";
    std::size_t end = std::size_t(position);
    while (end < text.size() && isName("_" + text.substr(end, 1)))
        ++end;
    const std::string name = text.substr(std::size_t(position), end - std::size_t(position));
    return isName(name) ? name : "";
}

/// What is wrong, from what the parser says of it.
std::string complaint(const mu::ParserError& error, const std::string& text, const std::vector<std::string>& variables,
                      const Constants& constants)
{
    const int position = int(error.GetPos());
    if (const auto name = nameAt(text, position); error.GetCode() == mu::ecUNASSIGNABLE_TOKEN && !name.empty())
    {
        std::vector<std::string> known = functionNames();
        known.insert(known.end(), variables.begin(), variables.end());
        for (const auto& [constant, value] : constants)
            known.push_back(constant);
        known.push_back("pi");
        const std::string near = nearestWord(name, known);
        return fmt::format(", wrong at '{}', an unknown name{}; allowed {}, other names in constants {{ }}", name,
                           near.empty() ? "" : " (did you mean '" + near + "'?)", allowedNames(variables, constants));
    }
    const bool atEnd = position < 0 || std::size_t(position) >= text.size();
    return fmt::format(", wrong {}, allowed is a formula of {}",
                       atEnd ? "at its end" : "at " + quoted(text.substr(std::size_t(position))),
                       allowedNames(variables, constants));
}
} // namespace

struct Expression::Formula
{
    std::string text;
    Location where;
    std::optional<double> number;
    std::vector<std::string> variables, used;
    Constants constants;

    mutable std::mutex mutex;
    mutable std::vector<std::unique_ptr<Engine>> idle;

    std::unique_ptr<Engine> take() const
    {
        {
            const std::lock_guard lock(mutex);
            if (!idle.empty())
            {
                auto engine = std::move(idle.back());
                idle.pop_back();
                return engine;
            }
        }
        return makeEngine(text, variables, constants);
    }
    void giveBack(std::unique_ptr<Engine> engine) const
    {
        const std::lock_guard lock(mutex);
        idle.push_back(std::move(engine));
    }
};

Constants readConstants(const Dictionary& d, const std::vector<std::string>& variables)
{
    Constants constants;
    const Dictionary* own = d.findDict("constants", "names for numbers in formulas");
    if (!own)
        return constants;
    const auto functions = functionNames();
    for (const auto& word : own->words())
    {
        const double value = own->get<double>({word, "a constant"});
        if (!isName(word))
            own->fail(word, quoted(word), "a name of letters, digits and _");
        if (word == "pi" || std::find(variables.begin(), variables.end(), word) != variables.end() ||
            std::find(functions.begin(), functions.end(), word) != functions.end())
            own->fail(word, "a name that means something in formulas", "another name");
        constants[word] = value;
    }
    return constants;
}

Expression::Expression(double value) : Expression({fmt::format("{}", value), {}}, "value", {}, {}) {}
Expression::~Expression() = default;
Expression::Expression(const Expression&) = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(const Expression&) = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

Expression::Expression(const FormulaText& given, const std::string& word, const std::vector<std::string>& variables,
                       const Constants& constants)
{
    const auto fail = [&](const std::string& what) {
        throw InputError(given.where, fmt::format("{}: found {}{}", word, quoted(given.text), what));
    };
    auto formula = std::make_shared<Formula>();
    formula->text = given.text;
    formula->where = given.where;
    formula->variables = variables;
    formula->constants = constants;
    double number = 0;
    const char* const end = given.text.data() + given.text.size();
    if (const auto read = std::from_chars(given.text.data(), end, number); read.ec == std::errc() && read.ptr == end &&
                                                                           std::isfinite(number))
        formula->number = number;
    else if (given.text.size() > longest)
        fail(fmt::format(", {} characters; allowed are {}", given.text.size(), longest));
    else if (assigns(given.text))
        fail(" with '=', allowed is a formula: it has a value and assigns none (== compares)");
    else
        try
        {
            auto engine = formula->take();
            engine->parser.Eval();
            if (engine->parser.GetNumResults() != 1)
                fail(fmt::format(", {} values separated by ','; allowed is one", engine->parser.GetNumResults()));
            for (const auto& [name, address] : engine->parser.GetUsedVar())
                formula->used.push_back(name);
            formula->giveBack(std::move(engine));
        }
        catch (const mu::ParserError& error)
        {
            fail(complaint(error, given.text, variables, constants));
        }
    formula_ = formula;
}

std::optional<double> Expression::number() const
{
    return formula_->number;
}

bool Expression::uses(const std::string& variable) const
{
    return std::find(formula_->used.begin(), formula_->used.end(), variable) != formula_->used.end();
}

const std::string& Expression::text() const
{
    return formula_->text;
}

const Location& Expression::where() const
{
    return formula_->where;
}

Index Expression::evaluate(const std::vector<const double*>& variables, Index count, double* out) const
{
    if (const auto fixed = number())
    {
        std::fill_n(out, count, *fixed);
        return -1;
    }
    Index bad = -1;
    auto engine = formula_->take();
    for (Index i = 0; i < count; ++i)
    {
        for (std::size_t k = 0; k < variables.size(); ++k)
            if (variables[k])
                engine->values[k] = variables[k][i];
        try
        {
            out[i] = engine->parser.Eval();
        }
        catch (const mu::ParserError&) // an argument a function cannot take
        {
            out[i] = std::numeric_limits<double>::quiet_NaN();
        }
        if (bad < 0 && !std::isfinite(out[i]))
            bad = i;
    }
    formula_->giveBack(std::move(engine));
    return bad;
}

double Expression::evaluate(const std::vector<double>& variables) const
{
    std::vector<const double*> at;
    for (const double& value : variables)
        at.push_back(&value);
    double out = 0;
    evaluate(at, 1, &out);
    return out;
}

VectorExpression readVectorExpression(const Dictionary& d, const std::string& word, const std::string& help,
                                      const Dimensions& dimensions, int dim, const std::vector<std::string>& variables,
                                      const Constants& constants, bool required)
{
    Entry<std::vector<FormulaText>> entry{word, help, dimensions, {}, std::nullopt};
    if (!required)
        entry.fallback = std::vector<FormulaText>(3, {"0", {}});
    const auto given = d.get<std::vector<FormulaText>>(entry);
    if (given.size() != 3 && !(dim == 2 && given.size() == 2))
        d.fail(word, fmt::format("{} components", given.size()),
               dim == 2 ? "2 or 3, (x y 0), numbers or formulas in double quotes"
                        : "3, (x y z), numbers or formulas in double quotes");
    VectorExpression out;
    for (std::size_t a = 0; a < given.size(); ++a)
        out[a] = Expression(given[a], word, variables, constants);
    if (dim == 2 && out[2].number() != 0.0)
        d.fail(word, fmt::format("z component {}", out[2].text()), "0 in 2D");
    return out;
}
} // namespace mpm::dictionary

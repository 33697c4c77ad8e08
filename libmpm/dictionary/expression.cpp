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

std::optional<double> numberIn(const std::string& text)
{
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc() && read.ptr == end && std::isfinite(number) ? std::optional(number) : std::nullopt;
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

std::vector<std::string> knownNames(const std::vector<std::string>& variables, const Constants& constants)
{
    std::vector<std::string> names = variables;
    names.push_back("pi");
    for (const auto& constant : constants)
        names.push_back(constant.name);
    return names;
}

std::string allowedNames(const std::vector<std::string>& variables, const Constants& constants)
{
    return joinWords(knownNames(variables, constants), ", ") + " and functions";
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
        std::vector<std::string> known = knownNames(variables, constants);
        const auto functions = functionNames();
        known.insert(known.end(), functions.begin(), functions.end());
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

/// What an expression is made of: constants that are formulas, then itself, each with the variables and the ones before
/// it.
struct Expression::Formula
{
    std::string text;
    Location where;
    std::optional<double> number;
    std::vector<std::string> variables, used;
    Constants constants; ///< numbers and, of formulas, those that are used

    /// Parsers of all formulas and the values they read. Each serves one thread at a time.
    struct Engine
    {
        std::vector<double> values; ///< of the variables, then of constants that are formulas
        std::vector<mu::Parser> parsers;

        double evaluate()
        {
            const std::size_t first = values.size() - (parsers.size() - 1);
            for (std::size_t k = 0; k + 1 < parsers.size(); ++k)
                values[first + k] = parsers[k].Eval();
            return parsers.back().Eval();
        }
    };
    mutable std::mutex mutex;
    mutable std::vector<std::unique_ptr<Engine>> idle;

    std::unique_ptr<Engine> makeEngine() const
    {
        auto engine = std::make_unique<Engine>();
        engine->values.assign(variables.size() + constants.size(), 0.0);
        std::size_t known = variables.size();
        mu::Parser parser;
        parser.ClearConst();
        parser.DefineConst("pi", std::numbers::pi);
        for (std::size_t k = 0; k < variables.size(); ++k)
            parser.DefineVar(variables[k], &engine->values[k]);
        for (const auto& constant : constants)
            if (const auto value = numberIn(constant.formula.text))
                parser.DefineConst(constant.name, *value);
            else
            {
                parser.SetExpr(constant.formula.text);
                engine->parsers.push_back(parser);
                parser.DefineVar(constant.name, &engine->values[known++]);
            }
        engine->values.resize(known); // shrinks in place
        parser.SetExpr(text);
        engine->parsers.push_back(parser);
        return engine;
    }

    /// Leaves out constants nobody uses; notes the variables that are.
    void prune(Engine& engine)
    {
        std::vector<std::string> names;
        const auto note = [&names](mu::Parser& parser) {
            for (const auto& [name, address] : parser.GetUsedVar())
                names.push_back(name);
        };
        const auto wanted = [&names](const std::string& name) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        note(engine.parsers.back());
        std::size_t parser = engine.parsers.size() - 1;
        for (std::size_t k = constants.size(); k-- > 0;)
            if (!numberIn(constants[k].formula.text))
            {
                --parser;
                if (wanted(constants[k].name))
                    note(engine.parsers[parser]);
                else
                    constants.erase(constants.begin() + std::ptrdiff_t(k));
            }
        std::copy_if(variables.begin(), variables.end(), std::back_inserter(used), wanted);
    }

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
        return makeEngine();
    }
    void giveBack(std::unique_ptr<Engine> engine) const
    {
        const std::lock_guard lock(mutex);
        idle.push_back(std::move(engine));
    }
};

Constant::Constant(std::string n, double value) : name(std::move(n)), formula{fmt::format("{}", value), {}} {}

Constants readConstants(const Dictionary& d, const std::vector<std::string>& variables)
{
    Constants constants;
    const Dictionary* own = d.findDict("constants", "names for numbers in formulas");
    if (!own)
        return constants;
    const auto functions = functionNames();
    for (const auto& word : own->words())
    {
        const auto formula = own->get<FormulaText>({word, "a constant"});
        if (!isName(word))
            own->fail(word, quoted(word), "a name of letters, digits and _");
        if (word == "pi" || std::find(variables.begin(), variables.end(), word) != variables.end() ||
            std::find(functions.begin(), functions.end(), word) != functions.end())
            own->fail(word, "a name that means something in formulas", "another name");
        Expression(formula, "constants." + word, variables, constants); // throws what is wrong with it
        constants.emplace_back(word, formula);
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
    formula->number = numberIn(given.text);
    formula_ = formula;
    if (formula->number)
        return;
    if (given.text.size() > longest)
        fail(fmt::format(", {} characters; allowed are {}", given.text.size(), longest));
    if (assigns(given.text))
        fail(" with '=', allowed is a formula: it has a value and assigns none (== compares)");
    try
    {
        const auto engine = formula->makeEngine();
        engine->evaluate();
        if (const int results = engine->parsers.back().GetNumResults(); results != 1)
            fail(fmt::format(", {} values separated by ','; allowed is one", results));
        formula->prune(*engine);
    }
    catch (const mu::ParserError& error)
    {
        fail(complaint(error, given.text, variables, constants));
    }
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
            out[i] = engine->evaluate();
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

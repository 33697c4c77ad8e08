#include "case/accuracyExact.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Dictionary;
using dictionary::FormulaText;

namespace
{
const std::vector<std::string> variables = {"X", "Y", "Z", "t"};
} // namespace

ExactSolution::ExactSolution(const Dictionary& exact, int dim)
{
    namespace unit = dictionary::unit;
    const auto constants = dictionary::readConstants(exact, variables);
    for (const auto& [field, dimensions] : {std::pair{"position", unit::length},
                                            {"displacement", unit::length},
                                            {"velocity", unit::velocity},
                                            {"stress", unit::pressure}})
    {
        if (!exact.found(field))
            continue;
        const bool tensor = field == std::string("stress");
        const auto texts = exact.get<std::vector<FormulaText>>({field, "at X Y Z and t", dimensions});
        const std::size_t needed = std::size_t(tensor ? stressComponents(dim) : dim);
        if (texts.size() < needed || texts.size() > (tensor ? 6 : 3))
            exact.fail(field, fmt::format("{} components", texts.size()),
                       tensor ? fmt::format("{} (xx yy zz xy{})", needed, dim == 3 ? " yz zx" : "")
                              : fmt::format("{}", needed));
        for (const auto& text : texts)
            functions_[field].emplace_back(text, field, variables, constants);
    }
    if (functions_.count("position") && functions_.count("displacement"))
        exact.fail("displacement", "position as well", "one of them: they give each other");
}

bool ExactSolution::has(const std::string& field) const
{
    return functions_.count(field) || (field == "position" && functions_.count("displacement")) ||
           (field == "displacement" && functions_.count("position"));
}

double ExactSolution::value(const std::string& field, int component, const Vector3& X, double t) const
{
    const auto c = std::size_t(component);
    const auto at = [&](const std::string& name) {
        const auto& formula = functions_.at(name)[c];
        const double value = formula.evaluate({X[0], X[1], X[2], t});
        if (!std::isfinite(value))
            throw InputError(formula.where(), fmt::format("{}: found no number for {} at X = {:g}, Y = {:g}, Z = {:g}, "
                                                          "t = {:g} s",
                                                          name, formula.text(), X[0], X[1], X[2], t));
        return value;
    };
    if (functions_.count(field))
        return at(field);
    return field == "position" ? X[c] + at("displacement") : at("position") - X[c];
}
} // namespace mpm::cases

#include "case/accuracyExact.hpp"

namespace mpm::cases
{
using dictionary::Dictionary;

ExactSolution::ExactSolution(const Dictionary& exact, int dim)
{
    for (const std::string field : {"position", "displacement", "velocity", "stress"})
        if (exact.found(field))
        {
            const auto numbers = exact.get<std::vector<double>>({field, "at X and t"});
            if (numbers.size() < std::size_t(field == "stress" ? stressComponents(dim) : dim))
                exact.fail(field, "too few", "all components");
            for (const double value : numbers)
                functions_[field].push_back([value](const Vector3&, double) { return value; });
        }
}

double ExactSolution::value(const std::string& field, int component, const Vector3& X, double t) const
{
    return functions_.at(field)[std::size_t(component)](X, t);
}
} // namespace mpm::cases

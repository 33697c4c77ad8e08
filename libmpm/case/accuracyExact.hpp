#pragma once
/// An exact solution given by the user: `exact` in system/accuracyCostDict.
///
///     exact
///     {
///         constants       { A 0.05; c 100; }
///         displacement    ("A*sin(pi*X)*sin(c*pi*t)" 0 0);        // [m] or position
///         velocity        ("A*c*pi*sin(pi*X)*cos(c*pi*t)" 0 0);   // [m/s]
///         stress          (0 "-80*10*(50 - Y)" 0 0);              // [Pa] xx yy zz xy, in 3D also yz zx
///     }
///
/// Numbers, or formulas in double quotes (dictionary/expression.hpp). X Y Z are material positions (those of the first
/// state), t the time. Position and displacement give each other.
#include "base/types.hpp"
#include "dictionary/expression.hpp"

#include <map>
#include <string>
#include <vector>

namespace mpm::cases
{
class ExactSolution
{
  public:
    ExactSolution() = default;
    ExactSolution(const dictionary::Dictionary& exact, int dim);

    bool has(const std::string& field) const;
    double value(const std::string& field, int component, const Vector3& X, double t) const;

  private:
    std::map<std::string, std::vector<dictionary::Expression>> functions_;
};
} // namespace mpm::cases

#pragma once
/// Internal to dictionary/: what is behind a TimeFunction, and the one of formulas.
#include "dictionary/timeFunction.hpp"

namespace mpm::dictionary
{
class TimeFunction::Source
{
  public:
    using Integrals = TimeFunction::Integrals;
    virtual ~Source() = default;
    virtual Vector3 value(double t) const = 0;
    virtual Vector3 derivative(double t) const = 0;
    virtual Integrals from0(double t) const = 0;
    virtual Integrals over(double t, double dt) const = 0;
    virtual const Vector3* constant() const { return nullptr; }
    /// Is a component the same number for ever?
    virtual bool fixed(std::size_t component, double& number) const = 0;
};

std::shared_ptr<const TimeFunction::Source> makeFormulaSource(const VectorExpression& formulas,
                                                              const std::string& word);
} // namespace mpm::dictionary

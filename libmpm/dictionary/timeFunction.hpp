#pragma once
/// A vector prescribed as a function of time, with its integrals over time: of constants and tables exact, of formulas
/// by Gauss and Kronrod's rule (7, 15 points; Kronrod 1965) on panels halved until both agree to 1e-12.
///
///     word (0.1 0 0);                                   // numbers, or
///     word ("0.1*sin(2*pi*f*t)" 0 0);                   // formulas of t [s] (dictionary/expression.hpp), or
///     word table ((0 (0 0 0)) (1 (0.1 0 0)));           // times and values, straight lines between, or
///     word                                              // a CSV file of the case with a header line: times, then one,
///     {                                                 // two or three columns of values
///         file      "constant/quake.csv";
///         direction (1 0 0);                            // for one column of values
///         scale     9.81;                               // default 1
///     }
///     constants { f 2.5; }                              // beside it, for formulas
///
/// Beyond its ends a table holds its first and last value, or is zero there (what the reader asks for). Times of a
/// table rise. Integrals begin at t = 0.
///
/// Evaluation is safe in several threads and depends on nothing but t, so a continued run finds the same bits. A
/// formula that is not finite is an InputError at t = 0 and a StepError later. Verified in tests/unit/timeFunction.cpp.
#include "dictionary/expression.hpp"

namespace mpm::dictionary
{
class TimeFunction
{
  public:
    /// What a table is beyond its ends.
    enum class Beyond
    {
        holds,
        zero
    };
    struct Integrals
    {
        Vector3 once{};  ///< int f
        Vector3 twice{}; ///< int int f
    };

    /// A constant.
    explicit TimeFunction(const Vector3& value = {});
    /// Formulas of the variable t; `word` for messages.
    TimeFunction(const VectorExpression& formulas, const std::string& word);
    /// A table; times rise.
    TimeFunction(std::vector<double> times, std::vector<Vector3> values, Beyond beyond);

    /// Reads the entry `word`. components 3: a vector (in 2D its third is 0); 1: a number, in the first component.
    static TimeFunction read(const Dictionary& d, const std::string& word, const std::string& help,
                             const Dimensions& dimensions, int dim, Beyond beyond, int components = 3);

    Vector3 value(double t) const;
    /// df/dt; of a table the slope that follows t.
    Vector3 derivative(double t) const;
    /// From 0 to t.
    Integrals integrals(double t) const;
    /// From t to t + dt, as exact as dt is small: `twice` is int (t + dt - s) f(s) ds.
    Integrals integrals(double t, double dt) const;
    /// The constant it is, if it is one.
    const Vector3* constant() const;
    /// The number one component is for ever, if it is.
    std::optional<double> number(std::size_t component) const;
    /// Largest magnitude of f in [t, t + dt], from the ends and the middle.
    double magnitude(double t, double dt) const;
    /// "(0.1 0 0)", "(0.1*sin(t) 0 0)", "a table of 3 times".
    const std::string& describe() const { return text_; }

    class Source; ///< timeIntegrals.hpp

  private:
    explicit TimeFunction(std::shared_ptr<const Source> source, std::string text);
    std::shared_ptr<const Source> source_;
    std::string text_;
};
} // namespace mpm::dictionary

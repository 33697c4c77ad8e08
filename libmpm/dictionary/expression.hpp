#pragma once
/// Formulas a user writes for a number that varies, evaluated by muParser.
///
///     value ("A*sin(pi*X)*cos(c*t)" 0 -9.81);     // numbers, or formulas in double quotes; in 2D the third is 0 or
///     absent constants { A 0.05; c 100; R "sqrt(X^2 + Y^2)"; s "A*sin(c*pi*t)"; }   // names of one's own
///
/// Names: the variables of the place where the formula stands (x y z X Y Z t ...), the constants, pi. A constant is a
/// number, or a formula of the variables and of the constants before it. Operators + - * / ^
/// < > <= >= == != && || and `condition ? a : b`; -2^2 is -4. Functions sin cos tan asin acos atan atan2 sinh cosh tanh
/// asinh acosh atanh sqrt exp ln log (both natural) log10 log2 abs sign rint min max sum avg; angles in rad.
///
/// Errors (InputError, file:line): an unknown name with the nearest known one, bad syntax with the place, '=' (there is
/// nothing to assign to), more than one value, more than 1000 characters; a constant whose name is none or already
/// means something.
#include "dictionary/dictionary.hpp"

namespace mpm::dictionary
{
struct Constant
{
    Constant(std::string n, double value);
    Constant(std::string n, FormulaText text) : name(std::move(n)), formula(std::move(text)) {}

    std::string name;
    FormulaText formula;
};
using Constants = std::vector<Constant>; ///< in the order of the dictionary

/// The dictionary `constants` inside d, if it is there. None may be called like one of the variables, a function or pi.
Constants readConstants(const Dictionary& d, const std::vector<std::string>& variables);

class Expression
{
  public:
    /// A number.
    Expression(double value = 0);
    /// `word` is the entry it was found at, for messages. The constants must be good ones (readConstants).
    Expression(const FormulaText& formula, const std::string& word, const std::vector<std::string>& variables,
               const Constants& constants);
    ~Expression();
    Expression(const Expression&);
    Expression(Expression&&) noexcept;
    Expression& operator=(const Expression&);
    Expression& operator=(Expression&&) noexcept;

    /// The number, if it was written as one.
    std::optional<double> number() const;
    bool uses(const std::string& variable) const; ///< itself, or a constant it uses
    const std::string& text() const;
    const Location& where() const;

    /// out[i] = value at variables[k][i], k in the order given to the constructor; variables not used may be null. May
    /// be called by several threads at once; the same numbers always give the same bits. Returns the first i whose
    /// value is not finite, or -1.
    Index evaluate(const std::vector<const double*>& variables, Index count, double* out) const;
    double evaluate(const std::vector<double>& variables) const;

  private:
    struct Formula;
    std::shared_ptr<const Formula> formula_;
};

/// The components of a vector.
using VectorExpression = std::array<Expression, 3>;

/// Reads `word (a b c);`, each a number or a formula; with dim 2 the third must be 0 or absent. Absent: zero.
VectorExpression readVectorExpression(const Dictionary& d, const std::string& word, const std::string& help,
                                      const Dimensions& dimensions, int dim, const std::vector<std::string>& variables,
                                      const Constants& constants, bool required);
} // namespace mpm::dictionary

#pragma once
/// A body force per unit mass that a user writes as formulas of place and time (manufactured solutions):
///
///     // constant/bodyForce; absent: none. Beside gravity (constant/g), not instead of it
///     value     ("A*sin(pi*X)*sin(c*pi*t)" 0 0);   // [m/s^2]; numbers or formulas, in 2D the third is 0 or absent
///     constants { A 0.05; c 100; }
///
/// Variables: x y z, where the particle is; X Y Z, where it was at the start (state/particles.hpp); t, the time at the
/// start of the step. Formulas: dictionary/expression.hpp.
///
/// Errors: InputError with file:line for a formula that cannot be read; StepError naming particle and time where the
/// value is not finite.
#include "dictionary/expression.hpp"
#include "stepping/stepper.hpp"

#include <atomic>
#include <map>
#include <mutex>

namespace mpm::cases
{
/// "x", "y", "X", "Y", "t" in 2D.
std::vector<std::string> placeVariables(int dim);

class ExpressionForce : public stepping::BodyForce
{
  public:
    ExpressionForce(dictionary::VectorExpression value, int dim);

    void acceleration(const state::Particles& particles, Index first, int count, double time,
                      double (&b)[3][lanes]) const override;
    std::string takeFault() const override;
    /// Processor time that evaluating took so far, of all threads [s].
    double seconds() const { return seconds_; }

    /// The first component that uses X, Y or Z, or null.
    const dictionary::Expression* usesReference() const;
    /// "(A*sin(pi*X) 0 0)"
    std::string describe() const;

  private:
    dictionary::VectorExpression value_;
    int dim_;
    mutable std::atomic<double> seconds_ = 0;
    mutable std::mutex mutex_;
    mutable std::map<std::int64_t, std::string> faults_; ///< by particle id
};

/// Reads constant/bodyForce; null if it is zero.
std::shared_ptr<const ExpressionForce> readBodyForce(const dictionary::Dictionary& bodyForce, int dim);

/// Who wants the position at the start: `what` for messages, written at `where`.
struct ReferenceWanted
{
    Location where;
    std::string what;
};

/// `fields (referencePosition);` of system/controlDict: what is stored beyond what the method needs.
std::optional<ReferenceWanted> readFields(const dictionary::Dictionary& controlDict);

/// Gives a state of step 0 its reference positions. A later one has them or is refused: where its particles started is
/// not known any more.
void provideReference(state::State& state, const ReferenceWanted& wanted);
} // namespace mpm::cases

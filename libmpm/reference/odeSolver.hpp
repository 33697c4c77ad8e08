#pragma once
/// Ordinary differential equations y' = g(t, y) with events, by SUNDIALS CVODE (Adams formulas of variable order,
/// fixed-point iteration), behind a plain interface.
///
/// One call of advance() is one internal step. A root of an event function ends the step there; the multistep history
/// has no meaning beyond a jump of the right-hand side, so restart() must follow (it calls CVodeReInit).
///
///     OdeSolver ode(2, 1e-12, 1e-14, rhs);
///     ode.restart(0, {1, 0});
///     while (ode.advance(1.0) != OdeSolver::Stop::end) {}
///
/// Errors: StepError with the name of CVODE's flag; what the right-hand side throws passes through.
#include <functional>
#include <memory>
#include <vector>

namespace mpm::reference
{
/// An event: a function whose sign change stops the solver.
struct OdeEvents
{
    /// Values of all event functions at (t, y).
    std::function<void(double t, const double* y, double* values)> functions;
    /// -1: only from + to -, +1: only from - to +, 0: both; one entry an event.
    std::vector<int> directions;
};

class OdeSolver
{
  public:
    using RightHandSide = std::function<void(double t, const double* y, double* rate)>;
    enum class Stop
    {
        step, ///< an internal step, the end is not reached
        event,
        end
    };

    OdeSolver(std::size_t size, double relativeTolerance, double absoluteTolerance, RightHandSide rhs);
    /// With an absolute tolerance for each unknown.
    OdeSolver(double relativeTolerance, const std::vector<double>& absoluteTolerances, RightHandSide rhs);
    ~OdeSolver();
    OdeSolver(const OdeSolver&) = delete;
    OdeSolver& operator=(const OdeSolver&) = delete;

    /// Starts anew at (t, y), forgetting the history, with these events.
    void restart(double t, const std::vector<double>& y, OdeEvents events = {});
    /// No internal step is longer: events between two steps that cancel each other are not seen.
    void limitStep(double longest);
    /// One internal step, at most to `end` > time().
    Stop advance(double end);

    double time() const;
    const std::vector<double>& state() const;
    /// After Stop::event: which events it was.
    std::vector<bool> happened() const;
    /// Evaluations of the right-hand side since construction.
    long evaluations() const;

  private:
    struct Body;
    std::unique_ptr<Body> body_;
};
} // namespace mpm::reference

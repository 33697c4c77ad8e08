#pragma once
/// A wall on a spring and a damper that something pushes, integrated by SUNDIALS CVODE: the partner of coupled scenes.
///
///     m x'' + c x' + k x = F(t)
///
/// (any textbook of vibrations). F is linear within a window, constant where both ends are the same. The work of the
/// force and the heat of the damper are unknowns of the same system, so that the books close to the solver's tolerance:
///
///     work' = F v,   heat' = c v^2:     m v^2/2 + k x^2/2 + heat = what was there + work
///
///     SpringWall wall({.mass = 5e3, .damping = 0, .stiffness = 2e6});
///     const auto start = wall.save();
///     wall.advance(0.01, force, force);        // a window of 0.01 s
///     wall.restore(start);                     // implicit coupling: the window is repeated, bitwise if F is the same
///
/// Each window starts CVODE anew, as F has a kink there: what comes out of it depends on save() and F alone.
/// In 2D m, c, k and F are per metre of thickness. Errors: InputError for a mass that is not positive, negative damping
/// or stiffness, a window that is not; StepError from CVODE. Verified in tests/unit/springWall.cpp.
#include "reference/odeSolver.hpp"

#include <array>

namespace mpm::reference
{
struct SpringWallProperties
{
    double mass = 1;      ///< m [kg]
    double damping = 0;   ///< c [N s/m]
    double stiffness = 0; ///< k [N/m]
};

struct SpringWallState
{
    double time = 0, position = 0, velocity = 0; ///< x from where the spring is at rest [m]
    double work = 0, heat = 0;                   ///< of the force, of the damper, so far [J]
};

class SpringWall
{
  public:
    using State = SpringWallState;

    explicit SpringWall(const SpringWallProperties& properties, const State& start = {}, double tolerance = 1e-11);

    /// A window with a force that goes from `first` to `last` [N].
    void advance(double window, double first, double last);

    const State& state() const { return state_; }
    double kineticEnergy() const;
    double springEnergy() const;

    State save() const { return state_; }
    void restore(const State& state) { state_ = state; }

  private:
    SpringWallProperties properties_;
    State state_;
    double window_ = 1, first_ = 0, last_ = 0;
    OdeSolver ode_;
};
} // namespace mpm::reference

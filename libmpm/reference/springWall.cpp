#include "reference/springWall.hpp"

#include "base/error.hpp"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mpm::reference
{
namespace
{
SpringWallProperties checked(const SpringWallProperties& p)
{
    const auto refuse = [](const char* what, double found, const char* allowed) {
        throw InputError(fmt::format("spring wall: found {} {:g}, allowed {}", what, found, allowed));
    };
    if (!(p.mass > 0) || !std::isfinite(p.mass))
        refuse("a mass of", p.mass, "> 0");
    if (!(p.damping >= 0) || !std::isfinite(p.damping))
        refuse("a damping of", p.damping, ">= 0");
    if (!(p.stiffness >= 0) || !std::isfinite(p.stiffness))
        refuse("a stiffness of", p.stiffness, ">= 0");
    return p;
}
} // namespace

SpringWall::SpringWall(const SpringWallProperties& properties, const State& start, double tolerance)
    : properties_(checked(properties)), state_(start),
      ode_(4, tolerance, 1e-3 * tolerance, [this](double t, const double* y, double* rate) {
          const auto& [m, c, k] = properties_;
          const double force = std::lerp(first_, last_, t / window_);
          rate[0] = y[1];
          rate[1] = (force - c * y[1] - k * y[0]) / m;
          rate[2] = force * y[1];
          rate[3] = c * y[1] * y[1];
      })
{}

void SpringWall::advance(double window, double first, double last)
{
    if (!(window > 0) || !std::isfinite(window))
        throw InputError(fmt::format("spring wall: found a window of {:g} s, allowed > 0", window));
    window_ = window;
    first_ = first;
    last_ = last;
    // time and energies from the window's start: what a window does must not drown in what was before
    ode_.restart(0, {state_.position, state_.velocity, 0, 0});
    while (ode_.advance(window) != OdeSolver::Stop::end)
    {}
    const auto& y = ode_.state();
    state_ = {state_.time + window, y[0], y[1], state_.work + y[2], state_.heat + y[3]};
}

double SpringWall::kineticEnergy() const
{
    return 0.5 * properties_.mass * state_.velocity * state_.velocity;
}

double SpringWall::springEnergy() const
{
    return 0.5 * properties_.stiffness * state_.position * state_.position;
}
} // namespace mpm::reference

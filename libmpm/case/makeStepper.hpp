#pragma once
/// The one place where words become types: the stepper for a shape's name and a state's dimension.
#include "stepping/rungeKutta.hpp"
#include "stepping/stepper.hpp"

namespace mpm::cases
{
/// Names and help of the shapes, the default first.
const std::vector<dictionary::Choice>& shapeCatalogue();
/// Does the stability limit stay as nodes empty? (All shapes but hat functions.)
bool limitIgnoresMass(const std::string& shape);
/// Do domains reach more nodes as particles stretch, so that a step gets dearer? (cpGIMP.)
bool widensWithStretch(const std::string& shape);
/// Throws InputError for a name that is not in the catalogue.
std::unique_ptr<stepping::Stepper> makeStepper(const std::string& shape, state::State& state,
                                               const stepping::Scene& scene);
/// The semi-discrete equations of a scene. Throws InputError with the reason where they are not smooth: the shape's
/// gradients jump, or something of the scene does (stepping/rungeKutta.hpp).
std::unique_ptr<semiDiscrete::SemiDiscrete> makeSemiDiscrete(const std::string& shape, const state::State& state,
                                                             const stepping::Scene& scene);
/// Empty, or why the above would throw.
std::string whyNotSmooth(const std::string& shape, const stepping::Scene& scene);
/// A Runge-Kutta step on them.
std::unique_ptr<stepping::Stepper> makeRungeKutta(const std::string& shape, stepping::RungeKuttaOrder order,
                                                  state::State& state, const stepping::Scene& scene);
} // namespace mpm::cases

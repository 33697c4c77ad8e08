#pragma once
/// The one place where words become types: the stepper for a shape's name and a state's dimension.
#include "stepping/stepper.hpp"

namespace mpm::cases
{
/// Names and help of the shapes, the default first.
const std::vector<dictionary::Choice>& shapeCatalogue();
/// Does the stability limit stay as nodes empty? (All shapes but hat functions.)
bool limitIgnoresMass(const std::string& shape);
/// Throws InputError for a name that is not in the catalogue.
std::unique_ptr<stepping::Stepper> makeStepper(const std::string& shape, state::State& state,
                                               const stepping::Scene& scene);
} // namespace mpm::cases

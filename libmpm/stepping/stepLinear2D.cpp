#include "shape/linear.hpp"
#include "stepping/explicitStepper.ipp"

template std::unique_ptr<mpm::stepping::Stepper>
mpm::stepping::makeExplicitStepper<2, mpm::shape::Linear>(mpm::state::State&, const mpm::stepping::Scene&);

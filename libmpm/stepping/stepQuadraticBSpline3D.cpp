#include "shape/quadraticBSpline.hpp"
#include "stepping/explicitStepper.ipp"

template std::unique_ptr<mpm::stepping::Stepper>
mpm::stepping::makeExplicitStepper<3, mpm::shape::QuadraticBSpline>(mpm::state::State&, const mpm::stepping::Scene&);

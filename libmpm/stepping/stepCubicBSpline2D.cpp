#include "shape/cubicBSpline.hpp"
#include "stepping/explicitStepper.ipp"

template std::unique_ptr<mpm::stepping::Stepper>
mpm::stepping::makeExplicitStepper<2, mpm::shape::CubicBSpline>(mpm::state::State&, const mpm::stepping::Scene&);

#include "shape/CPDI.hpp"
#include "stepping/explicitStepper.ipp"

template std::unique_ptr<mpm::stepping::Stepper>
mpm::stepping::makeExplicitStepper<3, mpm::shape::CPDI>(mpm::state::State&, const mpm::stepping::Scene&);

#include "semiDiscrete/equations.ipp"
#include "shape/quadraticBSpline.hpp"

template std::unique_ptr<mpm::semiDiscrete::SemiDiscrete>
mpm::semiDiscrete::makeSemiDiscrete<3, mpm::shape::QuadraticBSpline>(const mpm::state::State&, Model);

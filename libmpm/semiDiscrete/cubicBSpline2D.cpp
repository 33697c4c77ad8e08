#include "semiDiscrete/equations.ipp"
#include "shape/cubicBSpline.hpp"

template std::unique_ptr<mpm::semiDiscrete::SemiDiscrete>
mpm::semiDiscrete::makeSemiDiscrete<2, mpm::shape::CubicBSpline>(const mpm::state::State&, Model);

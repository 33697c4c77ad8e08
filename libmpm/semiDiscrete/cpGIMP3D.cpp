#include "semiDiscrete/equations.ipp"
#include "shape/cpGIMP.hpp"

template std::unique_ptr<mpm::semiDiscrete::SemiDiscrete>
mpm::semiDiscrete::makeSemiDiscrete<3, mpm::shape::CpGIMP>(const mpm::state::State&, Model);

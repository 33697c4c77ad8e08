#include "semiDiscrete/equations.ipp"
#include "shape/uGIMP.hpp"

template std::unique_ptr<mpm::semiDiscrete::SemiDiscrete>
mpm::semiDiscrete::makeSemiDiscrete<2, mpm::shape::UGIMP>(const mpm::state::State&, Model);

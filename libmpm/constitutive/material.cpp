#include "constitutive/material.hpp"

#include <cmath>

namespace mpm::constitutive
{
double Material::waveSpeed() const
{
    return std::sqrt(law->waveModulus() / density);
}
} // namespace mpm::constitutive

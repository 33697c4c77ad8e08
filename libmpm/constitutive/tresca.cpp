#include "constitutive/tresca.hpp"

#include <fmt/format.h>

namespace mpm::constitutive
{
Tresca Tresca::read(const dictionary::Dictionary& material)
{
    const MohrCoulombParameters p = readParameters(material, false);
    return Tresca(p, readSubstep(material));
}

std::string Tresca::describe() const
{
    const auto& p = parameters();
    return fmt::format("tresca: E {:g} Pa, nu {:g}, cohesion {:g} Pa{}", p.moduli.young, p.moduli.poisson, p.cohesion,
                       describeRest());
}
} // namespace mpm::constitutive

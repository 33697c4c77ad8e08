#pragma once
/// A material of the scene: its name, reference density and law.
#include "constitutive/law.hpp"

namespace mpm::constitutive
{
struct Material
{
    std::string name;
    double density = 0; ///< rho_0 [kg/m^3]
    std::shared_ptr<const Law> law;

    /// P-wave speed sqrt(M/rho_0) [m/s].
    double waveSpeed() const;
};
} // namespace mpm::constitutive

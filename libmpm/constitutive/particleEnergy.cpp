#include "constitutive/particleEnergy.hpp"

#include <algorithm>
#include <type_traits>

namespace mpm::constitutive
{
namespace
{
/// W(F) of one particle.
template <int dim>
double storedEnergy(const state::Particles& p, std::size_t i, const Hyperelastic& law)
{
    alignas(64) TensorLanes<dim> F;
    alignas(64) double energy[lanes];
    for (int k = 0; k < dim * dim; ++k)
        std::fill_n(F[k], lanes, p.F[std::size_t(k)][i]);
    law.strainEnergy(F, energy);
    return energy[0];
}
} // namespace

double particleEnergy(const state::Particles& p, std::size_t i, const Law& law)
{
    if (const auto* hyperelastic = law.hyperelastic())
        return p.volume0[i] *
               (p.dim == 2 ? storedEnergy<2>(p, i, *hyperelastic) : storedEnergy<3>(p, i, *hyperelastic));
    double sigma[6] = {};
    for (int k = 0; k < stressComponents(p.dim); ++k)
        sigma[k] = p.stress[k][i];
    return p.volume[i] * elasticEnergyDensity<3>(sigma, law.bulkModulus(), law.shearModulus());
}
} // namespace mpm::constitutive

#include "constitutive/linearElastic.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::constitutive
{
namespace
{
template <int dim>
void updateElastic(Chunk<dim>& chunk, const ElasticModuli& moduli)
{
    alignas(64) double trial[stressSize<dim>][lanes];
    elasticTrial<dim>(chunk, moduli, trial);
    std::copy(&trial[0][0], &trial[0][0] + stressSize<dim> * lanes, &chunk.stress[0][0]);
    reportElastic(chunk);
}
} // namespace

LinearElastic::LinearElastic(const ElasticModuli& moduli) : moduli_(moduli)
{
    requireModuli(moduli);
}

LinearElastic LinearElastic::read(const dictionary::Dictionary& material)
{
    return LinearElastic(readModuli(material));
}

std::string LinearElastic::describe() const
{
    return fmt::format("linearElastic: E {:g} Pa, nu {:g}", moduli_.young, moduli_.poisson);
}

void LinearElastic::update(Chunk<2>& chunk) const
{
    updateElastic(chunk, moduli_);
}

void LinearElastic::update(Chunk<3>& chunk) const
{
    updateElastic(chunk, moduli_);
}
} // namespace mpm::constitutive

#include "constitutive/vonMises.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::constitutive
{
namespace
{
/// Only the deviator yields, so the plastic work of the mid-step stress is (s_start + s_end)/2 : (s_trial - s_end)/(2
/// G).
template <int dim>
void updateChunk(Chunk<dim>& chunk, const ElasticModuli& moduli, double yieldStress)
{
    constexpr int nc = stressSize<dim>;
    alignas(64) double trials[nc][lanes];
    elasticTrial<dim>(chunk, moduli, trials);
    const double radius = std::sqrt(2.0 / 3) * yieldStress, quarterOverG = 0.25 / moduli.shear();
    for (int l = 0; l < lanes; ++l)
    {
        const double mean = (trials[0][l] + trials[1][l] + trials[2][l]) * (1.0 / 3);
        const double meanStart = (chunk.stress[0][l] + chunk.stress[1][l] + chunk.stress[2][l]) * (1.0 / 3);
        double s[nc], square = 0;
        for (int k = 0; k < nc; ++k)
        {
            s[k] = k < 3 ? trials[k][l] - mean : trials[k][l];
            square += (k < 3 ? 1 : 2) * s[k] * s[k];
        }
        const double size = std::sqrt(square);
        const bool yields = size > radius;
        const double kept = yields ? radius / size : 1;
        double work = 0, largest = yieldStress;
        for (int k = 0; k < nc; ++k)
        {
            const double start = k < 3 ? chunk.stress[k][l] - meanStart : chunk.stress[k][l], end = kept * s[k];
            work += (k < 3 ? 1 : 2) * (start + end) * (s[k] - end);
            const double stress = yields ? (k < 3 ? mean + end : end) : trials[k][l];
            chunk.stress[k][l] = stress;
            largest = std::abs(stress) > largest ? std::abs(stress) : largest;
        }
        chunk.plasticWork[l] = yields ? work * quarterOverG : 0;
        chunk.apexStrain[l] = 0;
        chunk.yield[l] = (kept * size - radius) / largest;
        chunk.region[l] = yields ? Region::face : Region::elastic;
    }
    chunk.apexReturns = 0;
}

template <int dim>
void yieldOfChunk(Chunk<dim>& chunk, double yieldStress)
{
    for (int l = 0; l < lanes; ++l)
    {
        const double mean = (chunk.stress[0][l] + chunk.stress[1][l] + chunk.stress[2][l]) * (1.0 / 3);
        double square = 0, largest = yieldStress;
        for (int k = 0; k < stressSize<dim>; ++k)
        {
            const double stress = chunk.stress[k][l], s = k < 3 ? stress - mean : stress;
            square += (k < 3 ? 1 : 2) * s * s;
            largest = std::max(largest, std::abs(stress));
        }
        chunk.yield[l] = (std::sqrt(square) - std::sqrt(2.0 / 3) * yieldStress) / largest;
    }
}
} // namespace

VonMises::VonMises(const ElasticModuli& moduli, double yieldStress, std::optional<Substep> substep)
    : moduli_(moduli), yieldStress_(yieldStress), substep_(substep)
{
    requireModuli(moduli);
    if (!std::isfinite(yieldStress) || yieldStress <= 0)
        throw InputError(fmt::format("yieldStress: found {}, allowed is > 0", yieldStress));
}

VonMises VonMises::read(const dictionary::Dictionary& material)
{
    const ElasticModuli moduli = readModuli(material);
    return {moduli,
            material.get<double>({"yieldStress", "yield stress in uniaxial tension", dictionary::unit::pressure,
                                  dictionary::Bound::positive()}),
            readSubstep(material)};
}

std::string VonMises::describe() const
{
    return fmt::format("vonMises: E {:g} Pa, nu {:g}, yieldStress {:g} Pa{}", moduli_.young, moduli_.poisson,
                       yieldStress_, describeSubstep(substep_));
}

void VonMises::update(Chunk<2>& chunk) const
{
    if (!substep_)
        return updateChunk(chunk, moduli_, yieldStress_);
    updateInParts<2>(chunk, *substep_, moduli_, yieldStress_,
                     [this](Chunk<2>& part) { updateChunk(part, moduli_, yieldStress_); });
}

void VonMises::update(Chunk<3>& chunk) const
{
    if (!substep_)
        return updateChunk(chunk, moduli_, yieldStress_);
    updateInParts<3>(chunk, *substep_, moduli_, yieldStress_,
                     [this](Chunk<3>& part) { updateChunk(part, moduli_, yieldStress_); });
}

void VonMises::reportYield(Chunk<2>& chunk) const
{
    yieldOfChunk(chunk, yieldStress_);
}

void VonMises::reportYield(Chunk<3>& chunk) const
{
    yieldOfChunk(chunk, yieldStress_);
}
} // namespace mpm::constitutive

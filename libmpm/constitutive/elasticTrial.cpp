#include "constitutive/elasticTrial.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::constitutive
{
void requireModuli(const ElasticModuli& moduli)
{
    if (!std::isfinite(moduli.young) || moduli.young <= 0)
        throw InputError(fmt::format("E: found {}, allowed is > 0", moduli.young));
    if (!(moduli.poisson > -1 && moduli.poisson < 0.5))
        throw InputError(fmt::format("nu: found {}, allowed is in (-1, 0.5)", moduli.poisson));
}

ElasticModuli readModuli(const dictionary::Dictionary& material)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    return {material.get<double>({"E", "Young's modulus", unit::pressure, Bound::positive()}),
            material.get<double>({"nu", "Poisson's ratio", unit::none, Bound::open(-1, 0.5)})};
}

template <int dim>
void elasticTrial(const Chunk<dim>& chunk, const ElasticModuli& moduli, double (&trial)[stressSize<dim>][lanes])
{
    const double lame = moduli.lame(), twoG = 2 * moduli.shear();
    for (int i = 0; i < lanes; ++i)
    {
        const double volume = lame * (chunk.dStrain[0][i] + chunk.dStrain[1][i] + chunk.dStrain[2][i]);
        for (int k = 0; k < 3; ++k)
            trial[k][i] = chunk.stress[k][i] + (twoG * chunk.dStrain[k][i] + volume);
        for (int k = 3; k < stressSize<dim>; ++k)
            trial[k][i] = chunk.stress[k][i] + twoG * chunk.dStrain[k][i];
    }
}

template void elasticTrial<2>(const Chunk<2>&, const ElasticModuli&, double (&)[4][lanes]);
template void elasticTrial<3>(const Chunk<3>&, const ElasticModuli&, double (&)[6][lanes]);

void requireStrength(double cohesion, double frictionAngle, double dilationAngle, double tensionCutOff)
{
    if (!std::isfinite(cohesion) || cohesion < 0)
        throw InputError(fmt::format("cohesion: found {}, allowed is >= 0", cohesion));
    if (!(frictionAngle >= 0 && frictionAngle < 90))
        throw InputError(fmt::format("frictionAngle: found {}, allowed is in [0, 90)", frictionAngle));
    if (!(dilationAngle >= 0 && dilationAngle <= frictionAngle))
        throw InputError(fmt::format("dilationAngle: found {}, allowed is in [0, frictionAngle = {}]", dilationAngle,
                                     frictionAngle));
    if (!(tensionCutOff >= 0))
        throw InputError(fmt::format("tensionCutOff: found {}, allowed is >= 0", tensionCutOff));
}
} // namespace mpm::constitutive

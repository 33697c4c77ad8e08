#pragma once
/// The isotropic elastic trial of one chunk: trial = stress + lambda tr(dStrain) I + 2 G dStrain.
///
/// Compiled once and called by every law, so that laws which stay elastic agree to the last bit.
#include "constitutive/law.hpp"

namespace mpm::constitutive
{
/// Moduli of isotropic elasticity [Pa] and nu [-]; E > 0, -1 < nu < 0.5.
struct ElasticModuli
{
    double young;
    double poisson;

    double shear() const { return young / (2 * (1 + poisson)); }
    double bulk() const { return young / (3 * (1 - 2 * poisson)); }
    double lame() const { return young * poisson / ((1 + poisson) * (1 - 2 * poisson)); }
};

/// Throws InputError unless the moduli are finite and in their bounds.
void requireModuli(const ElasticModuli& moduli);
/// The same for the strength of soil: cohesion [Pa] >= 0, angles [deg] 0 <= dilation <= friction < 90, tensionCutOff
/// [Pa] >= 0.
void requireStrength(double cohesion, double frictionAngle, double dilationAngle, double tensionCutOff);

/// Reads `E` and `nu` of a material dictionary.
ElasticModuli readModuli(const dictionary::Dictionary& material);

template <int dim>
void elasticTrial(const Chunk<dim>& chunk, const ElasticModuli& moduli, double (&trial)[stressSize<dim>][lanes]);

extern template void elasticTrial<2>(const Chunk<2>&, const ElasticModuli&, double (&)[4][lanes]);
extern template void elasticTrial<3>(const Chunk<3>&, const ElasticModuli&, double (&)[6][lanes]);
} // namespace mpm::constitutive

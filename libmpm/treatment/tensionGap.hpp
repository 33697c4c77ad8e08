#pragma once
/// The tension gap: volume opened at the apex of a cone must close before the soil carries compression again.
///
/// A cohesionless law at psi = 0 has no plastic strain for tension beyond its apex; the return drops that volume
/// (Chunk::apexStrain). Drawn out and pushed together in turn, the soil grows with every cycle: 15 % on the collapsing
/// column. With the gap g_p, the volumetric strain a particle is open by,
///     trial = sigma + C : (dEps + g I/3),      g <- (p_trial - p_apex)/K at the apex, 0 elsewhere,
/// so what was opened is closed at the same stress. Work at the apex, sum V p_mid (g' - g), goes into gapWork and comes
/// back on closing: the gap neither makes nor takes energy. apexVolume is then the volume open now.
///
/// Source: the gap of no-tension joints (Goodman, Taylor & Brekke 1968, J. Soil Mech. Found. Div. ASCE 94, 637-659)
/// applied to the volume of a particle.
///
///     tensionGap  yes;             // in stressTreatment of system/mpmSchemes; default no
///
/// Acts where a law drops volume at its apex: mohrCoulomb and druckerPrager with dilationAngle 0 and frictionAngle >
/// 0. Not with substep { }: parts of a step open and close on their own; nor with a tensionCutOff below the apex, which
/// keeps to a flow rule.
/// Cost: one column. Verified in tests/unit/tensionGap.cpp.
#include "constitutive/law.hpp"

namespace mpm::treatment
{
/// What tensionGap keeps of a chunk while the law runs.
struct OpenGap
{
    alignas(64) double gap[lanes];  ///< in: g; out: g after the law
    alignas(64) double work[lanes]; ///< out: p_mid (g' - g) [J/m^3]
    alignas(64) double diagonal[3][lanes], pressure[lanes];
};

template <int dim>
double meanStress(const constitutive::Chunk<dim>& chunk, int l)
{
    return (chunk.stress[0][l] + chunk.stress[1][l] + chunk.stress[2][l]) * (1.0 / 3);
}

/// Before the law: the strain it sees includes the gap. anyOpen: is there one in the chunk?
template <int dim>
void openGap(constitutive::Chunk<dim>& chunk, OpenGap& open, bool anyOpen = true)
{
    for (int l = 0; l < lanes; ++l)
    {
        open.pressure[l] = meanStress(chunk, l);
        for (int k = 0; k < 3; ++k)
            open.diagonal[k][l] = chunk.dStrain[k][l];
    }
    for (int k = 0; k < 3 && anyOpen; ++k)
        for (int l = 0; l < lanes; ++l)
            chunk.dStrain[k][l] += open.gap[l] * (1.0 / 3);
}

/// After it, where a gap was open or the law returned to its apex: the gap that is left, the strain as it was, and
/// plastic work without that of the gap.
template <int dim>
void closeGap(constitutive::Chunk<dim>& chunk, OpenGap& open)
{
    for (int l = 0; l < lanes; ++l)
    {
        const double middle = 0.5 * (open.pressure[l] + meanStress(chunk, l)), left = chunk.apexStrain[l];
        chunk.plasticWork[l] -= middle * left;
        open.work[l] = middle * (left - open.gap[l]);
        chunk.apexStrain[l] = left - open.gap[l]; // what has opened in this step
        open.gap[l] = left;
        for (int k = 0; k < 3; ++k)
            chunk.dStrain[k][l] = open.diagonal[k][l];
    }
}
} // namespace mpm::treatment

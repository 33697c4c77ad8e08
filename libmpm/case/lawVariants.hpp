#pragma once
/// Laws like those of a scene with something added or taken away, for the effects of laws.
#include "case/effectCatalogue.hpp"
#include "constitutive/druckerPrager.hpp"
#include "constitutive/tresca.hpp"
#include "constitutive/vonMises.hpp"

#include <memory>

namespace mpm::cases
{
using LawPointer = std::shared_ptr<const constitutive::Law>;

inline constexpr double endless = 1e100; ///< a strength nothing reaches, whose square is a number [Pa]

/// As they were given, where the law tells.
constitutive::ElasticModuli moduliOf(const constitutive::Law& law);
LawPointer elasticLike(const constitutive::Law& law);
/// Mohr-Coulomb with the law's moduli that never yields.
LawPointer endlessSoil(const constitutive::Law& law);

/// What laws have beside their strength.
struct LawExtras
{
    std::optional<constitutive::Substep> substep;
    double tensionCutOff = std::numeric_limits<double>::infinity(); ///< [Pa]
    std::optional<constitutive::Softening> softening;
};
LawExtras extrasOf(const constitutive::Law& law);
/// The same law with others; those it cannot have are left out. Of mohrCoulomb, tresca, druckerPrager and vonMises
/// only.
LawPointer withExtras(const constitutive::Law& law, const LawExtras& extras, double cellSize);

/// change(extras) for all materials of a scene.
template <class Change>
void changeExtras(EffectScene& s, Change&& change)
{
    for (auto& material : s.scene.materials)
    {
        if (!material.law->plastic())
            continue;
        LawExtras extras = extrasOf(*material.law);
        change(extras);
        material.law = withExtras(*material.law, extras, s.state.grid.h);
    }
}

/// Substeps, tension cut-off, softening.
std::vector<Effect> strengthEffects();
} // namespace mpm::cases

#include "case/effectCatalogue.hpp"

#include "base/error.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
const char* familyName(EffectFamily family)
{
    static const char* const names[] = {"law", "boundary", "contact", "process", "transfer", "treatment"};
    return names[int(family)];
}

std::string EffectRun::energy(double joule) const
{
    return fmt::format("{:.4g} {}", joule / 1e3, state.particles.dim == 2 ? "kJ/m" : "kJ");
}

double EffectRun::supplied() const
{
    const auto& l = state.ledger;
    return std::abs(l.gravityWork) + std::abs(l.tractionWork) + std::abs(l.bodyForceWork) + l.motionSupply +
           l.initialKineticEnergy + l.initialStrainEnergy;
}

std::string EffectRun::share(double joule) const
{
    const double all = supplied();
    return energy(joule) + (all > 0 ? fmt::format(" ({:.2f} % of the energy supplied)", 100 * joule / all) : "");
}

const std::vector<Effect>& effectCatalogue()
{
    static const std::vector<Effect> all = [] {
        std::vector<Effect> list;
        for (auto family : {lawEffects, boundaryEffects, motionEffects, contactEffects, processEffects, transferEffects,
                            treatmentEffects})
            for (auto& effect : family())
                list.push_back(std::move(effect));
        return list;
    }();
    return all;
}

const Effect& effectNamed(const std::string& name)
{
    for (const auto& effect : effectCatalogue())
        if (effect.name == name)
            return effect;
    throw InputError("there is no effect '" + name + "'");
}

std::vector<const Effect*> effectsOf(const EffectScene& scene)
{
    std::vector<const Effect*> used;
    for (const auto& effect : effectCatalogue())
        if (effect.uses(scene))
            used.push_back(&effect);
    return used;
}

EffectScene withoutEffect(const Effect& effect, EffectScene scene)
{
    if (effect.uses(scene))
        effect.without(scene);
    else if (effect.base)
        effect.base(scene);
    return scene;
}

EffectScene withNeutral(const Effect& effect, EffectScene scene)
{
    scene = withoutEffect(effect, std::move(scene));
    if (effect.base)
        effect.base(scene);
    effect.neutral(scene);
    return scene;
}
} // namespace mpm::cases

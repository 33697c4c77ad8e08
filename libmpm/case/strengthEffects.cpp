// What a plastic law may have beside its strength.
#include "case/lawVariants.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using constitutive::Softening;
using constitutive::Substep;

/// Does a material of the scene have it?
template <class Has>
bool anyExtras(const EffectScene& s, Has&& has)
{
    return std::any_of(s.scene.materials.begin(), s.scene.materials.end(),
                       [&](const auto& material) { return has(extrasOf(*material.law)); });
}

/// Soil that never yields stands for all materials.
void makeEndlessSoil(EffectScene& s)
{
    for (auto& material : s.scene.materials)
        material.law = endlessSoil(*material.law);
}

Effect strengthEffect(const std::string& name, const std::string& word, const std::string& help)
{
    Effect e{
        .name = name, .family = EffectFamily::law, .word = word, .file = "constant/materialProperties", .help = help};
    e.base = makeEndlessSoil;
    e.pass = &stepping::PassTimes::law;
    e.did = [](const EffectRun&) -> Deed { return {}; };
    return e;
}

Effect substepEffect()
{
    Effect e = strengthEffect("substep", "substep { tolerance 1e-4; }",
                              "return maps in as many sub-steps as their error asks for");
    e.uses = [](const EffectScene& s) { return anyExtras(s, [](const auto& x) { return x.substep.has_value(); }); };
    e.without = [](EffectScene& s) { changeExtras(s, [](auto& x) { x.substep.reset(); }); };
    e.neutral = [](EffectScene& s) { changeExtras(s, [](auto& x) { x.substep = Substep{1e100}; }); };
    e.neutralText = "tolerance 1e100, cohesion 1e100";
    return e;
}

Effect tensionCutOffEffect()
{
    Effect e = strengthEffect("tensionCutOff", "tensionCutOff 0", "a limit of tension below that of the law");
    e.uses = [](const EffectScene& s) {
        return anyExtras(s, [](const auto& x) { return std::isfinite(x.tensionCutOff); });
    };
    e.without = [](EffectScene& s) {
        changeExtras(s, [](auto& x) { x.tensionCutOff = std::numeric_limits<double>::infinity(); });
    };
    e.neutral = [](EffectScene& s) { changeExtras(s, [](auto& x) { x.tensionCutOff = 0.1 * endless; }); };
    e.neutralText = "tensionCutOff 1e99, cohesion 1e100";
    return e;
}

Deed softeningDeed(const EffectRun& run)
{
    const auto& p = run.state.particles;
    Index softened = 0;
    for (std::size_t i = 0; i < std::size_t(p.size()) && p.has(&state::Particles::plasticStrain); ++i)
    {
        const auto extras = extrasOf(*run.scene.materials[std::size_t(p.material[i])].law);
        softened += extras.softening && p.plasticStrain[i] > extras.softening->from;
    }
    return {double(softened), "particles", fmt::format("{} particles softened", softened), softened > 0};
}

Effect softeningEffect()
{
    Effect e = strengthEffect("softening", "softening { ... }", "strength that is lost by shearing");
    e.fields = {"plasticStrain"};
    e.uses = [](const EffectScene& s) { return anyExtras(s, [](const auto& x) { return x.softening.has_value(); }); };
    e.without = [](EffectScene& s) { changeExtras(s, [](auto& x) { x.softening.reset(); }); };
    e.neutral = [](EffectScene& s) { changeExtras(s, [](auto& x) { x.softening = Softening{.from = endless}; }); };
    e.neutralText = "from 1e100, cohesion 1e100";
    e.did = softeningDeed;
    return e;
}
} // namespace

std::vector<Effect> strengthEffects()
{
    return {substepEffect(), tensionCutOffEffect(), softeningEffect()};
}
} // namespace mpm::cases

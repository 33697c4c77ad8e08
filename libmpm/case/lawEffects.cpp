// Effects of material laws. Without its law a material is linearElastic with the law's moduli.
#include "case/lawVariants.hpp"
#include "constitutive/hencky.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/neoHookean.hpp"
#include "constitutive/smallStrain.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using namespace constitutive;

bool isNamed(const Material& material, const std::string& name)
{
    return material.law->name() == name;
}

void makeElastic(EffectScene& s)
{
    for (auto& material : s.scene.materials)
        material.law = elasticLike(*material.law);
}

Deed plasticDeed(const EffectRun& run)
{
    const double work = run.grown(&state::Ledger::plasticDissipation);
    const Index apex = run.grown(&state::Ledger::apexReturns);
    if (work == 0 && apex == 0)
        return {0, "J", "0 particles yielded", false};
    const auto laws = std::count_if(run.scene.materials.begin(), run.scene.materials.end(),
                                    [](const auto& m) { return m.law->plastic(); });
    return {work, "J",
            fmt::format("plastic work {}{}{}", run.share(work), laws > 1 ? ", all materials" : "",
                        apex > 0 ? fmt::format(", {} returns to an apex", apex) : "")};
}

Deed elasticDeed(const EffectRun&)
{
    return {};
}

/// A law by its word in `law ...;`. make: of moduli, at its neutral value.
Effect lawEffect(const std::string& name, const std::string& neutralText, const std::string& differs,
                 std::function<LawPointer(const ElasticModuli&)> make, std::function<Deed(const EffectRun&)> did)
{
    const auto& laws = lawCatalogue();
    const auto help = std::find_if(laws.begin(), laws.end(), [&](const auto& l) { return l.name == name; });
    Effect e{.name = name,
             .family = EffectFamily::law,
             .word = "law " + name,
             .file = "constant/materialProperties",
             .help = help->help};
    e.uses = [name](const EffectScene& s) {
        return std::any_of(s.scene.materials.begin(), s.scene.materials.end(),
                           [&](const auto& m) { return isNamed(m, name); });
    };
    e.without = [name](EffectScene& s) {
        for (auto& material : s.scene.materials)
            if (isNamed(material, name))
                material.law = elasticLike(*material.law);
    };
    e.base = makeElastic;
    e.neutral = [make](EffectScene& s) {
        for (auto& material : s.scene.materials)
            material.law = make(moduliOf(*material.law));
    };
    e.neutralText = neutralText;
    e.differs = differs;
    e.pass = &stepping::PassTimes::law;
    e.did = std::move(did);
    return e;
}

} // namespace

std::vector<Effect> lawEffects()
{
    const std::string other = "another stress for the same motion: it takes the place of linearElastic";
    std::vector<Effect> effects = {
        lawEffect(
            "linearElastic", "itself", "", [](const auto& m) { return std::make_shared<LinearElastic>(m); },
            elasticDeed),
        lawEffect(
            "neoHookean", "", other, [](const auto& m) { return std::make_shared<NeoHookean>(m); }, elasticDeed),
        lawEffect(
            "hencky", "", other, [](const auto& m) { return std::make_shared<Hencky>(m); }, elasticDeed),
        lawEffect(
            "smallStrain", "", other, [](const auto& m) { return std::make_shared<SmallStrain>(m); }, elasticDeed),
        lawEffect(
            "vonMises", "yieldStress 1e100", "", [](const auto& m) { return std::make_shared<VonMises>(m, endless); },
            plasticDeed),
        lawEffect(
            "tresca", "cohesion 1e100", "",
            [](const auto& m) {
                return std::make_shared<Tresca>(MohrCoulombParameters{.moduli = m, .cohesion = endless});
            },
            plasticDeed),
        lawEffect(
            "mohrCoulomb", "cohesion 1e100", "", [](const auto& m) { return endlessSoil(LinearElastic(m)); },
            plasticDeed),
        lawEffect(
            "druckerPrager", "cohesion 1e100", "",
            [](const auto& m) {
                return std::make_shared<DruckerPrager>(
                    DruckerPragerParameters{.moduli = m, .cohesion = endless, .frictionAngle = 30});
            },
            plasticDeed),
    };
    for (auto& effect : strengthEffects())
        effects.push_back(std::move(effect));
    return effects;
}
} // namespace mpm::cases

// Effects of material laws. Without its law a material is linearElastic with the law's moduli.
#include "case/effectCatalogue.hpp"
#include "constitutive/hencky.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "constitutive/neoHookean.hpp"
#include "constitutive/smallStrain.hpp"
#include "constitutive/vonMises.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using namespace constitutive;
using LawPointer = std::shared_ptr<const Law>;

constexpr double endless = 1e100; ///< a strength nothing reaches, whose square is a number [Pa]

ElasticModuli moduliOf(const Law& law)
{
    if (const auto* metal = dynamic_cast<const VonMises*>(&law))
        return metal->moduli();
    if (const auto* soil = dynamic_cast<const MohrCoulomb*>(&law))
        return soil->parameters().moduli;
    if (const auto* elastic = dynamic_cast<const LinearElastic*>(&law))
        return elastic->moduli(); // as they were given
    const double K = law.bulkModulus(), G = law.shearModulus();
    return {9 * K * G / (3 * K + G), law.poissonRatio()};
}

LawPointer elasticLike(const Law& law)
{
    return std::make_shared<LinearElastic>(moduliOf(law));
}

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

/// The law with other sub-steps; the same where it has none.
LawPointer withSubstep(const LawPointer& law, const std::optional<Substep>& substep)
{
    if (const auto* soil = dynamic_cast<const MohrCoulomb*>(law.get()))
        return std::make_shared<MohrCoulomb>(soil->parameters(), substep);
    if (const auto* metal = dynamic_cast<const VonMises*>(law.get()))
        return std::make_shared<VonMises>(moduliOf(*metal), metal->yieldStress(), substep);
    return law;
}

bool hasSubstep(const Material& material)
{
    if (const auto* soil = dynamic_cast<const MohrCoulomb*>(material.law.get()))
        return soil->substep().has_value();
    if (const auto* metal = dynamic_cast<const VonMises*>(material.law.get()))
        return metal->substep().has_value();
    return false;
}

void setSubsteps(EffectScene& s, const std::optional<Substep>& substep)
{
    for (auto& material : s.scene.materials)
        material.law = withSubstep(material.law, substep);
}

Effect substepEffect()
{
    Effect e{.name = "substep",
             .family = EffectFamily::law,
             .word = "substep { tolerance ...; }",
             .file = "constant/materialProperties",
             .help = "return maps in as many sub-steps as their error asks for"};
    e.uses = [](const EffectScene& s) {
        return std::any_of(s.scene.materials.begin(), s.scene.materials.end(), hasSubstep);
    };
    e.without = [](EffectScene& s) { setSubsteps(s, {}); };
    e.base = [](EffectScene& s) {
        for (auto& material : s.scene.materials)
            if (!isNamed(material, "mohrCoulomb") && !isNamed(material, "vonMises"))
                material.law = std::make_shared<VonMises>(moduliOf(*material.law), endless);
    };
    e.neutral = [](EffectScene& s) { setSubsteps(s, Substep{1e100}); };
    e.neutralText = "tolerance 1e100, and nothing yields";
    e.pass = &stepping::PassTimes::law;
    e.did = elasticDeed;
    return e;
}
} // namespace

std::vector<Effect> lawEffects()
{
    const std::string other = "another stress for the same motion: it takes the place of linearElastic";
    return {
        lawEffect("linearElastic", "itself", "", [](const auto& m) { return std::make_shared<LinearElastic>(m); },
                  elasticDeed),
        lawEffect("neoHookean", "", other, [](const auto& m) { return std::make_shared<NeoHookean>(m); }, elasticDeed),
        lawEffect("hencky", "", other, [](const auto& m) { return std::make_shared<Hencky>(m); }, elasticDeed),
        lawEffect("smallStrain", "", other, [](const auto& m) { return std::make_shared<SmallStrain>(m); },
                  elasticDeed),
        lawEffect("vonMises", "yieldStress 1e100", "",
                  [](const auto& m) { return std::make_shared<VonMises>(m, endless); }, plasticDeed),
        lawEffect("mohrCoulomb", "cohesion 1e100", "",
                  [](const auto& m) {
                      return std::make_shared<MohrCoulomb>(MohrCoulombParameters{m, endless, 30, 0});
                  },
                  plasticDeed),
        substepEffect(),
    };
}
} // namespace mpm::cases

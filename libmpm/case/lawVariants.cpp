#include "case/lawVariants.hpp"

#include "base/error.hpp"
#include "constitutive/linearElastic.hpp"

namespace mpm::cases
{
using namespace constitutive;

ElasticModuli moduliOf(const Law& law)
{
    if (const auto* elastic = dynamic_cast<const LinearElastic*>(&law))
        return elastic->moduli();
    if (const auto* metal = dynamic_cast<const VonMises*>(&law))
        return metal->moduli();
    if (const auto* soil = dynamic_cast<const MohrCoulomb*>(&law))
        return soil->parameters().moduli;
    if (const auto* cone = dynamic_cast<const DruckerPrager*>(&law))
        return cone->parameters().moduli;
    const double K = law.bulkModulus(), G = law.shearModulus();
    return {9 * K * G / (3 * K + G), law.poissonRatio()};
}

LawPointer elasticLike(const Law& law)
{
    return std::make_shared<LinearElastic>(moduliOf(law));
}

LawPointer endlessSoil(const Law& law)
{
    return std::make_shared<MohrCoulomb>(
        MohrCoulombParameters{.moduli = moduliOf(law), .cohesion = endless, .frictionAngle = 30});
}

LawExtras extrasOf(const Law& law)
{
    if (const auto* soil = dynamic_cast<const MohrCoulomb*>(&law))
        return {soil->substep(), soil->parameters().tensionCutOff, soil->parameters().softening};
    if (const auto* cone = dynamic_cast<const DruckerPrager*>(&law))
        return {cone->substep(), cone->parameters().tensionCutOff, {}};
    if (const auto* metal = dynamic_cast<const VonMises*>(&law))
        return {metal->substep(), {}, {}};
    return {};
}

LawPointer withExtras(const Law& law, const LawExtras& extras, double cellSize)
{
    std::shared_ptr<Law> changed;
    if (const auto* soil = dynamic_cast<const MohrCoulomb*>(&law))
    {
        MohrCoulombParameters p = soil->parameters();
        p.tensionCutOff = extras.tensionCutOff;
        p.softening = extras.softening;
        if (dynamic_cast<const Tresca*>(&law))
            changed = std::make_shared<Tresca>(p, extras.substep);
        else
            changed = std::make_shared<MohrCoulomb>(p, extras.substep);
    }
    else if (const auto* cone = dynamic_cast<const DruckerPrager*>(&law))
    {
        DruckerPragerParameters p = cone->parameters();
        p.tensionCutOff = extras.tensionCutOff;
        changed = std::make_shared<DruckerPrager>(p, extras.substep);
    }
    else if (const auto* metal = dynamic_cast<const VonMises*>(&law))
        changed = std::make_shared<VonMises>(metal->moduli(), metal->yieldStress(), extras.substep);
    else
        throw InputError("law " + law.name() + " has no variants");
    changed->regularise(cellSize);
    return changed;
}
} // namespace mpm::cases

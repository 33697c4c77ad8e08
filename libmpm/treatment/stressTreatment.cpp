#include "treatment/stressTreatment.hpp"

#include <fmt/format.h>

namespace mpm::treatment
{
namespace
{
std::string describe(const VolumetricAveraging& a)
{
    std::string text = a.region == AveragingRegion::cell
                           ? "volume change averaged over cells"
                           : fmt::format("volume change averaged over patches x {}", a.repeats);
    if (a.of == AveragedPart::elastic)
        text += " (elastic part)";
    if (a.viscosity > 0)
        text += fmt::format(", viscosity {:g} rho h c_p", a.viscosity);
    return text + (a.conjugate ? ", conjugate forces" : "");
}

std::string describe(const StressRelaxation& r)
{
    return fmt::format("stress relaxed to {} at {}{} every {} steps",
                       smoothing::stressTargetNames()[std::size_t(r.target)],
                       r.rate ? fmt::format("{:g} 1/s", *r.rate) : "0.6 c_p/h",
                       r.perStrain > 0 ? fmt::format(", at most {:g} |D|,", r.perStrain) : "", r.interval);
}

template <class Property>
const constitutive::Material* firstWith(const std::vector<constitutive::Material>& materials, Property&& property)
{
    for (const auto& material : materials)
        if (property(*material.law))
            return &material;
    return nullptr;
}
} // namespace

std::string describe(const StressTreatment& t)
{
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
    if (t.averaging)
        add(describe(*t.averaging));
    if (t.relaxation)
        add(describe(*t.relaxation));
    if (t.tensionGap)
        add("tension gap");
    return text.empty() ? "none" : text;
}

/// Averaging cures locking, which laws suffer from when they flow or are nearly incompressible; relaxation what is left
/// of noise, which flow makes. A law that dilates keeps its plastic volume where it is made. The gap is for laws that
/// drop volume. Elastic bodies make no noise: where nu > 0.4 averages over cells, conjugate, which add no energy to
/// what moves for long; else nothing.
StressTreatment automatic(const std::vector<constitutive::Material>& materials)
{
    using constitutive::Law;
    StressTreatment t;
    const bool dilates = firstWith(materials, [](const Law& law) { return law.dilates(); });
    if (!firstWith(materials, [](const Law& law) { return law.plastic(); }))
    {
        if (firstWith(materials, [](const Law& law) { return law.poissonRatio() > 0.4; }))
            t.averaging = VolumetricAveraging{AveragingRegion::cell, 0, AveragedPart::total, true};
        return t;
    }
    t.averaging = VolumetricAveraging{AveragingRegion::patch, 6, dilates ? AveragedPart::elastic : AveragedPart::total,
                                      false, 0.01};
    t.relaxation = StressRelaxation{};
    t.tensionGap = firstWith(materials, [](const Law& law) { return law.dropsApexVolume(); });
    return t;
}

std::optional<Objection> objection(const StressTreatment& t, const std::vector<constitutive::Material>& materials)
{
    using constitutive::Law;
    if (materials.empty())
        return std::nullopt;
    if (t.averaging && t.averaging->of == AveragedPart::total && !t.averaging->conjugate)
        if (const auto* soil = firstWith(materials, [](const Law& law) { return law.dilates(); }))
            return Objection{"volumetricAveraging",
                             fmt::format("of total, conjugate no with material '{}', whose flow rule dilates: the "
                                         "volume a shear band makes would be spread over its neighbours and push it "
                                         "apart with energy from nowhere",
                                         soil->name),
                             "of elastic, or conjugate yes"};
    if (t.averaging && t.averaging->of == AveragedPart::elastic && t.averaging->conjugate)
        return Objection{"volumetricAveraging", "of elastic with conjugate yes: forces cannot know the plastic part",
                         "one of them"};
    if (t.relaxation && !firstWith(materials, [](const Law& law) { return !law.hyperelastic(); }))
        return Objection{"stressRelaxation",
                         "only laws whose stress is a function of F, which no relaxation can change",
                         "it with laws that carry stress on"};
    if (t.tensionGap && !firstWith(materials, [](const Law& law) { return law.dropsApexVolume(); }))
        return Objection{
            "tensionGap", "yes without a law that drops volume at an apex",
            "it with mohrCoulomb or druckerPrager, dilationAngle 0 and frictionAngle > 0, without substep and "
            "tensionCutOff"};
    return std::nullopt;
}
} // namespace mpm::treatment

// Remedies for erratic stresses (treatment/), the entries of stressTreatment.
#include "case/effectCatalogue.hpp"

#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using Ledger = state::Ledger;
using treatment::AveragedPart;
using treatment::StressRelaxation;
using treatment::VolumetricAveraging;

Effect remedy(const std::string& name, const std::string& word, const std::string& help)
{
    Effect e{.name = name,
             .family = EffectFamily::treatment,
             .word = word,
             .file = "system/mpmSchemes: stressTreatment",
             .help = help};
    e.pass = &stepping::PassTimes::law;
    return e;
}

/// How much energy it took, or that it took none.
std::function<Deed(const EffectRun&)> took(double Ledger::*entry)
{
    return [entry](const EffectRun& run) -> Deed {
        const double energy = run.grown(entry);
        if (energy == 0)
            return {0, "J", "0 J taken", false};
        return {energy, "J", "took " + run.share(energy)};
    };
}

VolumetricAveraging& averagingOf(EffectScene& s)
{
    auto& averaging = s.scene.treatment.averaging;
    return averaging ? *averaging : averaging.emplace();
}

/// A relaxation of nothing, if there is none.
StressRelaxation& relaxationOf(EffectScene& s)
{
    auto& relaxation = s.scene.treatment.relaxation;
    if (!relaxation)
    {
        relaxation.emplace();
        relaxation->rate = 1e-300;
        relaxation->perStrain = 0;
    }
    return *relaxation;
}

Effect averagingEffect()
{
    Effect e = remedy("volumetricAveraging", "volumetricAveraging { ... }", "means of the rate of volume change");
    e.uses = [](const EffectScene& s) { return s.scene.treatment.averaging.has_value(); };
    e.without = [](EffectScene& s) { s.scene.treatment.averaging.reset(); };
    e.neutral = [](EffectScene& s) { averagingOf(s); };
    e.differs = "a mean has no neutral value: the smallest region is a cell";
    e.did = [](const EffectRun& run) -> Deed {
        if (run.scene.treatment.averaging && run.scene.treatment.averaging->conjugate)
            return {0, "J", "forces and strains are conjugate: no energy taken"};
        return took(&Ledger::averagingLoss)(run);
    };
    return e;
}

Effect elasticPartEffect()
{
    Effect e = remedy("averagedElasticPart", "volumetricAveraging { of elastic; }",
                      "the part of volume change that flow rules make is left where it is made");
    e.fields = {"dilationRate"};
    e.uses = [](const EffectScene& s) { return s.scene.treatment.averagesElasticPart(); };
    e.without = [](EffectScene& s) { averagingOf(s).of = AveragedPart::total; };
    e.base = [](EffectScene& s) { averagingOf(s); };
    e.neutral = [](EffectScene& s) { averagingOf(s).of = AveragedPart::elastic; };
    e.neutralText = "a law that is elastic";
    e.differs = "the plastic part of volume change is what the stress leaves of it: round-off where nothing flows";
    e.did = [](const EffectRun&) -> Deed { return {}; };
    return e;
}

Effect viscosityEffect()
{
    Effect e = remedy("hourglassViscosity", "volumetricAveraging { viscosity 0.1; }",
                      "viscosity of volume change the average leaves out");
    e.fields = {"viscousStress"};
    e.uses = [](const EffectScene& s) { return s.scene.treatment.hasViscosity(); };
    e.without = [](EffectScene& s) { averagingOf(s).viscosity = 0; };
    e.base = [](EffectScene& s) { averagingOf(s); };
    e.neutral = [](EffectScene& s) { averagingOf(s).viscosity = 1e-300; };
    e.neutralText = "viscosity 1e-300";
    e.did = took(&Ledger::viscosityLoss);
    return e;
}

Effect relaxationEffect()
{
    Effect e = remedy("stressRelaxation", "stressRelaxation { ... }", "stresses go towards a smooth field");
    e.uses = [](const EffectScene& s) { return s.scene.treatment.relaxation.has_value(); };
    e.without = [](EffectScene& s) { s.scene.treatment.relaxation.reset(); };
    e.neutral = [](EffectScene& s) { relaxationOf(s); };
    e.neutralText = "rate 1e-300";
    e.did = [](const EffectRun& run) -> Deed {
        const auto& relaxation = run.scene.treatment.relaxation;
        const Index last = run.state.step - 1, before = run.state.step - run.steps - 1;
        const Index times = last / relaxation->interval - (before < 0 ? -1 : before / relaxation->interval);
        const double energy = run.grown(&Ledger::relaxationLoss);
        if (energy == 0)
            return {0, "J", fmt::format("0 J taken in {} relaxations", times), false};
        return {energy, "J", fmt::format("took {} in {} relaxations", run.share(energy), times)};
    };
    return e;
}

Effect flowMemoryEffect()
{
    Effect e = remedy("flowMemory", "stressRelaxation { perStrain 5000; }", "stresses relax where the body flows only");
    e.fields = {"flowMemory"};
    e.uses = [](const EffectScene& s) { return s.scene.treatment.followsFlow(); };
    e.without = [](EffectScene& s) { relaxationOf(s).perStrain = 0; };
    e.base = [](EffectScene& s) { relaxationOf(s); };
    e.neutral = [](EffectScene& s) { relaxationOf(s).perStrain = 1e-300; };
    e.neutralText = "perStrain 1e-300";
    e.did = [](const EffectRun&) -> Deed { return {}; };
    return e;
}

Effect tensionGapEffect()
{
    Effect e = remedy("tensionGap", "tensionGap yes", "volume opened at the apex must close before pressure builds");
    e.fields = {"tensionGap"};
    e.uses = [](const EffectScene& s) { return s.scene.treatment.tensionGap; };
    e.without = [](EffectScene& s) { s.scene.treatment.tensionGap = false; };
    e.neutral = [](EffectScene& s) { s.scene.treatment.tensionGap = true; };
    e.neutralText = "a law without an apex";
    e.did = [](const EffectRun& run) -> Deed {
        const Index apex = run.grown(&Ledger::apexReturns);
        if (apex == 0)
            return {0, "m^3", "0 gaps opened", false};
        return {run.state.ledger.apexVolume, "m^3",
                fmt::format("{:.4g} m^{} open, which hold {}", run.state.ledger.apexVolume, run.state.particles.dim,
                            run.energy(run.state.ledger.gapWork))};
    };
    return e;
}
} // namespace

std::vector<Effect> treatmentEffects()
{
    return {averagingEffect(),  elasticPartEffect(), viscosityEffect(),
            relaxationEffect(), flowMemoryEffect(),  tensionGapEffect()};
}
} // namespace mpm::cases

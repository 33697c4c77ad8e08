// Effects on a whole body: forces, damping, refinement.
#include "case/effectCatalogue.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mpm::cases
{
namespace
{
using Ledger = state::Ledger;

constexpr double endless = 1e300;

/// A body force of nothing.
class NoForce : public stepping::BodyForce
{
  public:
    void acceleration(const state::Particles&, Index, int, double, double (&b)[3][lanes]) const override
    {
        for (auto& axis : b)
            std::fill_n(axis, lanes, 0.0);
    }
};

Effect gravityEffect()
{
    Effect e{.name = "gravity", .word = "value (0 -9.8 0)", .file = "constant/g", .help = "constant gravity"};
    e.uses = [](const EffectScene& s) { return s.scene.gravity.has_value(); };
    e.without = [](EffectScene& s) { s.scene.gravity.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.gravity = Vector3{}; };
    e.neutralText = "value (0 0 0)";
    e.did = [](const EffectRun& run) -> Deed {
        const double work = run.grown(&Ledger::gravityWork);
        if (run.state.ledger.gravityImpulse == run.atStart.gravityImpulse)
            return {0, "J", "0 N s of gravity", false};
        return {work, "J", "work " + run.energy(work)};
    };
    return e;
}

Effect bodyForceEffect()
{
    Effect e{.name = "bodyForce",
             .word = "value (\"formula\" 0 0)",
             .file = "constant/bodyForce",
             .help = "a force per mass by formulas of place and time (here one of nothing: formulas cost more)"};
    e.uses = [](const EffectScene& s) { return s.scene.bodyForce != nullptr; };
    e.without = [](EffectScene& s) { s.scene.bodyForce.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.bodyForce = std::make_shared<NoForce>(); };
    e.neutralText = "value (0 0 0)";
    e.pass = &stepping::PassTimes::toParticles;
    e.did = [](const EffectRun& run) -> Deed {
        const double work = run.grown(&Ledger::bodyForceWork);
        if (work == 0)
            return {0, "J", "0 J of work", false};
        return {work, "J", "work " + run.energy(work)};
    };
    return e;
}

/// Of all damping.
Deed dampingDeed(const EffectRun& run)
{
    const double work = run.grown(&Ledger::dampingDissipation);
    if (work == 0)
        return {0, "J", "0 J dissipated", false};
    return {work, "J", "took " + run.share(work)};
}

Effect viscousDampingEffect()
{
    Effect e{.name = "viscousDamping",
             .word = "damping { type viscous; ... }",
             .file = "system/mpmSchemes",
             .help = "a force against the velocity, proportional to mass"};
    e.uses = [](const EffectScene& s) { return s.scene.relaxationTime.has_value(); };
    e.without = [](EffectScene& s) { s.scene.relaxationTime.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.relaxationTime = endless; };
    e.neutralText = "relaxationTime 1e300";
    e.did = dampingDeed;
    return e;
}

Effect localDampingEffect()
{
    Effect e{.name = "localDamping",
             .word = "damping { type local; ... }",
             .file = "system/mpmSchemes",
             .help = "a share of the net force on nodes, against their velocity"};
    e.uses = [](const EffectScene& s) { return s.scene.localDamping.has_value(); };
    e.without = [](EffectScene& s) { s.scene.localDamping.reset(); };
    e.base = [](EffectScene& s) { s.scene.relaxationTime.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.localDamping = 0.0; };
    e.neutralText = "coefficient 0";
    e.did = dampingDeed;
    return e;
}

Effect bulkViscosityEffect()
{
    Effect e{.name = "bulkViscosity",
             .word = "bulkViscosity { ... }",
             .file = "system/mpmSchemes",
             .help = "a pressure against compression that spreads shocks over a few cells",
             .fields = {"bulkViscousStress"}};
    e.uses = [](const EffectScene& s) { return s.scene.bulkViscosity.has_value(); };
    e.without = [](EffectScene& s) { s.scene.bulkViscosity.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.bulkViscosity = treatment::BulkViscosity{0, 0}; };
    e.neutralText = "linear 0; quadratic 0";
    e.pass = &stepping::PassTimes::law;
    e.did = [](const EffectRun& run) -> Deed {
        const double work = run.grown(&Ledger::bulkViscosityLoss);
        if (work == 0)
            return {0, "J", "0 J dissipated", false};
        return {work, "J", "took " + run.share(work)};
    };
    return e;
}

Effect mergingEffect()
{
    Effect e{.name = "merging",
             .word = "merging { ... }",
             .file = "system/mpmSchemes",
             .help = "halves of split particles become one again where they are short",
             .fields = {"family"}};
    e.uses = [](const EffectScene& s) { return s.scene.merging.has_value(); };
    e.without = [](EffectScene& s) { s.scene.merging.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.merging = splitting::MergeRule{.threshold = 0}; };
    e.neutralText = "threshold 0";
    e.pass = &stepping::PassTimes::split;
    e.did = [](const EffectRun& run) -> Deed {
        const Index merges = run.grown(&Ledger::merges);
        if (merges == 0)
            return {0, "particles", "0 pairs merged", false};
        return {double(merges), "particles", fmt::format("{} pairs merged", merges)};
    };
    return e;
}

Effect splittingEffect()
{
    Effect e{.name = "splitting",
             .word = "splitting { ... }",
             .file = "system/mpmSchemes",
             .help = "particles stretched beyond a threshold give way to smaller ones"};
    e.uses = [](const EffectScene& s) { return s.scene.splitting.has_value(); };
    e.without = [](EffectScene& s) { s.scene.splitting.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.splitting = splitting::Rule{.threshold = endless}; };
    e.neutralText = "threshold 1e300";
    e.pass = &stepping::PassTimes::split;
    e.ownPass = true;
    e.did = [](const EffectRun& run) -> Deed {
        const Index splits = run.grown(&Ledger::splits);
        if (splits == 0)
            return {0, "particles", "0 particles split", false};
        return {double(splits), "particles",
                fmt::format("{} particles split, {} at the end", splits, run.state.particles.size())};
    };
    return e;
}

Effect restEffect()
{
    Effect e{.name = "rest",
             .word = "rest { ... }",
             .file = "system/mpmSchemes",
             .help = "tiles of particles at rest sleep until something disturbs them",
             .fields = {"quietLooks"}};
    e.uses = [](const EffectScene& s) { return s.scene.rest.has_value(); };
    e.without = [](EffectScene& s) { s.scene.rest.reset(); };
    e.neutral = [](EffectScene& s) { s.scene.rest = stepping::Rest{.tolerance = 1e-300}; };
    e.neutralText = "tolerance 1e-300";
    e.differs = "tiles are smaller, so sums are in another order";
    e.did = [](const EffectRun& run) -> Deed {
        const Index slept = run.grown(&Ledger::restingSteps);
        if (slept == 0)
            return {0, "steps", "nothing slept", false};
        return {double(slept), "steps",
                fmt::format("{:.1f} % of the particles' steps slept through, {} tiles woken, at most {:.3g} Pa out of "
                            "balance, took {}",
                            100 * double(slept) / (double(run.steps) * double(run.state.particles.size())),
                            run.grown(&Ledger::wakes), run.report.restingStress,
                            run.share(run.grown(&Ledger::restLoss)))};
    };
    return e;
}
} // namespace

std::vector<Effect> processEffects()
{
    return {gravityEffect(),       bodyForceEffect(), viscousDampingEffect(), localDampingEffect(),
            bulkViscosityEffect(), splittingEffect(), mergingEffect(),        restEffect()};
}
} // namespace mpm::cases

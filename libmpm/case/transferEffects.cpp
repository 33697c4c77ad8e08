// Effects of how velocities return to particles. Without them it is FLIP.
#include "case/effectCatalogue.hpp"

namespace mpm::cases
{
namespace
{
using stepping::Scene;
using stepping::Transfer;

const std::string file = "system/mpmSchemes";

void makeFlip(EffectScene& s)
{
    s.scene.transfer = Transfer::FLIP;
    s.scene.filterRate.reset();
    s.scene.filterInterval = 1;
    s.scene.picRate = 0;
    s.scene.moveByStrainVelocity = false;
}

Deed transferDeed(const EffectRun& run)
{
    const double loss = run.grown(&state::Ledger::transferLoss);
    return {loss, "J", "transfers took " + run.share(loss)};
}

Effect picRateEffect()
{
    Effect e{.name = "picRate",
             .family = EffectFamily::transfer,
             .word = "picRate 5",
             .file = file,
             .help = "a share of PIC velocity mixed in per second"};
    e.uses = [](const EffectScene& s) { return s.scene.picRate > 0; };
    e.without = makeFlip;
    e.base = makeFlip;
    e.neutral = [](EffectScene& s) { s.scene.picRate = 1e-300; };
    e.neutralText = "picRate 1e-300";
    e.pass = &stepping::PassTimes::toParticles;
    e.did = transferDeed;
    return e;
}

/// XPIC, FMPM.
Effect filterEffect(const std::string& name, Transfer transfer, const std::string& help)
{
    Effect e{.name = name, .family = EffectFamily::transfer, .word = "transfer " + name, .file = file, .help = help};
    e.uses = [transfer](const EffectScene& s) { return s.scene.transfer == transfer; };
    e.without = makeFlip;
    e.base = makeFlip;
    e.neutral = [transfer](EffectScene& s) {
        s.scene.transfer = transfer;
        s.scene.filterRate = 0;
    };
    e.neutralText = "filterRate 0";
    e.pass = &stepping::PassTimes::toParticles;
    e.did = transferDeed;
    return e;
}

/// APIC, TPIC.
Effect affineEffect(const std::string& name, Transfer transfer, const std::string& help)
{
    Effect e{.name = name,
             .family = EffectFamily::transfer,
             .word = "transfer " + name,
             .file = file,
             .help = help,
             .fields = {"affine"}};
    e.uses = [transfer](const EffectScene& s) { return s.scene.transfer == transfer; };
    e.without = makeFlip;
    e.base = makeFlip;
    e.neutral = [transfer](EffectScene& s) { s.scene.transfer = transfer; };
    e.differs = "an affine field takes the place of the particles' own velocities: no value of it makes FLIP";
    e.pass = &stepping::PassTimes::toParticles;
    e.did = transferDeed;
    return e;
}
} // namespace

std::vector<Effect> transferEffects()
{
    return {
        picRateEffect(),
        filterEffect("XPIC", Transfer::XPIC, "velocities without what no grid sees"),
        filterEffect("FMPM", Transfer::FMPM, "the same by an approximate inverse of the full mass matrix"),
        affineEffect("APIC", Transfer::APIC, "velocities and an affine field that keeps angular momentum"),
        affineEffect("TPIC", Transfer::TPIC, "velocities and their gradient"),
    };
}
} // namespace mpm::cases

// Effects of contact between bodies, and the law of bodies that others only meet there.
#include "base/error.hpp"
#include "case/effectCatalogue.hpp"
#include "constitutive/rigid.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using Ledger = state::Ledger;

Deed contactDeed(const EffectRun& run)
{
    const Index nodes = run.grown(&Ledger::contactNodes);
    if (nodes == 0)
        return {0, "J", "0 contacts", false};
    const double friction = run.grown(&Ledger::contactFriction), loss = run.grown(&Ledger::contactLoss);
    return {friction, "J",
            fmt::format("friction took {}, impact {}, at {:.4g} nodes a step", run.share(friction), run.energy(loss),
                        double(nodes) / double(std::max<Index>(1, run.steps)))};
}

Effect contactEffect()
{
    Effect e{.name = "contact",
             .family = EffectFamily::contact,
             .word = "bodies (disc plane); mu 0.3",
             .file = "constant/contactProperties",
             .help = "bodies with nodal velocities of their own, which push and rub where they meet"};
    e.uses = [](const EffectScene& s) { return s.scene.contact.has_value(); };
    e.without = [](EffectScene& s) { s.scene.contact.reset(); };
    e.neutral = [](EffectScene& s) {
        s.scene.contact = nodal::ContactProperties{.bodies = {"all", "none"},
                                                   .bodyOf = std::vector<int>(s.scene.materials.size(), 0),
                                                   .mu = {{0, 0}, {0, 0}},
                                                   .motion = {}};
    };
    e.neutralText = "bodies that never meet";
    e.did = contactDeed;
    return e;
}

/// Is nothing made of the last material?
bool lastIsUnused(const EffectScene& s)
{
    const auto& material = s.state.particles.material;
    const auto last = std::int32_t(s.scene.materials.size()) - 1;
    return std::find(material.begin(), material.begin() + s.state.particles.size(), last) ==
           material.begin() + s.state.particles.size();
}

Effect rigidEffect()
{
    Effect e{.name = "rigid",
             .family = EffectFamily::law,
             .word = "law rigid",
             .file = "constant/materialProperties",
             .help = "a material that moves as prescribed and pushes others by contact"};
    e.uses = [](const EffectScene& s) {
        return std::any_of(s.scene.materials.begin(), s.scene.materials.end(),
                           [](const auto& material) { return material.law->rigid(); });
    };
    e.without = [](EffectScene& s) {
        while (s.scene.materials.back().law->rigid() && lastIsUnused(s))
            s.scene.materials.pop_back();
        for (const auto& material : s.scene.materials)
            if (material.law->rigid())
                throw InputError("particles of " + material.name + " have no other law: see contact, which moves them");
    };
    e.neutral = [](EffectScene& s) {
        s.scene.materials.push_back({"none", 1000, std::make_shared<constitutive::Rigid>()});
    };
    e.neutralText = "of which no particle is made";
    e.pass = &stepping::PassTimes::law;
    e.did = [](const EffectRun& run) -> Deed {
        const double work = run.grown(&Ledger::motionWork);
        if (work == 0 && run.grown(&Ledger::contactNodes) == 0)
            return {0, "J", "0 contacts", false};
        return {work, "J", "work " + run.energy(work)};
    };
    return e;
}
} // namespace

std::vector<Effect> contactEffects()
{
    return {contactEffect(), rigidEffect()};
}
} // namespace mpm::cases

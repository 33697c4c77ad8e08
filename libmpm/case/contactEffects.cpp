// Effects of contact between bodies.
#include "case/effectCatalogue.hpp"

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
} // namespace

std::vector<Effect> contactEffects()
{
    return {contactEffect()};
}
} // namespace mpm::cases

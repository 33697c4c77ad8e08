// Effects of contact between bodies.
#include "case/effectCatalogue.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using Ledger = state::Ledger;

Effect contactEffect()
{
    Effect e{.name = "contact",
             .family = EffectFamily::contact,
             .word = "bodies (disc plane)",
             .file = "constant/contactProperties",
             .help = "bodies that slip and part, with Coulomb friction where they meet"};
    e.uses = [](const EffectScene& s) { return s.scene.contact.has_value(); };
    e.without = [](EffectScene& s) { s.scene.contact.reset(); };
    e.neutral = [](EffectScene& s) {
        nodal::ContactProperties one;
        one.bodies = {"all"};
        one.bodyOf.assign(s.scene.materials.size(), 0);
        one.mu = {{0.0}};
        s.scene.contact = one;
    };
    e.neutralText = "one body of all materials";
    e.did = [](const EffectRun& run) -> Deed {
        const auto nodes = run.grown(&Ledger::contactNodes);
        if (nodes == 0)
            return {0, "1", "0 nodes of two bodies pressed", false};
        const double perStep = double(nodes) / double(std::max<Index>(1, run.steps));
        return {double(nodes), "1",
                fmt::format("{:.3g} nodes a step pressed; friction took {}, impact {}", perStep,
                            run.share(run.grown(&Ledger::contactFriction)), run.energy(run.grown(&Ledger::contactLoss)))};
    };
    return e;
}
} // namespace

std::vector<Effect> contactEffects()
{
    return {contactEffect()};
}
} // namespace mpm::cases

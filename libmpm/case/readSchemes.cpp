#include "case/readSchemes.hpp"

#include "case/makeStepper.hpp"

#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

splitting::Rule readSplitRule(const Dictionary& d)
{
    splitting::Rule rule;
    rule.threshold =
        d.get<double>({"threshold", "longest edge, in seeding spacings", {}, {1, 1e300, true, false}, rule.threshold});
    rule.mode = d.choose("mode", "which edges are halved",
                         {{"fourWay", "all edges of a particle"}, {"stretched", "edges over the threshold"}},
                         "fourWay") == "fourWay"
                    ? splitting::Mode::fourWay
                    : splitting::Mode::stretched;
    rule.maxParticles = d.get<Index>({"maxParticles", "cap on their number", {}, Bound::atLeast(1), rule.maxParticles});
    rule.maxGeneration =
        int(d.get<Index>({"maxGeneration", "halvings of one particle", {}, Bound::between(0, 30), rule.maxGeneration}));
    return rule;
}

splitting::Rule readSplitting(const Dictionary& d)
{
    splitting::Rule rule = readSplitRule(d);
    rule.interval = d.get<Index>({"interval", "steps between checks", {}, Bound::atLeast(1), rule.interval});
    return rule;
}

namespace
{
void readTransfer(const Dictionary& d, stepping::Scene& scene)
{
    using stepping::Transfer;
    static const std::vector<std::pair<std::string, Transfer>> kinds{{"FLIP", Transfer::FLIP},
                                                                     {"XPIC", Transfer::XPIC},
                                                                     {"FMPM", Transfer::FMPM},
                                                                     {"APIC", Transfer::APIC},
                                                                     {"TPIC", Transfer::TPIC}};
    const auto name = d.choose("transfer", "how velocities return to particles",
                               {{"FLIP", "increments, with a rate of PIC"},
                                {"XPIC", "velocities without what no grid sees"},
                                {"FMPM", "the same with an approximate inverse of the full mass matrix"},
                                {"APIC", "velocities and an affine field that keeps angular momentum"},
                                {"TPIC", "velocities and their gradient"}},
                               "FLIP");
    for (const auto& [word, kind] : kinds)
        if (word == name)
            scene.transfer = kind;
    if (scene.transfer == Transfer::FLIP)
        scene.picRate = d.get<double>(
            {"picRate", "share of PIC velocity mixed in per second", unit::rate, Bound::nonNegative(), 0.0});
    else if (d.found("picRate"))
        d.fail("picRate", "a rate of PIC with transfer " + name,
               "it with FLIP only: " + name + " keeps nothing of the particles' own velocities");
    const bool ordered = scene.transfer == Transfer::XPIC || scene.transfer == Transfer::FMPM;
    if (ordered)
        scene.transferOrder =
            int(d.get<Index>({"order", "terms of the filter, 1: PIC", unit::none, Bound::between(1, 20), Index(2)}));
    else
        for (const char* word : {"order", "filterRate", "filterInterval"})
            if (d.found(word))
                d.fail(word, "it with transfer " + name, "it with XPIC and FMPM only");
    if (ordered && d.found("filterRate"))
    {
        scene.filterRate =
            d.get<double>({"filterRate", "share of the filter mixed in per second", unit::rate, Bound::nonNegative()});
        scene.filterInterval =
            d.get<Index>({"filterInterval", "steps between filters", unit::none, Bound::atLeast(1), Index(1)});
    }
    else if (ordered && d.found("filterInterval"))
        d.fail("filterInterval", "it without filterRate",
               "it with filterRate: without, every step is filtered in full");
}

stepping::Rest readRest(const Dictionary& all, const Dictionary& d, const stepping::Scene& scene)
{
    stepping::Rest rest;
    rest.tolerance = d.get<double>(
        {"tolerance", "strain of waves that may be ignored", unit::none, {0, 1e-2, true, false}, rest.tolerance});
    rest.looks = d.get<Index>(
        {"looks", "looks in a row at which a tile has to be quiet", unit::none, Bound::atLeast(1), rest.looks});
    rest.follow = d.get<bool>({"follow", "what sleeps follows slowly", unit::none, {}, rest.follow});
    if (scene.transfer != stepping::Transfer::FLIP ||
        scene.timeIntegration != stepping::TimeIntegration::symplecticEuler)
        all.fail("rest", "it with " + stepping::methodText(scene), "it with FLIP and symplecticEuler only");
    if (scene.bodyForce)
        all.fail("rest", "it beside constant/bodyForce", "one of the two: a force by formulas may disturb what sleeps");
    return rest;
}

/// Twice the threshold is what merged edges may have: over that of splitting they would be split again.
void readMerging(const Dictionary& d, stepping::Scene& scene)
{
    splitting::MergeRule rule;
    rule.threshold = d.get<double>(
        {"threshold", "longest edge that merges, in seeding spacings", {}, Bound::nonNegative(), rule.threshold});
    rule.closeness = d.get<double>(
        {"closeness", "how far a pair may be from one domain, in edges", {}, {0, 0.5, true, false}, rule.closeness});
    rule.interval = d.get<Index>({"interval", "steps between looks", {}, Bound::atLeast(1), rule.interval});
    if (scene.splitting && 2 * rule.threshold >= scene.splitting->threshold)
        d.fail("threshold", fmt::format("{:g}, with splitting at {:g}", rule.threshold, scene.splitting->threshold),
               fmt::format("less than half of that, {:g}: else particles would be split and merged in turn",
                           0.5 * scene.splitting->threshold));
    if (rule.threshold > 0)
        scene.merging = rule;
}

void readBulkViscosity(const Dictionary& d, stepping::Scene& scene)
{
    treatment::BulkViscosity b;
    b.linear = d.get<double>({"linear", "b1, of rho h c_p |tr D|", unit::none, Bound::nonNegative(), b.linear});
    b.quadratic =
        d.get<double>({"quadratic", "b2, of rho (b2 h tr D)^2", unit::none, Bound::nonNegative(), b.quadratic});
    if (b.any())
        scene.bulkViscosity = b;
}
} // namespace

std::string readSchemes(const Dictionary& d, stepping::Scene& scene)
{
    const auto shape = d.choose("shape", "shape functions", shapeCatalogue(), "uGIMP");
    const auto update = d.choose(
        "stressUpdate", "when stress is updated",
        {{"MUSL", "last, from a second projection"}, {"USL", "last, from v*"}, {"USF", "before the forces"}}, "MUSL");
    scene.stressUpdate = update == "USF"   ? stepping::StressUpdate::USF
                         : update == "USL" ? stepping::StressUpdate::USL
                                           : stepping::StressUpdate::MUSL;
    const auto integration = d.choose("timeIntegration", "how the motion goes from one time to the next",
                                      {{"symplecticEuler", "one kick and one move a step"},
                                       {"RK2", "two stages of the semi-discrete equations"},
                                       {"RK4", "four stages"}},
                                      "symplecticEuler");
    scene.timeIntegration = integration == "RK2"   ? stepping::TimeIntegration::RK2
                            : integration == "RK4" ? stepping::TimeIntegration::RK4
                                                   : stepping::TimeIntegration::symplecticEuler;
    readTransfer(d, scene);
    scene.moveByStrainVelocity = d.choose("particleMotion", "what moves particles",
                                          {{"gridVelocity", "v*, the velocity after forces and walls"},
                                           {"strainVelocity", "w, the velocity MUSL strains them with"}},
                                          "gridVelocity") == "strainVelocity";
    if (scene.moveByStrainVelocity &&
        (scene.stressUpdate != stepping::StressUpdate::MUSL || scene.transfer != stepping::Transfer::FLIP ||
         scene.timeIntegration != stepping::TimeIntegration::symplecticEuler))
        d.fail("particleMotion", "strainVelocity with " + stepping::methodText(scene),
               "gridVelocity, or MUSL with FLIP: only there particles are strained with a velocity of their own");
    scene.staggeredStart = d.get<bool>({"staggeredStart", "on: the first kick is half a step", unit::none, {}, false});
    if (scene.staggeredStart && scene.timeIntegration != stepping::TimeIntegration::symplecticEuler)
        d.fail("staggeredStart", "on with timeIntegration " + integration,
               "off: " + integration + " has positions and velocities at the same times");
    if (scene.staggeredStart && scene.stressUpdate == stepping::StressUpdate::USF)
        d.fail(
            "staggeredStart", "on with stressUpdate USF",
            "USL or MUSL, or off: USF strains before its first kick, so that its stresses, not its velocities, would "
            "start half a step off");
    scene.sortInterval =
        d.get<Index>({"sortInterval", "steps between sorts of the particles", {}, Bound::atLeast(1), Index(20)});
    if (const Dictionary* damping = d.findDict("damping", "force against the velocity"))
    {
        const auto type = damping->choose("type", "what the force follows",
                                          {{"viscous", "mass and velocity: - m v/relaxationTime"},
                                           {"local", "the unbalanced force: - coefficient |f| sign(v)"}});
        if (type == "viscous")
            scene.relaxationTime = damping->get<double>(
                {"relaxationTime", "time in which free momentum falls to 1/e", unit::time, Bound::positive()});
        else if (const double coefficient = damping->get<double>(
                     {"coefficient", "share of the unbalanced force", unit::none, {0, 1, false, true}});
                 coefficient > 0)
            scene.localDamping = coefficient;
    }
    if (const Dictionary* rest = d.findDict("rest", "soil at rest sleeps"))
        scene.rest = readRest(d, *rest, scene);
    if (const Dictionary* splitting = d.findDict("splitting", "adaptive splitting of stretched particles"))
        scene.splitting = readSplitting(*splitting);
    if (const Dictionary* merging = d.findDict("merging", "pairs of small particles become one again"))
        readMerging(*merging, scene);
    if (const Dictionary* viscosity = d.findDict("bulkViscosity", "pressure against compression, for shocks"))
        readBulkViscosity(*viscosity, scene);
    return shape;
}
} // namespace mpm::cases

#include "case/readSchemes.hpp"

#include <algorithm>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

namespace
{
treatment::VolumetricAveraging readAveraging(const Dictionary& d)
{
    using namespace treatment;
    VolumetricAveraging a;
    a.region = d.choose("region", "what volume change is averaged over",
                        {{"cell", "the particle's cell"}, {"patch", "cells around it with hat weights, repeated"}},
                        "patch") == "cell"
                   ? AveragingRegion::cell
                   : AveragingRegion::patch;
    if (a.region == AveragingRegion::patch)
        a.repeats =
            int(d.get<Index>({"repeats", "times the hats are applied", unit::none, Bound::between(1, 20), Index(2)}));
    else if (d.found("repeats"))
        d.fail("repeats", "it with region cell", "it with region patch");
    a.of = d.choose("of", "part of the volume change that is averaged",
                    {{"total", "all of it"}, {"elastic", "without what the flow rule makes"}}, "total") == "total"
               ? AveragedPart::total
               : AveragedPart::elastic;
    a.conjugate = d.get<bool>({"conjugate", "yes: forces take the averaged pressure", unit::none, {}, false});
    a.viscosity = d.get<double>({"viscosity", "of volume change the average leaves out, over rho h c_p", unit::none,
                                 Bound::between(0, 0.5), 0.0});
    return a;
}

treatment::StressRelaxation readRelaxation(const Dictionary& d)
{
    using smoothing::StressTarget;
    treatment::StressRelaxation r;
    const auto name = d.choose("target", "field the stress goes towards",
                               {{"smoothed", "Eqs. 11 and 12"},
                                {"filtered", "the same without its loss of second order"},
                                {"leastSquares", "linear fields are left alone"}},
                               "filtered");
    r.target = name == "smoothed"   ? StressTarget::smoothed
               : name == "filtered" ? StressTarget::filtered
                                    : StressTarget::leastSquares;
    if (d.found("rate"))
        r.rate = d.get<double>({"rate", "share per second at most, default 0.6 c_p/h", unit::rate, Bound::positive()});
    r.perStrain = d.get<double>({"perStrain", "bound of the rate over the strain rate, 0: none", unit::none,
                                 Bound::nonNegative(), r.perStrain});
    if (d.found("memory"))
        r.memory = d.get<double>(
            {"memory", "time in which yielding is forgotten, default 400 h/c_p", unit::time, Bound::positive()});
    if (r.memory && !r.followsFlow())
        d.fail("memory", "it with perStrain 0",
               "it with perStrain > 0: else the rate is the same everywhere and for ever");
    r.interval = d.get<Index>({"interval", "steps between relaxations", unit::none, Bound::atLeast(1), r.interval});
    return r;
}

treatment::StressTreatment readRemedies(const Dictionary& d)
{
    treatment::StressTreatment t;
    if (const Dictionary* averaging = d.findDict("volumetricAveraging", "means of the rate of volume change"))
        t.averaging = readAveraging(*averaging);
    if (const Dictionary* relaxation = d.findDict("stressRelaxation", "stresses go towards a smooth field"))
        t.relaxation = readRelaxation(*relaxation);
    t.tensionGap =
        d.get<bool>({"tensionGap", "yes: volume opened at the apex must close first", unit::none, {}, false});
    return t;
}
} // namespace

treatment::StressTreatment readStressTreatment(const Dictionary& d, const stepping::Scene& scene)
{
    const std::string word = "stressTreatment";
    const auto nested = d.dictNames();
    treatment::StressTreatment t;
    const bool single = std::find(nested.begin(), nested.end(), word) != nested.end();
    if (single)
        t = readRemedies(*d.findDict(word, "what is done against erratic stresses"));
    else if (d.choose(word, "what is done against erratic stresses, or a dictionary of single remedies",
                      {{"none", "the plain scheme"}, {"automatic", "the best that is valid for the laws at hand"}},
                      "none") == "automatic")
        t = treatment::automatic(scene.materials);
    if (!t.any())
        return t;
    if (scene.timeIntegration != stepping::TimeIntegration::symplecticEuler)
        d.fail(
            word, "it with " + stepping::methodText(scene),
            "none, or timeIntegration symplecticEuler: stages of a Runge-Kutta step are those of the plain equations");
    if (const auto why = treatment::objection(t, scene.materials))
        (single ? *d.findDict(word) : d).fail(why->word, why->found, why->allowed);
    return t;
}
} // namespace mpm::cases

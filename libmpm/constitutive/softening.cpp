#include "constitutive/softening.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::constitutive
{
std::optional<Softening> readSoftening(const dictionary::Dictionary& material, double cohesion, double frictionAngle,
                                       double dilationAngle, bool friction)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    const auto* d = material.findDict("softening", "strength lost by shearing; absent: none");
    if (!d)
        return std::nullopt;
    Softening s;
    s.from = d->get<double>(
        {"from", "deviatoric plastic strain up to which the peak holds", unit::none, Bound::nonNegative(), 0.0});
    s.over = d->get<double>(
        {"over", "further strain over which strength falls to its residual value", unit::none, Bound::positive()});
    s.cohesion = d->get<double>({"cohesion", "residual cohesion, at most that of the peak", unit::pressure,
                                 Bound::between(0, cohesion), cohesion});
    if (friction)
    {
        s.frictionAngle = d->get<double>({"frictionAngle", "residual angle of friction [deg], at most that of the peak",
                                          unit::none, Bound::between(0, frictionAngle), frictionAngle});
        const double highest = std::min(dilationAngle, s.frictionAngle);
        s.dilationAngle = d->get<double>(
            {"dilationAngle", "residual angle of dilation [deg], at most that of the peak and frictionAngle",
             unit::none, Bound::between(0, highest), highest});
    }
    s.referenceLength = d->get<double>(
        {"referenceLength", "width of the shear band in which these strains hold", unit::length, Bound::positive()});
    if (s.cohesion == cohesion && s.frictionAngle == frictionAngle && s.dilationAngle == dilationAngle)
        return std::nullopt;
    return s;
}

std::string describeSoftening(const std::optional<Softening>& s, double scale)
{
    if (!s)
        return {};
    return fmt::format(
        ", softening from {:g} over {:g} to cohesion {:g} Pa, frictionAngle {:g} deg, dilationAngle {:g} "
        "deg, referenceLength {:g} m (strains times {:g})",
        s->from, s->over, s->cohesion, s->frictionAngle, s->dilationAngle, s->referenceLength, scale);
}
} // namespace mpm::constitutive

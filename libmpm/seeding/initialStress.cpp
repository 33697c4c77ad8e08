#include "seeding/initialStress.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::seeding
{
std::optional<GravityAxis> gravityAxis(const Vector3& g, int dim)
{
    std::optional<GravityAxis> found;
    for (int k = 0; k < 3; ++k)
    {
        const double component = g[std::size_t(k)];
        if (component == 0)
            continue;
        if (found || k >= dim)
            return std::nullopt;
        found = GravityAxis{k, component > 0 ? 1.0 : -1.0, std::abs(component)};
    }
    return found;
}

bool InitialStress::above(const Vector3& p, double highest) const
{
    const double surface = surfaceLevel.value_or(highest);
    return type == Type::K0 && -gravity.sign * (p[std::size_t(gravity.axis)] - surface) > 0;
}

std::array<double, 6> InitialStress::at(const Vector3& p, double density, double highest) const
{
    if (type == Type::none)
        return {};
    if (type == Type::uniform)
        return value;
    const double surface = surfaceLevel.value_or(highest);
    const double depth = gravity.sign * (p[std::size_t(gravity.axis)] - surface);
    const double vertical = -density * gravity.magnitude * depth;
    std::array<double, 6> stress{K0 * vertical, K0 * vertical, K0 * vertical, 0, 0, 0};
    stress[std::size_t(gravity.axis)] = vertical;
    return stress;
}

InitialStress readInitialStress(const dictionary::Dictionary& material, double poissonRatio, const Vector3& g, int dim,
                                bool hyperelastic)
{
    using dictionary::Bound;
    namespace unit = dictionary::unit;
    InitialStress made;
    const auto* dict = material.findDict("initialStress", "the stress particles start with");
    if (!dict)
        return made;
    const std::string type = dict->choose("type", "kind of initial stress",
                                          {{"none", "no stress"},
                                           {"K0", "a wide layer at rest under gravity"},
                                           {"uniform", "the same stress everywhere"}},
                                          "none");
    if (hyperelastic && type != "none")
        dict->fail("type", type + " with a hyperelastic law, whose stress follows from the deformation since the start",
                   "none");
    if (type == "K0")
    {
        made.type = InitialStress::Type::K0;
        const auto axis = gravityAxis(g, dim);
        if (!axis)
            dict->fail("type", fmt::format("K0 with gravity ({:.6g} {:.6g} {:.6g}) in constant/g", g[0], g[1], g[2]),
                       fmt::format("gravity along one of the {} axes, not zero", dim));
        made.gravity = *axis;
        made.K0 = dict->get<double>({"K0", "horizontal over vertical stress; default nu/(1 - nu)", unit::none,
                                     Bound::nonNegative(), poissonRatio / (1 - poissonRatio)});
        if (dict->found("surfaceLevel"))
            made.surfaceLevel = dict->get<double>({"surfaceLevel",
                                                   "coordinate of the free surface along gravity; default the "
                                                   "region's highest point",
                                                   unit::length});
    }
    else if (type == "uniform")
    {
        made.type = InitialStress::Type::uniform;
        const auto value = dict->get<std::vector<double>>({"value", "stress xx yy zz xy yz zx", unit::pressure});
        if (value.size() != 6)
            dict->fail("value", fmt::format("{} numbers", value.size()), "six: xx yy zz xy yz zx");
        if (dim == 2 && (value[4] != 0 || value[5] != 0))
            dict->fail("value", fmt::format("yz {:.6g} and zx {:.6g}", value[4], value[5]), "0 for both in 2D");
        std::copy(value.begin(), value.end(), made.value.begin());
    }
    return made;
}
} // namespace mpm::seeding

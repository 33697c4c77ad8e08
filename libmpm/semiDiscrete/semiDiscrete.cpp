#include "semiDiscrete/semiDiscrete.hpp"

#include "constitutive/linearElastic.hpp"

#include <fmt/format.h>

namespace mpm::semiDiscrete
{
std::string whyNotSmooth(const Model& model)
{
    for (const auto& material : model.materials)
    {
        if (material.law->plastic())
            return fmt::format("the law {} of '{}' can yield: its stress rate jumps", material.law->name(),
                               material.name);
        if (!material.law->hyperelastic() && !dynamic_cast<const constitutive::LinearElastic*>(material.law.get()))
            return fmt::format("the law {} of '{}' is neither a rate law nor one of F", material.law->name(),
                               material.name);
    }
    for (const auto& wall : model.walls)
    {
        if (wall.motion)
            return fmt::format("the wall '{}' moves", wall.name);
        if (wall.separation)
            return fmt::format("the wall '{}' separates: its force jumps", wall.name);
        if (wall.type == nodal::WallType::friction && wall.mu > 0)
            return fmt::format("the wall '{}' has friction: its force jumps between stick and slip", wall.name);
    }
    return {};
}
} // namespace mpm::semiDiscrete

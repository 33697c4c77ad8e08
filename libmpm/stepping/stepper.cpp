#include "stepping/stepper.hpp"

#include "nodal/wall.hpp"
#include "stepping/timeStep.hpp"

#include <fmt/format.h>

namespace mpm::stepping
{
std::string methodText(const Scene& scene)
{
    switch (scene.timeIntegration)
    {
    case TimeIntegration::RK2:
        return "RK2";
    case TimeIntegration::RK4:
        return "RK4";
    case TimeIntegration::symplecticEuler:
        break;
    }
    static const char* const names[] = {"FLIP", "XPIC", "FMPM", "APIC", "TPIC"};
    std::string text = stressUpdateName(scene.stressUpdate) + ", " + names[int(scene.transfer)];
    if (scene.transfer == Transfer::XPIC || scene.transfer == Transfer::FMPM)
        text += fmt::format(" of order {}", scene.transferOrder);
    if (scene.filterRate)
        text += fmt::format(", {:g} 1/s of it", *scene.filterRate);
    if (scene.picRate > 0)
        text += fmt::format(" with {:g} 1/s of PIC", scene.picRate);
    if (scene.moveByStrainVelocity)
        text += ", particles moved by strainVelocity";
    return text + (scene.staggeredStart ? ", staggered start" : "");
}

std::vector<splitting::Barrier> wallBarriers(const Scene& scene, const state::GridBox& grid, double time)
{
    std::vector<splitting::Barrier> barriers;
    for (const auto& wall : scene.walls)
        barriers.push_back({wall.axis, wall.side, nodal::wallPosition(wall, grid, time)});
    return barriers;
}
} // namespace mpm::stepping

#include "stepping/stepper.hpp"

namespace mpm::stepping
{
std::vector<splitting::Barrier> wallBarriers(const Scene& scene, const state::GridBox& grid)
{
    std::vector<splitting::Barrier> barriers;
    for (const auto& wall : scene.walls)
        barriers.push_back({wall.axis, wall.side, grid.origin[wall.axis] + grid.h * double(wall.plane)});
    return barriers;
}
} // namespace mpm::stepping

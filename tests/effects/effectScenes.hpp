#pragma once
// Scenes the catalogue of effects is tried on: an elastic block that falls onto a smooth floor, all of it in motion.
#include "case/effectCatalogue.hpp"
#include "case/makeStepper.hpp"
#include "support/treatmentScenes.hpp"

namespace effects
{
using namespace mpm;
using cases::Effect;
using cases::EffectScene;

/// A few chunks of particles above a smooth floor at y = 3, far from all sides of the grid.
inline EffectScene block(int dim, stepping::StressUpdate update)
{
    const bool flat = dim == 2;
    EffectScene s;
    s.state = scenes::seedBlock({.dim = dim,
                                 .corner = {4.1, 3.05, flat ? 0 : 4.2},
                                 .n = {flat ? 14 : 6, flat ? 12 : 6, flat ? 1 : 5},
                                 .spacing = 0.5,
                                 .h = 1,
                                 .cells = {16, 14, flat ? 1 : 12},
                                 .velocity = {0.2, -0.6, 0}});
    treated::stir(s.state, 0.4);
    s.scene = treated::scene(scenes::elastic(1e6, 0.3), {}, update);
    s.scene.walls = {{"floor", nodal::WallType::roller, 1, -1, 3, 0, true}};
    return s;
}

inline constexpr double deltaT = 0.006; ///< 0.22 h/c_p

inline state::State run(EffectScene s, int steps)
{
    return treated::run(std::move(s.state), s.shape, s.scene, steps, deltaT);
}
} // namespace effects

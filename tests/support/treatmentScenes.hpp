#pragma once
/// Small bodies and laws for tests of stress treatments (treatment/).
#include "case/makeStepper.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "support/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <omp.h>

namespace treated
{
using namespace mpm;
using stepping::StressUpdate;
using treatment::AveragedPart;
using treatment::AveragingRegion;
using treatment::StressTreatment;
using treatment::VolumetricAveraging;

/// Bodies of a hundred particles: threads would only wait for each other.
inline const bool alone = (omp_set_num_threads(1), true);

inline const std::vector<std::string> shapes = {"linear",           "uGIMP",       "cpGIMP", "CPDI",
                                                "quadraticBSpline", "cubicBSpline"};
inline constexpr StressUpdate updates[] = {StressUpdate::USF, StressUpdate::USL, StressUpdate::MUSL};

inline constitutive::Material soil(double E, double nu, double cohesion, double friction, double dilation = 0)
{
    return {"solid", 1000,
            std::make_shared<constitutive::MohrCoulomb>(
                constitutive::MohrCoulombParameters{{E, nu}, cohesion, friction, dilation})};
}

/// A free block of 6 x 6 particles (by 2 in 3D), two a cell, off the nodes.
inline state::State block(int dim = 2)
{
    return scenes::seedBlock({.dim = dim,
                              .corner = {3.1, 3.3, dim == 3 ? 3.2 : 0},
                              .n = {6, 6, dim == 3 ? 2 : 1},
                              .spacing = 0.5,
                              .h = 1,
                              .cells = {9, 9, dim == 3 ? 9 : 1}});
}

/// Velocities without any order, of about `speed`.
inline void stir(state::State& s, double speed)
{
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        for (int a = 0; a < p.dim; ++a)
            p.v[a][i] += speed * std::sin(3 * p.x[(a + 1) % p.dim][i] + 5 * p.x[a][i] + 7 * a);
    p.padLastChunk();
}

inline stepping::Scene scene(const constitutive::Material& material, const StressTreatment& treatment,
                             StressUpdate update = StressUpdate::MUSL)
{
    stepping::Scene out;
    out.materials = {material};
    out.stressUpdate = update;
    out.treatment = treatment;
    return out;
}

inline StressTreatment averaged(AveragingRegion region, int repeats, AveragedPart of = AveragedPart::total,
                                bool conjugate = false)
{
    StressTreatment t;
    t.averaging = VolumetricAveraging{};
    t.averaging->region = region;
    t.averaging->repeats = repeats;
    t.averaging->of = of;
    t.averaging->conjugate = conjugate;
    return t;
}

/// The state after n steps of dt, its ledger begun.
inline state::State run(state::State s, const std::string& shape, const stepping::Scene& scene, int n, double dt)
{
    auto stepper = cases::makeStepper(shape, s, scene);
    if (s.step == 0)
        stepping::beginLedger(s, scene.materials);
    for (int k = 0; k < n; ++k)
        stepper->step(dt);
    return s;
}

inline double meanStress(const state::Particles& p, std::size_t i)
{
    return (double(p.stress[0][i]) + double(p.stress[1][i]) + double(p.stress[2][i])) / 3;
}

inline double residual(const state::State& s, const stepping::Scene& scene)
{
    return std::abs(stepping::residual(s.ledger, stepping::totals(s, scene.materials).strainEnergy));
}

/// Particles in the order of their ids.
inline std::vector<std::size_t> byId(const state::Particles& p)
{
    std::vector<std::size_t> order(std::size_t(p.size()));
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p.id[a] < p.id[b]; });
    return order;
}
} // namespace treated

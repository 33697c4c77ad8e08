#pragma once
/// Scenes of several bodies: blocks of particles, each of a material of its own, and contact between them.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace bodies
{
using namespace mpm;

/// One body of a scene: a block of particles of material `material`.
struct Body
{
    scenes::Block block;
    int material = 0;
};

inline state::State join(const std::vector<Body>& bodies)
{
    auto all = scenes::seedBlock(bodies.front().block);
    auto& p = all.particles;
    all.materials.clear();
    int materials = 0;
    std::fill_n(p.material.begin(), p.size(), bodies.front().material);
    for (std::size_t b = 1; b < bodies.size(); ++b)
    {
        const auto more = scenes::seedBlock(bodies[b].block);
        for (Index i = 0; i < more.particles.size(); ++i)
        {
            const std::size_t n = std::size_t(p.appendCopy(0)), from = std::size_t(i);
            for (int a = 0; a < p.dim; ++a)
            {
                p.x[a][n] = more.particles.x[a][from];
                p.v[a][n] = more.particles.v[a][from];
                p.length0[a][n] = more.particles.length0[a][from];
            }
            p.mass[n] = more.particles.mass[from];
            p.volume[n] = p.volume0[n] = more.particles.volume[from];
            p.id[n] = all.nextId++;
            p.material[n] = bodies[b].material;
        }
    }
    for (const auto& body : bodies)
        materials = std::max(materials, body.material + 1);
    for (int m = 0; m < materials; ++m)
        all.materials.push_back("body" + std::to_string(m));
    p.padLastChunk();
    return all;
}

inline nodal::ContactProperties contactOf(int bodies, double mu)
{
    nodal::ContactProperties contact;
    for (int b = 0; b < bodies; ++b)
    {
        contact.bodies.push_back("body" + std::to_string(b));
        contact.bodyOf.push_back(b);
    }
    contact.mu.assign(std::size_t(bodies), std::vector<double>(std::size_t(bodies), mu));
    return contact;
}

inline stepping::Scene sceneOf(int bodies, double mu, double E = 1e6, double nu = 0)
{
    stepping::Scene scene;
    for (int b = 0; b < bodies; ++b)
        scene.materials.push_back(scenes::elastic(E, nu));
    scene.contact = contactOf(bodies, mu);
    return scene;
}

struct Motion
{
    double mass = 0;
    Vector3 centre{}, velocity{};
};

inline Motion motionOf(const state::State& s, int material)
{
    Motion m;
    const auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        if (p.material[i] == material)
        {
            m.mass += p.mass[i];
            for (int a = 0; a < p.dim; ++a)
            {
                m.centre[a] += p.mass[i] * p.x[a][i];
                m.velocity[a] += p.mass[i] * p.v[a][i];
            }
        }
    for (int a = 0; a < 3; ++a)
    {
        m.centre[a] /= m.mass;
        m.velocity[a] /= m.mass;
    }
    return m;
}

/// Every number of every particle, by id.
inline std::map<std::int64_t, std::vector<double>> byId(const state::Particles& p)
{
    std::map<std::int64_t, std::vector<double>> out;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        auto& row = out[p.id[i]];
        for (int a = 0; a < p.dim; ++a)
        {
            row.push_back(p.x[a][i]);
            row.push_back(p.v[a][i]);
        }
        for (int k = 0; k < stressComponents(p.dim); ++k)
            row.push_back(p.stress[k][i]);
        for (int k = 0; k < p.dim * p.dim; ++k)
            row.push_back(p.F[k][i]);
    }
    return out;
}

inline double run(state::State& s, const stepping::Scene& scene, int steps, double dt)
{
    auto stepper = cases::makeStepper("uGIMP", s, scene);
    stepping::beginLedger(s, scene.materials);
    for (int i = 0; i < steps; ++i)
        stepper->step(dt);
    return stepping::residual(s.ledger, stepping::totals(s, scene.materials).strainEnergy);
}

inline const std::vector<stepping::StressUpdate> updates = {stepping::StressUpdate::USF, stepping::StressUpdate::USL,
                                                            stepping::StressUpdate::MUSL};
} // namespace bodies

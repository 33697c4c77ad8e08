#pragma once
/// A state in which every number differs and no array is trivial, valid, in the order (sortKey, id).
#include "output/ledgerEntries.hpp"
#include "state/state.hpp"

#include <cmath>
#include <random>
#include <type_traits>

namespace mpm::tests
{
inline state::State sampleState(int dim, Index n)
{
    std::mt19937_64 engine(static_cast<unsigned>(n + dim));
    std::uniform_real_distribution<double> uniform(-1, 1);
    state::State state(dim);
    auto& p = state.particles;
    p.resize(n);
    for (std::size_t i = 0; i < std::size_t(n); ++i)
    {
        for (std::size_t a = 0; a < std::size_t(dim); ++a)
        {
            p.x[a][i] = 5 * uniform(engine);
            p.v[a][i] = uniform(engine);
            p.length0[a][i] = 0.1 + 0.01 * uniform(engine);
        }
        for (std::size_t k = 0; k < std::size_t(stressComponents(dim)); ++k)
            p.stress[k][i] = 1e5 * uniform(engine);
        for (std::size_t k = 0; k < std::size_t(dim * dim); ++k)
            p.F[k][i] = (k % std::size_t(dim + 1) == 0 ? 1 : 0) + 0.2 * uniform(engine);
        p.mass[i] = 10 + uniform(engine);
        p.volume0[i] = 0.01 + 0.001 * uniform(engine);
        p.volume[i] = 0.01 + 0.001 * uniform(engine);
        p.id[i] = std::int64_t(3 * i + 1);
        p.sortKey[i] = std::int64_t(i / 3);
        p.material[i] = std::int32_t(i % 2);
        p.generation[i] = std::int32_t(i % 5);
    }
    if (n > 0)
        p.v[0][0] = -0.0;
    p.padLastChunk();

    state.time = 0.1 + 0.2;
    state.step = 1234567890123;
    state.deltaT = 1.0 / 3.0;
    state.seedSpacing = {0.13, 0.14, dim == 3 ? 0.15 : 0.0};
    state.nextId = 3 * n + 17;
    state.grid.origin = {-12.1, 0.3, dim == 3 ? 0.7 : 0.0};
    state.grid.h = 4.0 / 15.0;
    state.grid.cells = {105, 45, dim == 3 ? 3 : 1};
    state.materials = {"soil", "rock"};
    double value = 0.1;
    output::forEachLedgerEntry(state.ledger, [&](const std::string& name, auto& entry, const std::string&) {
        if constexpr (std::is_same_v<std::decay_t<decltype(entry)>, Vector3>)
            entry = {value *= 1.1, value *= -1.3, value *= 1.9};
        else if constexpr (std::is_same_v<std::decay_t<decltype(entry)>, double>)
            entry = (value *= -1.7);
        else
            entry = Index(name.size() * 7 + std::size_t(name[0]));
    });

    for (const char* name : {"top", "side/left 100%", "base"})
    {
        state::SurfacePatch patch;
        patch.name = name;
        for (std::size_t k = 0; k < std::size_t(dim); ++k)
            patch.centre[k] = {value *= 1.01, value *= -1.02};
        for (std::size_t k = 0; k < std::size_t(dim * (dim - 1)); ++k)
            patch.edges[k] = {value *= 1.03, value *= -1.04};
        state.patches.push_back(patch);
    }
    state.provenance = {{"version", "0.1.0"},
                        {"system/controlDict", "deltaT 1e-3;\n// \"\xc3\xa9\"\n"},
                        {"empty", ""},
                        {".", "a dot"},
                        {"100%/2F", "percent"}};
    return state;
}
} // namespace mpm::tests

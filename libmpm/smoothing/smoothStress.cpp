#include "smoothing/smoothStress.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

namespace mpm::smoothing
{
SmoothedStress smoothColumns(const std::vector<const double*>& columns, const state::Particles& p,
                             const WeightTable& table)
{
    if (table.particles() != p.size())
        throw InputError(fmt::format("weights of {} particles for {} particles", table.particles(), p.size()));
    const auto nodes = std::size_t(table.nodes()), particles = std::size_t(p.size());
    std::vector<double> mass(nodes, 0.0);
    StressColumns nodal(columns.size(), std::vector<double>(nodes, 0.0));
    for (std::size_t i = 0; i < particles; ++i)
        table.visitNodes(Index(i), [&](std::size_t node, double weight) {
            mass[node] += p.mass[i] * weight;
            for (std::size_t c = 0; c < columns.size(); ++c)
                nodal[c][node] += p.mass[i] * weight * columns[c][i];
        });

    SmoothedStress out;
    out.nodal.resize(columns.size());
    out.smoothed.assign(columns.size(), std::vector<double>(particles, 0.0));
    for (std::size_t node = 0; node < nodes; ++node)
    {
        if (mass[node] <= 0)
            continue;
        out.nodePosition.push_back(table.position[node]);
        out.nodeMass.push_back(mass[node]);
        for (std::size_t c = 0; c < columns.size(); ++c)
            out.nodal[c].push_back(nodal[c][node] /= mass[node]);
    }
    for (std::size_t i = 0; i < particles; ++i)
        table.visitNodes(Index(i), [&](std::size_t node, double weight) {
            for (std::size_t c = 0; c < columns.size(); ++c)
                out.smoothed[c][i] += weight * nodal[c][node];
        });
    return out;
}

SmoothedStress smoothStress(const state::Particles& p, const WeightTable& table)
{
    std::vector<const double*> columns;
    for (int c = 0; c < stressComponents(p.dim); ++c)
        columns.push_back(p.stress[std::size_t(c)].data());
    return smoothColumns(columns, p, table);
}
} // namespace mpm::smoothing

#include "smoothing/referenceField.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::smoothing
{
ReferenceField::ReferenceField(const state::State& other, const std::string& shape, std::size_t component)
    : dim_(other.particles.dim), grid_(other.grid), shape_(shape)
{
    const auto& p = other.particles;
    for (std::size_t a = 0; a < std::size_t(dim_); ++a)
        spacing_[a] = other.seedSpacing[a] > 0 ? other.seedSpacing[a] : 0.5 * grid_.h;
    const auto n = std::size_t(p.size());
    std::vector<double> stress(n), perMass(n);
    for (std::size_t i = 0; i < n; ++i)
    {
        stress[i] = p.stress[component][i];
        perMass[i] = p.volume[i] / p.mass[i];
    }
    const auto nodal = smoothColumns({stress.data(), perMass.data()}, p, weightTable(other, shape));
    const double cell = std::pow(grid_.h, dim_);
    for (std::size_t i = 0; i < nodal.nodeMass.size(); ++i)
        nodes_[key(nodal.nodePosition[i])] = {nodal.nodal[0][i], nodal.nodal[1][i] * nodal.nodeMass[i] / cell};
}

/// Nodes that are one across a periodic side have one key.
Index ReferenceField::key(const Vector3& position) const
{
    Index out = 0;
    for (std::size_t a = 0; a < std::size_t(dim_); ++a)
    {
        Index node = std::lround((position[a] - grid_.origin[a]) / grid_.h);
        if (grid_.periodic[a])
            node = (node % grid_.cells[a] + grid_.cells[a]) % grid_.cells[a];
        out = (out << 20) + node + 8; // ghosts lie before node 0
    }
    return out;
}

std::vector<double> ReferenceField::at(const state::Particles& ours) const
{
    if (ours.dim != dim_)
        throw InputError(fmt::format("found a case of dimension {}, allowed {}", dim_, ours.dim));
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < std::size_t(ours.size()); ++i)
    {
        Vector3 x{};
        for (std::size_t a = 0; a < std::size_t(dim_); ++a)
            x[a] = ours.x[a][i];
        if (grid_.contains(x))
            inside.push_back(i);
    }
    state::State probe(dim_);
    probe.grid = grid_;
    probe.particles.resize(Index(inside.size()));
    for (std::size_t a = 0; a < std::size_t(dim_); ++a)
        for (std::size_t i = 0; i < inside.size(); ++i)
        {
            probe.particles.x[a][i] = ours.x[a][inside[i]];
            probe.particles.length0[a][i] = state::Stored(spacing_[a]);
        }
    probe.particles.padLastChunk();

    std::vector<double> out(std::size_t(ours.size()), std::nan(""));
    const auto table = weightTable(probe, shape_);
    std::vector<const Node*> there(table.position.size());
    for (std::size_t node = 0; node < there.size(); ++node)
    {
        const auto found = nodes_.find(key(table.position[node]));
        there[node] = found == nodes_.end() ? nullptr : &found->second;
    }
    const double corner = (1 - 1e-9) * std::pow(0.5, dim_);
    for (std::size_t i = 0; i < inside.size(); ++i)
    {
        double stress = 0, full = 0;
        bool around = true;
        table.visitNodes(Index(i), [&](std::size_t node, double weight) {
            around = around && there[node];
            if (!there[node])
                return;
            stress += weight * there[node]->stress;
            full += weight * there[node]->full;
        });
        if (around && full >= corner)
            out[inside[i]] = stress;
    }
    return out;
}

Comparison compare(const state::Particles& p, const std::vector<double>& raw, const std::vector<double>& smoothed,
                   const std::vector<double>& reference)
{
    Comparison out;
    double all = 0, mass = 0, count = 0;
    for (std::size_t i = 0; i < raw.size(); ++i)
    {
        all += p.mass[i];
        if (std::isnan(reference[i]))
            continue;
        const double error = raw[i] - reference[i], smooth = smoothed[i] - reference[i];
        count += 1;
        mass += p.mass[i];
        out.raw += error * error;
        out.rawByMass += p.mass[i] * error * error;
        out.smoothed += smooth * smooth;
        out.reference += reference[i] * reference[i];
    }
    for (double* square : {&out.raw, &out.smoothed, &out.reference})
        *square = std::sqrt(*square / count);
    out.rawByMass = std::sqrt(out.rawByMass / mass);
    out.massShare = all > 0 ? mass / all : 0;
    return out;
}
} // namespace mpm::smoothing

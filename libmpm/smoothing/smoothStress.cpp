#include "smoothing/smoothStress.hpp"

#include "base/error.hpp"

#include <fmt/format.h>

namespace mpm::smoothing
{
namespace
{
/// Smooths `width` columns from the given one on and appends them. Node values stand side by side.
template <std::size_t width>
void append(SmoothedStress& out, const std::vector<const double*>& columns, std::size_t from,
            const std::vector<double>& mass, const state::Particles& p, const WeightTable& table)
{
    const auto particles = std::size_t(p.size());
    std::vector<std::array<double, width>> nodal(mass.size());
    for (std::size_t i = 0; i < particles; ++i)
    {
        std::array<double, width> own;
        for (std::size_t c = 0; c < width; ++c)
            own[c] = columns[from + c][i];
        table.visitNodes(Index(i), [&](std::size_t node, double weight) {
            const double share = p.mass[i] * weight;
            for (std::size_t c = 0; c < width; ++c)
                nodal[node][c] += share * own[c];
        });
    }
    table.joinImages(nodal);
    for (std::size_t c = 0; c < width; ++c)
    {
        auto& values = out.nodal.emplace_back();
        values.reserve(out.nodeMass.size());
        for (std::size_t node = 0; node < mass.size(); ++node)
            if (mass[node] > 0)
                values.push_back(nodal[node][c] /= mass[node]);
        out.smoothed.emplace_back(particles);
    }
    for (std::size_t i = 0; i < particles; ++i)
    {
        std::array<double, width> own{};
        table.visitNodes(Index(i), [&](std::size_t node, double weight) {
            for (std::size_t c = 0; c < width; ++c)
                own[c] += weight * nodal[node][c];
        });
        for (std::size_t c = 0; c < width; ++c)
            out.smoothed[from + c][i] = own[c];
    }
}

[[maybe_unused]] const double* asDoubles(const state::Column<double>& column, std::vector<std::vector<double>>&)
{
    return column.data();
}

[[maybe_unused]] const double* asDoubles(const state::Column<float>& column, std::vector<std::vector<double>>& copies)
{
    return copies.emplace_back(column.begin(), column.end()).data();
}
} // namespace

std::vector<const double*> stressColumns(const state::Particles& p, StressColumns& widened)
{
    std::vector<const double*> columns;
    for (std::size_t c = 0; c < std::size_t(stressComponents(p.dim)); ++c)
        columns.push_back(asDoubles(p.stress[c], widened));
    return columns;
}

SmoothedStress smoothColumns(const std::vector<const double*>& columns, const state::Particles& p,
                             const WeightTable& table)
{
    if (table.particles() != p.size())
        throw InputError(fmt::format("weights of {} particles for {} particles", table.particles(), p.size()));
    std::vector<double> mass(std::size_t(table.nodes()), 0.0);
    for (Index i = 0; i < p.size(); ++i)
        table.visitNodes(i, [&](std::size_t node, double weight) { mass[node] += p.mass[std::size_t(i)] * weight; });
    table.joinImages(mass);
    SmoothedStress out;
    for (std::size_t node = 0; node < mass.size(); ++node)
        if (mass[node] > 0)
        {
            out.nodePosition.push_back(table.position[node]);
            out.nodeMass.push_back(mass[node]);
        }
    std::size_t done = 0;
    for (; done + 4 <= columns.size(); done += 4) // all of plane strain at once
        append<4>(out, columns, done, mass, p, table);
    for (; done < columns.size(); ++done)
        append<1>(out, columns, done, mass, p, table);
    return out;
}

SmoothedStress smoothStress(const state::Particles& p, const WeightTable& table)
{
    StressColumns widened;
    return smoothColumns(stressColumns(p, widened), p, table);
}
} // namespace mpm::smoothing

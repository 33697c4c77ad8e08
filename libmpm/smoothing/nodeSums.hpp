#pragma once
/// Sums over the particles at nodes and back, for any number of columns side by side. A thread sums the nodes of its
/// own range over all particles in their order, so the result is that of one thread bit by bit.
#include "smoothing/weightTable.hpp"

#include <omp.h>

namespace mpm::smoothing
{
inline constexpr Index manyParticles = 100000; ///< worth a second thread

/// Calls add(sums[node], read(p), node, N_ip) for all particles p and their nodes; images of a node get their total.
template <class Sum, class Read, class Add>
std::vector<Sum> sumAtNodes(const WeightTable& table, Read&& read, Add&& add)
{
    const Index particles = table.particles(), nodes = table.nodes();
    const auto n = std::size_t(table.nodesPerAxis), rows = table.dim == 3 ? n * n : n;
    std::vector<Sum> sums(std::size_t(nodes), Sum{});
#pragma omp parallel if (particles >= manyParticles)
    {
        const Index thread = omp_get_thread_num(), threads = omp_get_num_threads();
        const Index first = nodes * thread / threads, end = nodes * (thread + 1) / threads;
        for (Index p = 0; p < particles; ++p)
        {
            const Index* row = table.rows.data() + std::size_t(table.cell[std::size_t(p)]) * rows;
            if (row[0] >= end || row[rows - 1] + Index(n) <= first) // nodes of a support ascend
                continue;
            const auto own = read(std::size_t(p));
            table.visitNodes(p, [&](std::size_t node, double weight) {
                if (Index(node) >= first && Index(node) < end)
                    add(sums[node], own, node, weight);
            });
        }
    }
    table.joinImages(sums);
    return sums;
}

/// As many columns as are smoothed side by side.
template <std::size_t width>
using Values = std::array<double, width>;

template <std::size_t width>
using Pointers = std::array<const double*, width>;

/// out[c][p] = evaluate(p)[c].
template <std::size_t width, class Evaluate>
void setParticles(const WeightTable& table, const std::array<double*, width>& out, Evaluate&& evaluate)
{
    const Index particles = table.particles();
#pragma omp parallel for schedule(static) if (particles >= manyParticles)
    for (Index p = 0; p < particles; ++p)
    {
        const Values<width> values = evaluate(p);
        for (std::size_t c = 0; c < width; ++c)
            out[c][p] = values[c];
    }
}
} // namespace mpm::smoothing

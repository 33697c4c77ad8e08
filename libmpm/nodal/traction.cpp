#include "nodal/traction.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace mpm::nodal
{
namespace
{
/// What a node carries of a load, or tells of a patch's motion. A surface that lies delta beyond a line of nodes, in
/// cells, gives these nodes a mass of delta^2/2, a hat of delta and so velocities of 1/delta: particles do not feel
/// them (their weights are delta^2), but a patch that followed them would be torn apart. So light nodes do not move it,
/// and take no more of the load than the delta that their mass stands for.
enum class Use
{
    load,
    motion
};

/// Hat functions of the 2^dim nodes around an element's centre, renormalised over nodes with mass.
template <int dim>
struct PointWeights
{
    static constexpr int count = 1 << dim;
    const Record* node[count]; ///< null where no mass is
    double N[count];
    double G[count][dim];

    PointWeights(const state::SurfacePatch& patch, Index e, const state::GridBox& grid, const state::TileGrid& nodes,
                 int body, double smallestMass, Use use)
    {
        Index base[3] = {0, 0, 0};
        double t[3] = {0, 0, 0};
        for (int a = 0; a < dim; ++a)
        {
            const double s = (patch.centre[a][std::size_t(e)] - grid.origin[a]) / grid.h;
            base[a] = Index(std::floor(s));
            t[a] = s - std::floor(s);
        }
        double total = 0, slope[dim] = {}, heaviest = 0;
        for (int c = 0; c < count; ++c)
        {
            Index index[3] = {base[0], base[1], base[2]};
            N[c] = 1;
            for (int a = 0; a < dim; ++a)
            {
                const bool up = c >> a & 1;
                index[a] += up;
                N[c] *= up ? t[a] : 1 - t[a];
                G[c][a] = (up ? 1 : -1) / grid.h;
                for (int b = 0; b < dim; ++b)
                    if (b != a)
                        G[c][a] *= (c >> b & 1) ? t[b] : 1 - t[b];
            }
            node[c] = nodes.find(index[0], index[1], index[2], body);
            if (!node[c] || !((*node[c])[0] > smallestMass))
            {
                node[c] = nullptr;
                continue;
            }
            heaviest = std::max(heaviest, (*node[c])[0]);
        }
        for (int c = 0; c < count; ++c)
        {
            if (!node[c])
                continue;
            const double mass = (*node[c])[0];
            if (use == Use::motion && mass < 0.01 * heaviest)
            {
                node[c] = nullptr;
                continue;
            }
            if (use == Use::load)
                N[c] = std::min(N[c], 2 * std::sqrt(mass / heaviest));
            total += N[c];
            for (int a = 0; a < dim; ++a)
                slope[a] += G[c][a];
        }
        if (!(total > 0))
            throw StepError(fmt::format("surface element {} of '{}' at ({:g}, {:g}, {:g}) lies where no particle is", e,
                                        patch.name, patch.centre[0][std::size_t(e)], patch.centre[1][std::size_t(e)],
                                        dim == 3 ? patch.centre[2][std::size_t(e)] : 0.0));
        for (int c = 0; c < count; ++c)
        {
            for (int a = 0; a < dim; ++a)
                G[c][a] = (G[c][a] - N[c] * slope[a] / total) / total;
            N[c] /= total;
        }
    }
};

/// Outward normal times area.
template <int dim>
Vector3 areaVector(const state::SurfacePatch& p, Index e)
{
    const auto edge = [&](int k) { return p.edges[k][std::size_t(e)]; };
    if constexpr (dim == 2)
        return {edge(1), -edge(0), 0};
    return {0.5 * (edge(1) * edge(5) - edge(2) * edge(4)), 0.5 * (edge(2) * edge(3) - edge(0) * edge(5)),
            0.5 * (edge(0) * edge(4) - edge(1) * edge(3))};
}
} // namespace

int bodyUnder(const state::SurfacePatch& patch, const state::Particles& p, const state::TileLayout& layout)
{
    if (!layout.hasBodies())
        return 0;
    constexpr Index most = 100; // elements that are asked
    std::map<int, Index> votes;
    for (Index n = 0; n < std::min(most, patch.size()); ++n)
    {
        const std::size_t e = std::size_t(n * patch.size() / std::min(most, patch.size()));
        double least = std::numeric_limits<double>::infinity();
        int body = 0;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            double square = 0;
            for (int a = 0; a < p.dim; ++a)
                square += (p.x[a][i] - patch.centre[a][e]) * (p.x[a][i] - patch.centre[a][e]);
            if (square < least || (square == least && layout.bodyOf(p.material[i]) < body))
            {
                least = square;
                body = layout.bodyOf(p.material[i]);
            }
        }
        ++votes[body];
    }
    int best = 0;
    for (const auto& [body, count] : votes)
        if (count > votes[best])
            best = body;
    return best;
}

template <int dim>
void Traction<dim>::scatter(const state::SurfacePatch& patch, const state::GridBox& grid, state::TileGrid& nodes,
                            double smallestMass)
{
    added_.clear();
    for (Index e = 0; e < patch.size(); ++e)
    {
        const Vector3 area = areaVector<dim>(patch, e);
        const double size = std::sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
        const PointWeights<dim> w(patch, e, grid, nodes, body_, smallestMass, Use::load);
        for (int c = 0; c < w.count; ++c)
        {
            if (!w.node[c])
                continue;
            Added add{const_cast<Record*>(w.node[c]), {}};
            for (int a = 0; a < dim; ++a)
            {
                add.force[a] = w.N[c] * (load_.pressure ? -load_.magnitude * area[a] : load_.traction[a] * size);
                (*add.node)[1 + dim + a] += add.force[a];
            }
            added_.push_back(add);
        }
    }
}

template <int dim>
std::pair<double, double> Traction<dim>::book(double dt, double& work, Vector3& impulse) const
{
    double start = 0, end = 0;
    for (const auto& add : added_)
    {
        const Record& r = *add.node;
        for (int a = 0; a < dim; ++a)
        {
            const double after = dt * add.force[a] * r[1 + a], change = dt * dt * add.force[a] * r[1 + dim + a];
            end += after;
            start += after - change;
            work += after - 0.5 * change;
            impulse[a] += dt * add.force[a];
        }
    }
    return {start, end};
}

template <int dim>
void movePatch(state::SurfacePatch& patch, const state::GridBox& grid, const state::TileGrid& nodes, int body,
               double smallestMass, double dt)
{
    for (Index e = 0; e < patch.size(); ++e)
    {
        const PointWeights<dim> w(patch, e, grid, nodes, body, smallestMass, Use::motion);
        double v[dim] = {}, L[dim][dim] = {};
        for (int c = 0; c < w.count; ++c)
            if (w.node[c])
                for (int a = 0; a < dim; ++a)
                {
                    const double va = (*w.node[c])[1 + a];
                    v[a] += w.N[c] * va;
                    for (int b = 0; b < dim; ++b)
                        L[a][b] += va * w.G[c][b];
                }
        for (int a = 0; a < dim; ++a)
            patch.centre[a][std::size_t(e)] += dt * v[a];
        for (int k = 0; k < dim - 1; ++k)
        {
            double change[dim] = {};
            for (int a = 0; a < dim; ++a)
                for (int b = 0; b < dim; ++b)
                    change[a] += dt * L[a][b] * patch.edges[k * dim + b][std::size_t(e)];
            for (int a = 0; a < dim; ++a)
                patch.edges[k * dim + a][std::size_t(e)] += change[a];
        }
    }
}

template class Traction<2>;
template class Traction<3>;
template void movePatch<2>(state::SurfacePatch&, const state::GridBox&, const state::TileGrid&, int, double, double);
template void movePatch<3>(state::SurfacePatch&, const state::GridBox&, const state::TileGrid&, int, double, double);
} // namespace mpm::nodal

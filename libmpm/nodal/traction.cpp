#include "nodal/traction.hpp"

#include "base/error.hpp"
#include "nodal/pointWeights.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace mpm::nodal
{
namespace
{
Vector3 centreOf(const state::SurfacePatch& patch, Index e, int dim)
{
    Vector3 x{};
    for (int a = 0; a < dim; ++a)
        x[std::size_t(a)] = patch.centre[std::size_t(a)][std::size_t(e)];
    return x;
}

/// Weights at an element's centre; StepError where no particle is.
template <int dim>
PointWeights<dim> weightsAt(const state::SurfacePatch& patch, Index e, const state::GridBox& grid,
                            const state::TileGrid& nodes, int body, double smallestMass, Use use)
{
    const Vector3 x = centreOf(patch, e, dim);
    PointWeights<dim> w(x, grid, nodes, body, smallestMass, use);
    if (!w.found)
        throw StepError(fmt::format("surface element {} of '{}' at ({:g}, {:g}, {:g}) lies where no particle is", e,
                                    patch.name, x[0], x[1], x[2]));
    return w;
}

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

int bodyUnder(const std::vector<Vector3>& points, const state::Particles& p, const state::TileLayout& layout)
{
    if (!layout.hasBodies())
        return 0;
    constexpr Index most = 100; // points that are asked
    const Index count = Index(points.size());
    std::map<int, Index> votes;
    for (Index n = 0; n < std::min(most, count); ++n)
    {
        const Vector3& x = points[std::size_t(n * count / std::min(most, count))];
        double least = std::numeric_limits<double>::infinity();
        int body = 0;
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            double square = 0;
            for (int a = 0; a < p.dim; ++a)
                square += (p.x[a][i] - x[std::size_t(a)]) * (p.x[a][i] - x[std::size_t(a)]);
            if (square < least || (square == least && layout.bodyOf(p.material[i]) < body))
            {
                least = square;
                body = layout.bodyOf(p.material[i]);
            }
        }
        ++votes[body];
    }
    int best = 0;
    for (const auto& [body, voices] : votes)
        if (voices > votes[best])
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
        const auto w = weightsAt<dim>(patch, e, grid, nodes, body_, smallestMass, Use::load);
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
        const auto w = weightsAt<dim>(patch, e, grid, nodes, body, smallestMass, Use::motion);
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

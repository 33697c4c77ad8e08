// Where bodies meet: nodes that two of them carry, normals and gaps. See contact.hpp.
#include "nodal/contact.hpp"
#include "nodal/hullDistance.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::nodal
{
/// What the nodes of one box that several bodies carry see of them.
template <int dim>
struct Contact<dim>::Clouds
{
    struct Seen
    {
        Index particle;
        Vector3 x; ///< moved by whole periods to where the box is
    };
    state::NodeBox range;                ///< of the box's nodes
    std::vector<int> ofNode;             ///< number of a node among those that several bodies carry, -1: it is none
    std::array<Index, 3> low{}, high{};  ///< of these
    std::vector<std::vector<Seen>> seen; ///< by number and body of the box
    std::size_t bodies = 0;
};

namespace
{
/// Half edges of a particle's domain.
template <int dim>
std::array<Vector3, dim> halfEdges(const state::Particles& p, Index i)
{
    std::array<Vector3, dim> edge{};
    for (int k = 0; k < dim; ++k)
        for (int a = 0; a < dim; ++a)
            edge[k][a] = 0.5 * p.length0[k][std::size_t(i)] * p.F[a * dim + k][std::size_t(i)];
    return edge;
}

/// Half width along n of the ellipsoid within a domain.
template <int dim>
double halfWidth(const std::array<Vector3, dim>& edge, const Vector3& n)
{
    double square = 0;
    for (const auto& e : edge)
    {
        const double along = e[0] * n[0] + e[1] * n[1] + e[2] * n[2];
        square += along * along;
    }
    return std::sqrt(square);
}

template <int dim>
std::array<Index, 3> nodeOf(const state::NodeBox& box, Index offset)
{
    return {box.lo[0] + offset % box.n[0], box.lo[1] + offset / box.n[0] % box.n[1],
            box.lo[2] + offset / (box.n[0] * box.n[1])};
}
} // namespace

template <int dim>
void Contact<dim>::find(const state::TileGrid& nodes, const state::Particles& particles, const state::GridBox& grid,
                        double smallestMass)
{
    forEachBox([&](Box& box) {
        Clouds clouds;
        findPairs(nodes, smallestMass, box, clouds);
        if (box.pairs.empty())
            return;
        gatherClouds(nodes, particles, grid, box, clouds);
        const auto lost = [&](Pair& pair) { return !locate(particles, clouds, grid.h, pair); };
        box.pairs.erase(std::remove_if(box.pairs.begin(), box.pairs.end(), lost), box.pairs.end());
    });
}

template <int dim>
void Contact<dim>::findPairs(const state::TileGrid& nodes, double smallestMass, Box& box, Clouds& clouds) const
{
    box.pairs.clear();
    const auto blockOf = [&](std::size_t b) -> const state::Block& {
        return nodes.blocks()[std::size_t(box.blocks[b])];
    };
    clouds.bodies = box.blocks.size();
    clouds.range = blockOf(0).box;
    for (std::size_t b = 1; b < box.blocks.size(); ++b)
    {
        const auto& other = blockOf(b).box;
        for (int a = 0; a < 3; ++a)
        {
            const Index end = std::max(clouds.range.lo[a] + clouds.range.n[a], other.lo[a] + other.n[a]);
            clouds.range.lo[a] = std::min(clouds.range.lo[a], other.lo[a]);
            clouds.range.n[a] = end - clouds.range.lo[a];
        }
    }
    clouds.ofNode.assign(std::size_t(clouds.range.size()), -1);
    int count = 0;
    for (Index offset = 0; offset < clouds.range.size(); ++offset)
    {
        const auto node = nodeOf<dim>(clouds.range, offset);
        const std::size_t before = box.pairs.size();
        const auto placeOf = [&](const state::Block& block) -> Index {
            if (!block.box.contains(node[0], node[1], node[2]))
                return -1;
            const Index place = Index(block.start) + block.box.offset(node[0], node[1], node[2]);
            return nodes.place(0)[place][0] > smallestMass ? place : -1;
        };
        for (std::size_t one = 0; one + 1 < box.blocks.size(); ++one)
            for (std::size_t other = one + 1; other < box.blocks.size(); ++other)
            {
                const Index place = placeOf(blockOf(one)), otherPlace = placeOf(blockOf(other));
                Pair pair;
                pair.rigid = {rigid(blockOf(one).body), rigid(blockOf(other).body)};
                if (place < 0 || otherPlace < 0 || (pair.rigid[0] && pair.rigid[1]))
                    continue;
                pair.place = {place, otherPlace};
                pair.side = {one, other};
                pair.node = offset;
                pair.mu = properties_.mu[std::size_t(blockOf(one).body)][std::size_t(blockOf(other).body)];
                box.pairs.push_back(pair);
            }
        if (box.pairs.size() == before)
            continue;
        clouds.ofNode[std::size_t(offset)] = count;
        for (int a = 0; a < 3; ++a)
        {
            clouds.low[a] = count == 0 ? node[a] : std::min(clouds.low[a], node[a]);
            clouds.high[a] = count == 0 ? node[a] : std::max(clouds.high[a], node[a]);
        }
        ++count;
    }
    clouds.seen.resize(std::size_t(count) * clouds.bodies);
}

template <int dim>
void Contact<dim>::gatherClouds(const state::TileGrid& nodes, const state::Particles& p, const state::GridBox& grid,
                                const Box& box, Clouds& clouds) const
{
    for (std::size_t body = 0; body < box.blocks.size(); ++body)
        for (const auto& overlap : nodes.blocks()[std::size_t(box.blocks[body])].tiles)
        {
            const state::Tile& tile = nodes.tiles()[std::size_t(overlap.tile)];
            const auto window = tile.window.moved(overlap.move);
            bool reaches = true;
            for (int a = 0; a < dim; ++a)
                reaches = reaches && window.lo[a] <= clouds.high[a] && window.lo[a] + window.n[a] > clouds.low[a];
            for (Index i = tile.first; i < tile.first + tile.count && reaches; ++i)
            {
                std::array<Index, 3> first = clouds.low, last = clouds.high;
                Vector3 x{};
                bool near = true;
                for (int a = 0; a < dim && near; ++a)
                {
                    x[a] = p.x[a][std::size_t(i)] + grid.h * double(overlap.move[a]);
                    const double s = (x[a] - grid.origin[a]) / grid.h;
                    constexpr double most = 2;
                    near = s > double(first[a]) - most && s < double(last[a]) + most;
                }
                if (!near)
                    continue;
                const auto edge = halfEdges<dim>(p, i);
                for (int a = 0; a < dim; ++a)
                {
                    Vector3 axis{};
                    axis[a] = 1;
                    const double s = (x[a] - grid.origin[a]) / grid.h;
                    const double reach =
                        reach_.domains ? 1 + std::min(1.0, halfWidth<dim>(edge, axis) / grid.h) : reach_.points;
                    first[a] = std::max(first[a], Index(std::floor(s - reach)) + 1);
                    last[a] = std::min(last[a], Index(std::ceil(s + reach)) - 1);
                }
                for (Index k = first[2]; k <= last[2]; ++k)
                    for (Index j = first[1]; j <= last[1]; ++j)
                        for (Index n = first[0]; n <= last[0]; ++n)
                            if (const int number = clouds.ofNode[std::size_t(clouds.range.offset(n, j, k))];
                                number >= 0)
                                clouds.seen[std::size_t(number) * clouds.bodies + body].push_back({i, x});
            }
        }
}

/// Normal and gap of a pair; false where one body's particles do not reach the node after all.
template <int dim>
bool Contact<dim>::locate(const state::Particles& p, const Clouds& clouds, double h, Pair& pair) const
{
    std::vector<Vector3> points[2];
    Vector3 middle[2]{};
    const auto cloud = [&](int s) -> const auto&
    {
        return clouds.seen[std::size_t(clouds.ofNode[std::size_t(pair.node)]) * clouds.bodies + pair.side[s]];
    };
    for (int s = 0; s < 2; ++s)
    {
        if (cloud(s).empty())
            return false;
        for (const auto& seen : cloud(s))
        {
            points[s].push_back(seen.x);
            for (int a = 0; a < dim; ++a)
                middle[s][a] += seen.x[a] / double(cloud(s).size());
        }
    }
    if (const auto n = separatingNormal(points[0], points[1], 1e-6 * h))
        pair.n = *n;
    else
    {
        double length = 0;
        for (int a = 0; a < dim; ++a)
        {
            pair.n[a] = middle[1][a] - middle[0][a];
            length += pair.n[a] * pair.n[a];
        }
        if (!(length > 0))
            return false;
        for (int a = 0; a < dim; ++a)
            pair.n[a] /= std::sqrt(length);
    }
    pair.gap = 0;
    if (properties_.detection == ContactDetection::nodes)
        return true;
    double edge[2]{};
    for (int s = 0; s < 2; ++s)
    {
        const double sign = s == 0 ? 1 : -1;
        bool first = true;
        for (const auto& seen : cloud(s))
        {
            double along = halfWidth<dim>(halfEdges<dim>(p, seen.particle), pair.n);
            for (int a = 0; a < dim; ++a)
                along += sign * pair.n[a] * seen.x[a];
            edge[s] = first ? along : std::max(edge[s], along);
            first = false;
        }
    }
    pair.gap = -edge[1] - edge[0];
    return true;
}

template void Contact<2>::find(const state::TileGrid&, const state::Particles&, const state::GridBox&, double);
template void Contact<3>::find(const state::TileGrid&, const state::Particles&, const state::GridBox&, double);
} // namespace mpm::nodal

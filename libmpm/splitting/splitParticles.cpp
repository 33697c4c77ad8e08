#include "splitting/splitParticles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm::splitting
{
namespace
{
struct Edges
{
    double vector[3][3] = {}; ///< vector[k] = F l0_k
    bool cut[3] = {};
    int cuts = 0;
};

Edges deformedEdges(const state::State& s, const Rule& rule, std::size_t i)
{
    const auto& p = s.particles;
    Edges e;
    bool any = false;
    for (int k = 0; k < p.dim; ++k)
    {
        double square = 0;
        for (int a = 0; a < p.dim; ++a)
        {
            e.vector[k][a] = double(p.F[a * p.dim + k][i]) * double(p.length0[k][i]);
            square += e.vector[k][a] * e.vector[k][a];
        }
        const double longest = rule.threshold * s.seedSpacing[k];
        e.cut[k] = square > longest * longest;
        any = any || e.cut[k];
    }
    for (int k = 0; k < p.dim; ++k)
    {
        e.cut[k] = rule.mode == Mode::fourWay ? any : e.cut[k];
        e.cuts += e.cut[k];
    }
    return e;
}

/// Does any of the chunk's particles have an edge over the threshold? Without branches, so that it costs no more than
/// reading F and length0; padding lanes copy the last particle.
template <int dim>
bool anyLongEdge(const state::State& s, const Rule& rule, Index first)
{
    const auto& p = s.particles;
    double over = 0; // largest square of an edge less that of the threshold
    for (int k = 0; k < dim; ++k)
    {
        const double longest = rule.threshold * s.seedSpacing[std::size_t(k)], allowed = longest * longest;
        const state::Stored* length = p.length0[std::size_t(k)].data() + first;
        const state::Stored* F[dim];
        for (int a = 0; a < dim; ++a)
            F[a] = p.F[std::size_t(a * dim + k)].data() + first;
        double worst[8] = {};
        for (int l = 0; l < lanes; l += 8)
            for (int i = 0; i < 8; ++i)
            {
                double square = 0;
                for (int a = 0; a < dim; ++a)
                {
                    const double edge = double(F[a][l + i]) * double(length[l + i]);
                    square += edge * edge;
                }
                worst[i] = square > worst[i] ? square : worst[i];
            }
        for (const double square : worst)
            over = std::max(over, square - allowed);
    }
    return over > 0;
}

/// Chunks that hold a particle with a long edge.
std::vector<Index> chunksToSplit(const state::State& s, const Rule& rule, const std::vector<Range>* where)
{
    const Index chunks = s.particles.chunks();
    std::vector<char> any(static_cast<std::size_t>(chunks), where ? 0 : 1);
    for (std::size_t r = 0; where && r < where->size(); ++r)
        for (Index c = (*where)[r].first / lanes; c * lanes < (*where)[r].end; ++c)
            any[std::size_t(c)] = 1;
#pragma omp parallel for schedule(static) if (chunks > 1000)
    for (Index c = 0; c < chunks; ++c)
        if (any[std::size_t(c)])
            any[std::size_t(c)] =
                s.particles.dim == 2 ? anyLongEdge<2>(s, rule, c * lanes) : anyLongEdge<3>(s, rule, c * lanes);
    std::vector<Index> found;
    for (Index c = 0; c < chunks; ++c)
        if (any[std::size_t(c)])
            found.push_back(c);
    return found;
}

/// Largest common factor of the offsets for which no child's domain crosses a barrier.
double offsetFactor(const state::Particles& p, const std::vector<Barrier>& barriers, const Edges& e, std::size_t i)
{
    double factor = 1;
    for (const auto& wall : barriers)
    {
        double reach = 0, extent = 0;
        for (int k = 0; k < p.dim; ++k)
        {
            const double along = std::abs(e.vector[k][wall.axis]);
            reach += e.cut[k] ? 0.25 * along : 0;
            extent += (e.cut[k] ? 0.25 : 0.5) * along;
        }
        const double distance = -wall.side * (p.x[wall.axis][i] - wall.position);
        if (distance - reach - extent < 0 && reach > 0)
            factor = std::min(factor, (distance - extent) / reach);
    }
    return factor;
}

/// Moment of momentum m x v (the z component in 2D) of one particle.
Vector3 angularMomentum(const state::Particles& p, std::size_t i)
{
    const double x = p.x[0][i], y = p.x[1][i], z = p.dim == 3 ? p.x[2][i] : 0;
    const double u = p.v[0][i], v = p.v[1][i], w = p.dim == 3 ? p.v[2][i] : 0, m = p.mass[i];
    return {m * (y * w - z * v), m * (z * u - x * w), m * (x * v - y * u)};
}

double kineticEnergy(const state::Particles& p, std::size_t i)
{
    double vv = 0;
    for (int a = 0; a < p.dim; ++a)
        vv += double(p.v[a][i]) * double(p.v[a][i]);
    return 0.5 * p.mass[i] * vv;
}

/// Replaces particle i by its children and returns how many were added.
Index makeChildren(state::State& s, Index i, const Edges& e, double factor)
{
    auto& p = s.particles;
    const std::size_t parent = std::size_t(i);
    const Vector3 before = angularMomentum(p, parent);
    double energy = kineticEnergy(p, parent);
    Vector3 centre{};
    for (int a = 0; a < p.dim; ++a)
        centre[a] = p.x[a][parent];
    const double share = 1.0 / (1 << e.cuts);
    p.mass[parent] *= share;
    p.volume0[parent] *= share;
    p.volume[parent] *= share;
    p.generation[parent] += 1;
    Vector3 centreX{}, quarter{}; // of the reference domain, whose edges follow the axes
    for (int k = 0; k < p.dim; ++k)
    {
        centreX[k] = p.hasX() ? p.X[k][parent] : 0;
        quarter[k] = 0.25 * factor * double(p.length0[k][parent]);
        if (e.cut[k])
            p.length0[k][parent] *= 0.5;
    }

    Vector3 change{-before[0], -before[1], -before[2]};
    for (int child = 0; child < 1 << e.cuts; ++child)
    {
        const std::size_t c = child == 0 ? parent : std::size_t(p.appendCopy(i));
        if (child > 0)
        {
            // until the next sort children stand last, in the order of their ids, as (sortKey, id) says
            p.id[c] = s.nextId++;
            p.sortKey[c] = std::numeric_limits<std::int64_t>::max();
            if (p.has(&state::Particles::family))
                p.family[c] = double(p.id[parent] + 1);
        }
        int bit = 0;
        Vector3 offset{};
        for (int k = 0; k < p.dim; ++k)
            if (e.cut[k])
            {
                const double sign = (child >> bit++ & 1) ? 1 : -1;
                for (int a = 0; a < p.dim; ++a)
                    offset[a] += sign * 0.25 * factor * e.vector[k][a];
                if (p.hasX())
                    p.X[k][c] = centreX[k] + sign * quarter[k];
            }
        for (int a = 0; a < p.dim; ++a)
            p.x[a][c] = centre[a] + offset[a];
        const Vector3 after = angularMomentum(p, c);
        for (int a = 0; a < 3; ++a)
            change[a] += after[a];
        energy -= kineticEnergy(p, c);
    }
    s.ledger.splitMergeLoss += energy;
    s.ledger.splitAngularMomentum += std::sqrt(change[0] * change[0] + change[1] * change[1] + change[2] * change[2]);
    s.ledger.splits += 1;
    return (Index(1) << e.cuts) - 1;
}

void splitParticle(state::State& state, const Rule& rule, const std::vector<Barrier>& barriers, Index i,
                   Outcome& outcome)
{
    const Edges edges = deformedEdges(state, rule, std::size_t(i));
    if (edges.cuts == 0)
        return;
    const Index children = Index(1) << edges.cuts;
    if (state.particles.generation[std::size_t(i)] >= rule.maxGeneration ||
        state.particles.size() + children - 1 > rule.maxParticles)
    {
        ++outcome.capped;
        return;
    }
    const double factor = offsetFactor(state.particles, barriers, edges, std::size_t(i));
    if (factor < 0.1)
    {
        ++outcome.putOff;
        return;
    }
    outcome.added += makeChildren(state, i, edges, factor);
    ++outcome.split;
}
} // namespace

Outcome splitParticles(state::State& state, const Rule& rule, const std::vector<Barrier>& barriers,
                       const std::vector<Range>* where)
{
    Outcome outcome;
    const Index before = state.particles.size();
    for (const Index chunk : chunksToSplit(state, rule, where))
        for (Index i = chunk * lanes; i < std::min(before, (chunk + 1) * lanes); ++i)
            splitParticle(state, rule, barriers, i, outcome);
    state.ledger.splitsPutOff = outcome.putOff;
    state.ledger.splitsCapped = outcome.capped;
    if (outcome.added > 0)
        state.particles.padLastChunk();
    return outcome;
}
} // namespace mpm::splitting

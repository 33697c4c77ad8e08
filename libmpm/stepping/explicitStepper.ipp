// Definitions of ExplicitStepper, included by the files that instantiate it.
#pragma once
#include "base/clock.hpp"
#include "base/error.hpp"
#include "stepping/chunkWork.ipp"
#include "stepping/nodeWork.ipp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mpm::stepping
{
template <int dim, class Shape>
ExplicitStepper<dim, Shape>::ExplicitStepper(state::State& state, const Scene& scene)
    : state_(state), scene_(scene), barriers_(wallBarriers(scene, state.grid))
{
    if (state.slabs == 0)
        state.slabs = scene.defaultSlabs;
    if (scene.gravity)
        effects_.push_back(std::make_unique<nodal::Gravity<dim>>(*scene.gravity));
    for (const auto& wall : scene.walls)
        walls_.emplace_back(wall);
    for (const auto& load : scene.loads)
        for (std::size_t k = 0; k < state.patches.size(); ++k)
            if (state.patches[k].name == load.patch)
            {
                tractions_.emplace_back(load);
                tractionPatch_.push_back(k);
            }
    sortByStoredKeys(state);
    cutSlabs();
}

// One step ------------------------------------------------------------------------------------------------------------

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::step(double dt)
{
    time_ = state_.time;
    arrange();
    coverParticles();
    switch (scene_.stressUpdate)
    {
    case StressUpdate::MUSL:
        particleToGrid<true>();
        solveNodes(dt);
        gridToParticle(dt, {.velocity = true, .reproject = true});
        moveSurfaces(dt);
        strainVelocities(dt, true);
        gridToParticle(dt, {.strain = true, .position = true, .gradientLane = 1 + dim});
        break;
    case StressUpdate::USL:
        particleToGrid<true>();
        solveNodes(dt);
        moveSurfaces(dt);
        gridToParticle(dt, {.strain = true, .velocity = true, .position = true, .gradientLane = 1});
        break;
    case StressUpdate::USF:
        particleToGrid<false>();
        strainVelocities(dt, false);
        gridToParticle(dt, {.strain = true, .gradientLane = 1 + dim});
        particleToGrid<true>();
        solveNodes(dt);
        moveSurfaces(dt);
        gridToParticle(dt, {.velocity = true, .position = true});
        break;
    }
    state_.time += dt;
    state_.deltaT = dt;
    ++state_.step;
}

/// Splitting and sorting at their intervals; then slabs are cut anew.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::arrange()
{
    bool changed = false;
    if (scene_.splitting && state_.step % scene_.splitting->interval == 0)
    {
        Clock clock(times_.split);
        changed = splitting::splitParticles(state_, *scene_.splitting, barriers_).added > 0;
    }
    const bool sort = state_.step % scene_.sortInterval == 0;
    if (!sort && !changed)
        return;
    Clock clock(times_.sort);
    if (sort)
        sortByPosition(state_, Shape::nodes);
    cutSlabs();
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::cutSlabs()
{
    const auto& p = state_.particles;
    const std::size_t slabs = std::size_t(state_.slabs);
    slabBegin_.resize(slabs + 1);
    for (std::size_t s = 0; s <= slabs; ++s)
        slabBegin_[s] = std::min(p.size(), Index(s) * p.chunks() / Index(slabs) * lanes);
    slabBegin_[slabs] = p.size();
    grid_.slabs.resize(slabs);
    slabSums_.assign(slabs, {});
    double largest = 0;
    for (Index i = 0; i < p.size(); ++i)
        largest = std::max(largest, p.mass[std::size_t(i)]);
    smallestMass_ = largest * 1e-60; // below it 1/m could overflow; far under any weight that matters
    if constexpr (Shape::hasDomain)
    {
        SlabSums sums;
        for (int a = 0; a < dim; ++a)
            lambda_[a].resize(p.mass.size());
        for (Index first = 0; first < p.size(); first += lanes)
            domainsOfChunk(first, sums);
        report_.cappedDomains = sums.cappedDomains;
    }
}

/// Windows of nodes around the particles of each slab; refuses particles outside the grid's box.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::coverParticles()
{
    const auto& p = state_.particles;
    const auto& box = state_.grid;
    const int slabs = int(grid_.slabs.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (int s = 0; s < slabs; ++s)
    {
        std::array<Index, 3> first{0, 0, 0}, last{0, 0, 0};
        slabSums_[std::size_t(s)] = {};
        for (int a = 0; a < dim; ++a)
        {
            const double* x = p.x[a].data();
            double low = std::numeric_limits<double>::infinity(), high = -low;
            bool inside = true;
            const double boxLow = box.origin[a], boxHigh = box.upper(a);
            for (Index i = slabBegin_[std::size_t(s)]; i < slabBegin_[std::size_t(s) + 1]; ++i)
            {
                low = x[i] < low ? x[i] : low;
                high = x[i] > high ? x[i] : high;
                inside &= (x[i] >= boxLow) & (x[i] <= boxHigh);
            }
            if (!inside)
                slabSums_[std::size_t(s)].badParticle = slabBegin_[std::size_t(s)];
            if (!inside || low > high)
            {
                last[0] = -1;
                break;
            }
            // one node more on each side: rounding here and in the weights may differ
            first[a] = Index(shape::firstNode<Shape::nodes>(low, box.origin[a], 1 / box.h)) - 1;
            last[a] = Index(shape::firstNode<Shape::nodes>(high, box.origin[a], 1 / box.h)) + Shape::nodes;
        }
        grid_.slabs[std::size_t(s)].cover(first, last);
    }
    for (const auto& sums : slabSums_)
        if (sums.badParticle >= 0)
            for (Index i = 0; i < p.size(); ++i)
            {
                Vector3 x{};
                std::string place, range;
                for (int a = 0; a < dim; ++a)
                {
                    x[a] = p.x[a][std::size_t(i)];
                    place += fmt::format("{}{:g}", a ? ", " : "", x[a]);
                    range += fmt::format("{}[{:g}, {:g}]", a ? " x " : "", box.origin[a], box.upper(a));
                }
                if (!box.contains(x))
                    fail(i, fmt::format("lies at ({}), outside the grid {}: enlarge min and max in system/gridDict",
                                        place, range));
            }
    grid_.coverSlabs();
    rowSums_.assign(std::size_t(grid_.common.rows()), {});
}

/// METHOD Eqs. 2, 3, 7 over all chunks.
template <int dim, class Shape>
template <bool forces>
void ExplicitStepper<dim, Shape>::particleToGrid()
{
    Clock clock(times_.toGrid);
    const auto& p = state_.particles;
    const int slabs = int(grid_.slabs.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (int s = 0; s < slabs; ++s)
    {
        auto& window = grid_.slabs[std::size_t(s)];
        window.clear();
        Weights w;
        transfer::ChunkRecords<dim> records;
        alignas(64) double b[3][lanes];
        for (Index first = slabBegin_[std::size_t(s)]; first < slabBegin_[std::size_t(s) + 1]; first += lanes)
        {
            const int count = int(std::min<Index>(lanes, p.size() - first));
            const double* velocity[dim];
            for (int a = 0; a < dim; ++a)
                velocity[a] = p.v[a].data() + first;
            if (forces && scene_.bodyForce)
                scene_.bodyForce->acceleration(p, first, time_, b);
            w.evaluate(p, lambda_, state_.grid, first);
            records.template build<forces>(p, first, velocity, scene_.bodyForce ? b : nullptr);
            transfer::scatterChunk<dim, Shape, forces>(w, records, count, window);
        }
    }
}

/// METHOD Eqs. 5, 6, 8 and the stress update, as far as `half` asks, over all chunks.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::gridToParticle(double dt, const Half& half)
{
    Clock clock(half.strain ? times_.law : times_.toParticles);
    auto& p = state_.particles;
    const int slabs = int(grid_.slabs.size());
#pragma omp parallel for schedule(dynamic, 1)
    for (int s = 0; s < slabs; ++s)
    {
        SlabSums sums;
        auto& window = grid_.slabs[std::size_t(s)];
        if (half.reproject)
            window.clear();
        Weights w;
        transfer::Gathered<dim> g;
        transfer::ChunkRecords<dim> records;
        for (Index first = slabBegin_[std::size_t(s)]; first < slabBegin_[std::size_t(s) + 1]; first += lanes)
        {
            const int count = int(std::min<Index>(lanes, p.size() - first));
            w.evaluate(p, lambda_, state_.grid, first);
            gatherInto(half, w, count, g);
            if (half.velocity)
                advanceVelocity(first, count, dt, g, sums);
            if (half.reproject)
            {
                const double* velocity[dim];
                for (int a = 0; a < dim; ++a)
                    velocity[a] = p.v[a].data() + first;
                records.template build<false>(p, first, velocity, nullptr);
                transfer::scatterChunk<dim, Shape, false>(w, records, count, window);
            }
            if (half.position)
                for (int a = 0; a < dim; ++a)
                    for (int l = 0; l < lanes; ++l)
                        p.x[a][std::size_t(first + l)] += dt * g.value[1 + a][l];
            if (half.strain)
                updateStress(first, count, dt, half.gradientLane, g, sums);
        }
        slabSums_[std::size_t(s)] = sums;
    }
    bookParticles(dt, half);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::moveSurfaces(double dt)
{
    for (const std::size_t k : tractionPatch_)
        nodal::movePatch<dim>(state_.patches[k], state_.grid, grid_.common, smallestMass_, dt);
}

/// Adds the slabs' sums in slab order and stops at the first bad particle.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::bookParticles(double, const Half& half)
{
    SlabSums total;
    for (const auto& s : slabSums_)
    {
        if (s.badParticle >= 0)
            fail(s.badParticle,
                 "is turned inside out or no longer finite (det F <= 0): a smaller deltaT, finer particles "
                 "(splitting) or a stiffer material is needed there");
        total.kinetic += s.kinetic;
        total.plasticWork += s.plasticWork;
        total.apexVolume += s.apexVolume;
        total.bodyForceWork += s.bodyForceWork;
        total.bodyForceEnd += s.bodyForceEnd;
        total.strainWork += s.strainWork;
        total.apexReturns += s.apexReturns;
        total.cappedDomains += s.cappedDomains;
        total.smallestJacobian = std::min(total.smallestJacobian, s.smallestJacobian);
        total.maxYield = std::max(total.maxYield, s.maxYield);
    }
    auto& ledger = state_.ledger;
    if (half.velocity)
    {
        ledger.transferLoss -= total.kinetic - ledger.kineticEnergy;
        ledger.kineticEnergy = total.kinetic;
        ledger.bodyForceWork += total.bodyForceWork;
        ledger.pendingForceWork -= total.bodyForceEnd;
    }
    if (half.strain)
    {
        // Strains see a projected velocity w, the forces worked on v*: half of f_int . (v* - w) dt belongs to the
        // stress at either end of the step. USL takes its strains from v* itself.
        if (scene_.stressUpdate != StressUpdate::USL && (state_.step > 0 || half.position))
            ledger.transferLoss -= 0.5 * (ledger.pendingForceWork + total.strainWork);
        ledger.plasticDissipation += total.plasticWork;
        ledger.apexVolume += total.apexVolume;
        ledger.apexReturns += total.apexReturns;
        report_.smallestJacobian = total.smallestJacobian;
        report_.maxYieldViolation = total.maxYield;
        if (Shape::followsStretch)
            report_.cappedDomains = total.cappedDomains;
    }
}

template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::smallestNodalMassFraction()
{
    coverParticles();
    particleToGrid<false>();
    double fraction = std::numeric_limits<double>::infinity();
    double density = 0;
    for (const auto& material : scene_.materials)
        density = std::max(density, material.density);
    const double full = density * std::pow(state_.grid.h, dim);
    for (Index k = 0; k < grid_.common.n[2]; ++k)
        for (Index j = 0; j < grid_.common.n[1]; ++j)
        {
            const Index rowJ = grid_.common.lo[1] + j, rowK = grid_.common.lo[2] + k;
            grid_.sumRow(rowJ, rowK);
            const auto [begin, end] = grid_.touched(rowJ, rowK);
            const Record* node = grid_.common.row(rowJ, rowK) - grid_.common.lo[0];
            for (Index i = begin; i < end; ++i)
                if (node[i][0] > smallestMass_)
                    fraction = std::min(fraction, node[i][0] / full);
        }
    return fraction;
}

template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::largestSpeed() const
{
    double fastest = 0;
    for (Index i = 0; i < state_.particles.size(); ++i)
    {
        double vv = 0;
        for (int a = 0; a < dim; ++a)
            vv += state_.particles.v[a][std::size_t(i)] * state_.particles.v[a][std::size_t(i)];
        fastest = std::max(fastest, vv);
    }
    return std::sqrt(fastest);
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::fail(Index particle, const std::string& what) const
{
    const auto& p = state_.particles;
    throw StepError(fmt::format("step {} at time {:.9g} s: particle {} {}", state_.step, state_.time,
                                p.id[std::size_t(particle)], what));
}

template <int dim, class Shape>
std::unique_ptr<Stepper> makeExplicitStepper(state::State& state, const Scene& scene)
{
    return std::make_unique<ExplicitStepper<dim, Shape>>(state, scene);
}
} // namespace mpm::stepping

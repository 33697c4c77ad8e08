// Definitions of ExplicitStepper, included by the files that instantiate it.
#pragma once
#include "base/error.hpp"
#include "constitutive/kinematics.hpp"
#include "stepping/explicitStepper.hpp"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mpm::stepping
{
namespace detail
{
/// Adds the wall time of its own life to a counter.
class Clock
{
  public:
    explicit Clock(double& total) : total_(total), start_(std::chrono::steady_clock::now()) {}
    ~Clock() { total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

  private:
    double& total_;
    std::chrono::steady_clock::time_point start_;
};
} // namespace detail

/// sum V sigma : dEps over the lanes of a chunk.
template <int dim>
double workOfStrain(const constitutive::Chunk<dim>& chunk, const double* volume, int count)
{
    double work = 0;
    for (int l = 0; l < count; ++l)
    {
        double density = 0;
        for (int k = 0; k < stressSize<dim>; ++k)
            density += (k < 3 ? 1 : 2) * chunk.stress[k][l] * chunk.dStrain[k][l];
        work += volume[l] * density;
    }
    return work;
}

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
        detail::Clock clock(times_.split);
        changed = splitting::splitParticles(state_, *scene_.splitting, barriers_).added > 0;
    }
    const bool sort = state_.step % scene_.sortInterval == 0;
    if (!sort && !changed)
        return;
    detail::Clock clock(times_.sort);
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
                for (int a = 0; a < dim; ++a)
                    x[a] = p.x[a][std::size_t(i)];
                if (!box.contains(x))
                    fail(i, fmt::format("lies at ({:g}, {:g}, {:g}), outside the grid [{:g}, {:g}] x [{:g}, {:g}] x "
                                        "[{:g}, {:g}]: enlarge min and max in system/gridDict",
                                        x[0], x[1], x[2], box.origin[0], box.upper(0), box.origin[1], box.upper(1),
                                        box.origin[2], box.upper(2)));
            }
    grid_.coverSlabs();
    rowSums_.assign(std::size_t(grid_.common.rows()), {});
}

/// METHOD Eqs. 2, 3, 7 over all chunks.
template <int dim, class Shape>
template <bool forces>
void ExplicitStepper<dim, Shape>::particleToGrid()
{
    detail::Clock clock(times_.toGrid);
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

template <int dim, class Shape>
template <class Body>
void ExplicitStepper<dim, Shape>::forEachRow(Body&& body)
{
    const Index rows = grid_.common.rows();
#pragma omp parallel
    {
        typename nodal::NodeRow<dim>::WallScratch walls;
        std::vector<Record> projected;
#pragma omp for schedule(static)
        for (Index r = 0; r < rows; ++r)
        {
            nodal::NodeRow<dim> row;
            row.j = grid_.common.lo[1] + r % grid_.common.n[1];
            row.k = grid_.common.lo[2] + r / grid_.common.n[1];
            std::tie(row.begin, row.end) = grid_.touched(row.j, row.k);
            row.node = grid_.common.row(row.j, row.k) - grid_.common.lo[0];
            row.smallestMass = smallestMass_;
            row.sums = &rowSums_[std::size_t(r)];
            walls.clear();
            row.walls = &walls;
            row.projected = &projected;
            body(row);
        }
    }
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::applyWalls(nodal::NodeRow<dim>& row) const
{
    for (const auto& wall : walls_)
        wall.push(row);
    for (const auto& wall : walls_)
        wall.rub(row);
}

/// Sums the slabs, then m a = f with body and boundary effects; books their work. Leaves v* and a at the nodes.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::solveNodes(double dt)
{
    detail::Clock clock(times_.nodal);
    forEachRow([&](nodal::NodeRow<dim>& row) { grid_.sumRow(row.j, row.k); });
    for (std::size_t k = 0; k < tractions_.size(); ++k)
        tractions_[k].scatter(state_.patches[tractionPatch_[k]], state_.grid, grid_.common, smallestMass_);
    forEachRow([&](nodal::NodeRow<dim>& row) {
        row.dt = dt;
        row.projected->assign(row.node + row.begin, row.node + row.end);
        nodal::beginRow(row);
        for (const auto& effect : effects_)
            effect->apply(row);
        applyWalls(row);
        for (const auto& effect : effects_)
            effect->book(row);
        nodal::endRow(row, 1 / dt);
        for (Index i = row.begin; i < row.end; ++i)
            for (int a = 0; a < dim; ++a)
                row.sums->forceWork += dt * (*row.projected)[std::size_t(i - row.begin)][1 + dim + a] * row.node[i][1 + a];
    });
    nodal::NodeSums sums;
    for (const auto& row : rowSums_)
        sums += row;
    auto& ledger = state_.ledger;
    ledger.pendingForceWork = sums.forceWork;
    for (const auto& traction : tractions_)
        ledger.pendingForceWork -=
            traction.book(grid_.common, dt, ledger.tractionWork, ledger.tractionImpulse);
    ledger.gravityWork += sums.gravityWork;
    ledger.frictionDissipation += sums.frictionLoss;
    ledger.wallLoss += sums.wallLoss;
    ledger.wallContacts += sums.contacts;
    ledger.transferLoss += sums.kineticAfter - sums.kineticBefore;
    for (int a = 0; a < dim; ++a)
    {
        ledger.gravityImpulse[a] += sums.gravityImpulse[a];
        ledger.wallImpulse[a] += sums.wallImpulse[a];
    }
}

/// Velocities w that strains are taken from, walls applied: the projected v_i (USF), or the second projection
/// sum m_p v_p(new) N_ip / m_i (MUSL). They go to lanes 1 + dim; lanes 1.. keep v* in the second case.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::strainVelocities(double dt, bool secondProjection)
{
    detail::Clock clock(times_.nodal);
    forEachRow([&](nodal::NodeRow<dim>& row) {
        if (!secondProjection)
            grid_.sumRow(row.j, row.k);
        else
        {
            for (Index i = row.begin; i < row.end; ++i)
                for (int a = 0; a < dim; ++a)
                    row.node[i][1 + dim + a] = 0;
            for (const auto& s : grid_.slabs)
                if (s.n[0] > 0 && row.j >= s.lo[1] && row.j < s.lo[1] + s.n[1] && row.k >= s.lo[2] &&
                    row.k < s.lo[2] + s.n[2])
                {
                    const Record* in = s.row(row.j, row.k) - s.lo[0];
                    for (Index i = s.lo[0]; i < s.lo[0] + s.n[0]; ++i)
                        for (int a = 0; a < dim; ++a)
                            row.node[i][1 + dim + a] += in[i][1 + a];
                }
        }
        row.dt = dt;
        for (Index i = row.begin; i < row.end; ++i)
        {
            const double inverse = row.carries(i) ? 1 / row.node[i][0] : 0;
            for (int a = 0; a < dim; ++a)
                row.node[i][1 + dim + a] = inverse * row.node[i][(secondProjection ? 1 + dim : 1) + a];
        }
        nodal::NodeSums unbooked;
        row.sums = &unbooked;
        applyWalls(row);
    });
}

/// METHOD Eqs. 5, 6, 8 and the stress update, as far as `half` asks, over all chunks.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::gridToParticle(double dt, const Half& half)
{
    detail::Clock clock(half.strain ? times_.constitutive : times_.toParticles);
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
void ExplicitStepper<dim, Shape>::gatherInto(const Half& half, const Weights& w, int count,
                                             transfer::Gathered<dim>& g) const
{
    if (half.strain)
        transfer::gatherChunk<dim, Shape, true>(w, count, grid_.common, g);
    else
        transfer::gatherChunk<dim, Shape, false>(w, count, grid_.common, g);
}

/// v_p += dt sum N a (FLIP); with a PIC rate r, v_p <- (1 - alpha) v_p + alpha sum N v*, alpha = 1 - exp(-r dt).
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::advanceVelocity(Index first, int count, double dt, const transfer::Gathered<dim>& g,
                                                  SlabSums& sums)
{
    auto& p = state_.particles;
    alignas(64) double vv[lanes] = {};
    for (int a = 0; a < dim; ++a)
    {
        double* v = p.v[a].data() + first;
        for (int l = 0; l < lanes; ++l)
            v[l] += dt * g.value[1 + dim + a][l];
        if (scene_.picRate > 0)
        {
            const double alpha = -std::expm1(-scene_.picRate * dt);
            for (int l = 0; l < lanes; ++l)
                v[l] += alpha * (g.value[1 + a][l] - v[l]);
        }
        for (int l = 0; l < lanes; ++l)
            vv[l] += v[l] * v[l];
    }
    double kinetic = 0;
    const double* m = p.mass.data() + first;
    for (int l = 0; l < count; ++l)
    {
        kinetic += m[l] * vv[l];
    }
    sums.kinetic += 0.5 * kinetic;
    if (scene_.bodyForce)
    {
        alignas(64) double b[3][lanes];
        scene_.bodyForce->acceleration(p, first, time_, b);
        for (int a = 0; a < dim; ++a)
            for (int l = 0; l < count; ++l)
            {
                const double end = dt * m[l] * b[a][l] * g.value[1 + a][l];
                sums.bodyForceEnd += end;
                sums.bodyForceWork += end - 0.5 * dt * dt * m[l] * b[a][l] * g.value[1 + dim + a][l];
            }
    }
}

/// F, V and stress from the velocity gradient in record lanes `lane`.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::updateStress(Index first, int count, double dt, int lane,
                                               const transfer::Gathered<dim>& g, SlabSums& sums)
{
    auto& p = state_.particles;
    alignas(64) constitutive::TensorLanes<dim> L, F;
    alignas(64) double J[lanes];
    constitutive::Chunk<dim> chunk;
    chunk.count = count;
    for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
            for (int l = 0; l < lanes; ++l)
            {
                L[a * dim + b][l] = g.gradient[b][lane + a][l];
                F[a * dim + b][l] = p.F[a * dim + b][std::size_t(first + l)];
            }
    for (int k = 0; k < stressSize<dim>; ++k)
        for (int l = 0; l < lanes; ++l)
            chunk.stress[k][l] = p.stress[k][std::size_t(first + l)];

    const double* volume0 = p.volume0.data() + first;
    double* volume = p.volume.data() + first;
    constitutive::strainIncrement(L, dt, chunk.dStrain);
    if (scene_.stressUpdate != StressUpdate::USL)
        sums.strainWork += workOfStrain(chunk, volume, count);
    constitutive::advanceDeformation(L, dt, F);
    constitutive::determinant(F, J);
    constitutive::rotateStress(L, dt, chunk.stress);
    callLaws(first, chunk);

    bool good = true;
    double smallest = sums.smallestJacobian;
    for (int l = 0; l < lanes; ++l)
    {
        volume[l] = volume0[l] * J[l];
        good &= (J[l] > 0) & (J[l] < 1e30);
        smallest = J[l] < smallest ? J[l] : smallest;
    }
    if (!good && sums.badParticle < 0)
        for (int l = 0; l < count; ++l)
            if (!(J[l] > 0 && J[l] < 1e30))
            {
                sums.badParticle = first + l;
                break;
            }
    sums.smallestJacobian = smallest;
    for (int k = 0; k < dim * dim; ++k)
        for (int l = 0; l < lanes; ++l)
            p.F[k][std::size_t(first + l)] = F[k][l];
    for (int k = 0; k < stressSize<dim>; ++k)
        for (int l = 0; l < lanes; ++l)
            p.stress[k][std::size_t(first + l)] = chunk.stress[k][l];

    double plastic = 0, apex = 0, yield = sums.maxYield;
    Index returns = 0;
    for (int l = 0; l < count; ++l)
    {
        plastic += volume[l] * chunk.plasticWork[l];
        apex += volume[l] * chunk.apexStrain[l];
        returns += chunk.region[l] == constitutive::Region::apex;
        yield = chunk.yield[l] > yield ? chunk.yield[l] : yield;
    }
    sums.plasticWork += plastic;
    sums.apexVolume += apex;
    sums.apexReturns += returns;
    sums.maxYield = yield;
    if constexpr (Shape::followsStretch)
        domainsOfChunk(first, sums);
}

/// One call for a chunk of one material; in a mixed chunk each law works on a copy and its own lanes are kept.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::callLaws(Index first, constitutive::Chunk<dim>& chunk) const
{
    const std::int32_t* material = state_.particles.material.data() + first;
    std::int32_t low = material[0], high = material[0];
    for (int l = 0; l < lanes; ++l)
    {
        low = std::min(low, material[l]);
        high = std::max(high, material[l]);
    }
    if (low == high)
    {
        scene_.materials[std::size_t(low)].law->update(chunk);
        return;
    }
    const constitutive::Chunk<dim> before = chunk;
    for (std::int32_t m = low; m <= high; ++m)
    {
        bool present = false;
        for (int l = 0; l < lanes; ++l)
            present = present || material[l] == m;
        if (!present)
            continue;
        constitutive::Chunk<dim> own = before;
        scene_.materials[std::size_t(m)].law->update(own);
        for (int l = 0; l < lanes; ++l)
            if (material[l] == m)
            {
                for (int k = 0; k < stressSize<dim>; ++k)
                    chunk.stress[k][l] = own.stress[k][l];
                chunk.plasticWork[l] = own.plasticWork[l];
                chunk.apexStrain[l] = own.apexStrain[l];
                chunk.yield[l] = own.yield[l];
                chunk.region[l] = own.region[l];
            }
    }
}

/// Half lengths of the domains over h: initial edges (uGIMP), or following the right stretch (cpGIMP). Domains wider than
/// the shape's support allows are held there and counted.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::domainsOfChunk(Index first, SlabSums& sums)
{
    const auto& p = state_.particles;
    const double scale = 0.5 / state_.grid.h;
    const double widest = Shape::followsStretch ? 1.0 : 0.5;
    const int count = int(std::min<Index>(lanes, p.size() - first));
    alignas(64) double U[dim][lanes];
    if constexpr (Shape::followsStretch)
    {
        alignas(64) constitutive::TensorLanes<dim> F;
        for (int k = 0; k < dim * dim; ++k)
            for (int l = 0; l < lanes; ++l)
                F[k][l] = p.F[k][std::size_t(first + l)];
        constitutive::stretchDiagonal(F, U);
    }
    for (int a = 0; a < dim; ++a)
        for (int l = 0; l < lanes; ++l)
        {
            double half = scale * p.length0[a][std::size_t(first + l)];
            if constexpr (Shape::followsStretch)
                half *= U[a][l];
            const bool wide = half > widest * (1 + 1e-12);
            sums.cappedDomains += wide && l < count;
            lambda_[a][std::size_t(first + l)] = half > widest ? widest : half;
        }
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
            fail(s.badParticle, "is turned inside out or no longer finite (det F <= 0): a smaller deltaT, finer particles "
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
        // Strains see a projected velocity w, the forces worked on v*: half of f_int . (v* - w) dt belongs to the stress
        // at either end of the step. USL takes its strains from v* itself.
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

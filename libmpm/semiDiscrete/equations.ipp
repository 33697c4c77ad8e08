// Definitions of Equations, included by the files that instantiate it.
#pragma once
#include "base/error.hpp"
#include "semiDiscrete/chunkRates.ipp"
#include "state/particleOrder.hpp"

#include <fmt/format.h>
#include <limits>
#include <omp.h>

namespace mpm::semiDiscrete
{
template <int dim, class Shape>
Equations<dim, Shape>::Equations(const state::State& state, Model model)
    : model_(std::move(model)), box_(state.grid), layout_(state.grid), particles_(dim)
{
    if (const auto why = whyNotSmooth(model_); !why.empty())
        throw InputError(why);
    for (const auto& wall : model_.walls)
        wallPlanes_[std::size_t(wall.axis)].push_back(std::int32_t(wall.plane));
    for (const auto& material : model_.materials)
    {
        const auto& law = *material.law;
        const double K = law.bulkModulus(), G = law.shearModulus();
        moduli_.push_back({law.hyperelastic(), K - 2.0 / 3 * G, 2 * G, 0.5 / K, 0.25 / G});
        (law.hyperelastic() ? hasHyperelastic_ : hasStress_) = true;
    }
    arrange(state);
}

template <int dim, class Shape>
void Equations<dim, Shape>::arrange(const state::State& state)
{
    particles_ = state.particles;
    box_ = state.grid;
    count_ = particles_.size();
    slot_.clear();
    strayed_ = false;
    const double largest = count_ > 0 ? *std::max_element(particles_.mass.begin(), particles_.mass.end()) : 0;
    smallestMass_ = largest * 1e-60;
    buildTiles();
}

template <int dim, class Shape>
void Equations<dim, Shape>::buildTiles()
{
    grid_.build(particles_, layout_, Shape::nodes - Narrow::nodes, Shape::nodes - 1);
    workspaces_.resize(std::size_t(std::max(1, omp_get_max_threads())));
}

/// Sorts by the positions in y: tiles then belong to y, whatever came before.
template <int dim, class Shape>
void Equations<dim, Shape>::sortAnew(const double* y)
{
    if (slot_.empty())
    {
        slot_.resize(std::size_t(count_));
        for (Index i = 0; i < count_; ++i)
            slot_[std::size_t(i)] = i;
    }
    for (Index i = 0; i < count_; ++i)
    {
        std::array<Index, 3> base{};
        for (int a = 0; a < dim; ++a)
        {
            const double s = (inBox(a, y[(ofX + a) * count_ + slot_[std::size_t(i)]]) - box_.origin[a]) / box_.h;
            const bool inside = s > -1 && s < double(box_.cells[a] + 1); // others are refused by the pass that follows
            base[a] = inside ? Index(std::floor(s - 0.5 * (Narrow::nodes - 2))) : 0;
        }
        particles_.sortKey[std::size_t(i)] = layout_.key(base);
    }
    const auto order = state::orderByKeyAndId(particles_);
    if (!order.empty())
    {
        particles_.permute(order);
        std::vector<Index> slots(slot_.size());
        for (std::size_t i = 0; i < slots.size(); ++i)
            slots[i] = slot_[std::size_t(order[i])];
        slot_ = std::move(slots);
    }
    particles_.padLastChunk();
    buildTiles();
    strayed_ = true;
}

// y and the state
// ------------------------------------------------------------------------------------------------------

template <int dim, class Shape>
void Equations<dim, Shape>::pack(const state::State& state, std::vector<double>& y) const
{
    const auto& p = state.particles;
    y.resize(size());
    const auto copy = [&](const auto& column, int to) {
        double* out = y.data() + std::size_t(to) * std::size_t(count_);
#pragma omp parallel for schedule(static)
        for (Index i = 0; i < count_; ++i)
            out[i] = column[std::size_t(i)];
    };
    for (int a = 0; a < dim; ++a)
    {
        copy(p.x[a], ofX + a);
        copy(p.v[a], ofV + a);
    }
    for (int k = 0; k < dim * dim; ++k)
        copy(p.F[k], ofF + k);
    for (int k = 0; k < stressSize<dim> && hasStress_; ++k)
        copy(p.stress[k], ofStress + k);
}

template <int dim, class Shape>
Summary Equations<dim, Shape>::unpack(const double* y, state::State& state) const
{
    auto& p = state.particles;
    const Index chunks = p.chunks();
    std::vector<Summary> sums(std::size_t(chunks), Summary{});
    std::vector<Index> bad(std::size_t(chunks), Index(-1));
#pragma omp parallel for schedule(static)
    for (Index c = 0; c < chunks; ++c)
    {
        const Index first = c * lanes;
        unpackChunk(y, p, first, int(std::min<Index>(lanes, count_ - first)), sums[std::size_t(c)],
                    bad[std::size_t(c)]);
    }
    Summary total;
    for (Index c = 0; c < chunks; ++c)
    {
        if (bad[std::size_t(c)] >= 0)
            failBad(p, bad[std::size_t(c)]);
        const Summary& s = sums[std::size_t(c)];
        total.kineticEnergy += s.kineticEnergy;
        total.strainEnergy += s.strainEnergy;
        for (int a = 0; a < dim; ++a)
            total.momentum[std::size_t(a)] += s.momentum[std::size_t(a)];
        total.largestSpeed = std::max(total.largestSpeed, s.largestSpeed);
        total.smallestJacobian = std::min(total.smallestJacobian, s.smallestJacobian);
        total.largestJacobian = std::max(total.largestJacobian, s.largestJacobian);
        total.cappedDomains += s.cappedDomains;
    }
    p.padLastChunk();
    return total;
}

// The right-hand side
// --------------------------------------------------------------------------------------------------

template <int dim, class Shape>
void Equations<dim, Shape>::rates(double t, const double* y, double* rate, Powers* powers)
{
    ++evaluations_;
    project(t, y);
    if (powers)
        *powers = {};
    solveNodes(powers);
    gather(t, y, rate, powers);
}

/// body(workspace, tile, sums) for all tiles; each has sums of its own.
template <int dim, class Shape>
template <class Body>
void Equations<dim, Shape>::forEachTile(Body&& body)
{
    const auto& tiles = grid_.tiles();
    const int count = int(tiles.size());
    sums_.assign(tiles.size(), {});
#pragma omp parallel
    {
        auto& ws = workspaces_[std::size_t(omp_get_thread_num())];
        if (!ws)
            ws = std::make_unique<Workspace>();
#pragma omp for schedule(dynamic, 1)
        for (int n = 0; n < count; ++n)
            body(*ws, tiles[std::size_t(n)], sums_[std::size_t(n)]);
    }
}

template <int dim, class Shape>
void Equations<dim, Shape>::project(double t, const double* y)
{
    for (int attempt = 0; attempt < 2; ++attempt)
    {
        forEachTile([&](Workspace& ws, const state::Tile& tile, Sums& sums) { projectTile(ws, tile, t, y, sums); });
        bool stray = false;
        for (const auto& s : sums_)
        {
            if (s.bad >= 0)
                failBad(particles_, s.bad);
            stray = stray || s.stray;
        }
        if (!stray)
            return;
        if (attempt == 0)
            sortAnew(y);
        else
            failOutside();
    }
}

/// (m, p, f) -> (m, v_i, a_i) for one row of nodes.
template <int dim, class Shape>
void Equations<dim, Shape>::solveRow(const state::Block& block, Index j, Index k, Sums& sums)
{
    const auto& box = block.box;
    Record* node = grid_.nodes(block) + box.offset(box.lo[0], j, k);
    Powers& powers = sums.powers;
    for (Index n = 0; n < box.n[0]; ++n)
    {
        const Index at[3] = {box.lo[0] + n, j, k};
        Record& r = node[n];
        const double mass = r[0];
        const bool carries = mass > smallestMass_;
        const double inverse = carries ? 1 / mass : 0;
        double v[dim], a[dim];
        bool held[dim] = {};
        for (const auto& wall : model_.walls)
        {
            const Index i = at[wall.axis];
            if (wall.side < 0 ? i <= wall.plane : i >= wall.plane)
                for (int b = 0; b < dim; ++b)
                    held[b] = held[b] || b == wall.axis || wall.type == nodal::WallType::fixed;
        }
        for (int b = 0; b < dim; ++b)
        {
            const double g = model_.gravity ? (*model_.gravity)[std::size_t(b)] : 0;
            const double drag = model_.relaxationTime ? 1 / *model_.relaxationTime : 0;
            v[b] = held[b] ? 0 : inverse * r[1 + b];
            const double free = carries ? inverse * r[1 + dim + b] + g : 0;
            a[b] = held[b] ? 0 : free - drag * v[b];
            const double m = carries ? mass : 0;
            powers.gravity += m * g * v[b];
            powers.damping += m * drag * v[b] * v[b];
            powers.gravityForce[std::size_t(b)] += m * g;
            powers.dampingForce[std::size_t(b)] -= m * drag * v[b];
            powers.wallForce[std::size_t(b)] -= held[b] ? m * free : 0;
        }
        if (carries)
            powers.lightestNode = powers.lightestNode > 0 ? std::min(powers.lightestNode, mass) : mass;
        for (int b = 0; b < dim; ++b)
        {
            r[1 + b] = v[b];
            r[1 + dim + b] = a[b];
        }
    }
}

template <int dim, class Shape>
void Equations<dim, Shape>::solveNodes(Powers* powers)
{
    const auto& blocks = grid_.blocks();
    const int count = int(blocks.size());
    sums_.assign(blocks.size(), {});
#pragma omp parallel for schedule(dynamic, 1)
    for (int b = 0; b < count; ++b)
    {
        const state::Block& block = blocks[std::size_t(b)];
        const auto& box = block.box;
        for (Index k = box.lo[2]; k < box.lo[2] + box.n[2]; ++k)
            for (Index j = box.lo[1]; j < box.lo[1] + box.n[1]; ++j)
            {
                Record sum[1 << state::TileLayout::bitsOf(dim)] = {};
                grid_.template forEachWindow<Record>(block, j, k, [&](Index begin, Index end, const Record* in) {
                    Record* out = sum + (begin - box.lo[0]);
                    for (Index i = 0; i < end - begin; ++i)
                        out[i] += in[i];
                });
                Record* node = grid_.nodes(block) + box.offset(box.lo[0], j, k);
                for (Index i = 0; i < box.n[0]; ++i)
                    node[i] = transfer::finishNode<dim>(sum[i]);
                solveRow(block, j, k, sums_[std::size_t(b)]);
            }
    }
    if (!powers)
        return;
    for (const auto& s : sums_)
    {
        powers->gravity += s.powers.gravity;
        powers->damping += s.powers.damping;
        for (std::size_t a = 0; a < dim; ++a)
        {
            powers->gravityForce[a] += s.powers.gravityForce[a];
            powers->wallForce[a] += s.powers.wallForce[a];
            powers->dampingForce[a] += s.powers.dampingForce[a];
        }
        if (s.powers.lightestNode > 0)
            powers->lightestNode = powers->lightestNode > 0 ? std::min(powers->lightestNode, s.powers.lightestNode)
                                                            : s.powers.lightestNode;
    }
}

template <int dim, class Shape>
void Equations<dim, Shape>::gather(double t, const double* y, double* rate, Powers* powers)
{
    forEachTile([&](Workspace& ws, const state::Tile& tile, Sums& sums) {
        gatherTile(ws, tile, t, y, rate, powers ? &sums.powers : nullptr);
    });
    if (!powers)
        return;
    for (const auto& s : sums_)
    {
        powers->bodyForce += s.powers.bodyForce;
        powers->stress += s.powers.stress;
        powers->finiteStrain += s.powers.finiteStrain;
    }
}

// Errors
// ---------------------------------------------------------------------------------------------------------------

template <int dim, class Shape>
void Equations<dim, Shape>::failBad(const state::Particles& p, Index particle) const
{
    throw StepError(fmt::format("particle {} is turned inside out or no longer finite (det F <= 0): a smaller deltaT, "
                                "finer particles or a stiffer material is needed there",
                                p.id[std::size_t(particle)]));
}

template <int dim, class Shape>
void Equations<dim, Shape>::failOutside() const
{
    std::string range;
    for (int a = 0; a < dim; ++a)
        range += fmt::format("{}[{:g}, {:g}]", a ? " x " : "", box_.origin[a], box_.upper(a));
    for (Index i = 0; i < count_; ++i)
        for (int a = 0; a < dim; ++a)
            if (const double x = particles_.x[a][std::size_t(i)]; !(x >= box_.origin[a] && x <= box_.upper(a)))
                throw OutsideGrid(
                    fmt::format("particle {} lies at {} = {:g}, outside the grid {}: a smaller deltaT, or "
                                "a larger box in system/gridDict, is needed",
                                particles_.id[std::size_t(i)], axisNames[std::size_t(a)], x, range));
    throw StepError("a particle just sorted lies outside the nodes its key stands for"); // would be our own mistake
}

template <int dim, class Shape>
std::unique_ptr<SemiDiscrete> makeSemiDiscrete(const state::State& state, Model model)
{
    return std::make_unique<Equations<dim, Shape>>(state, std::move(model));
}
} // namespace mpm::semiDiscrete

#include "benchmark/column.hpp"

#include "case/makeStepper.hpp"
#include "constitutive/linearElastic.hpp"
#include "constitutive/mohrCoulomb.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/timeStep.hpp"

#include <cmath>

namespace mpm::benchmark
{
namespace
{
constexpr double width = 4, height = 8, density = 1000, gravity = 9.8;
constexpr constitutive::ElasticModuli moduli{20e6, 0.42};
constexpr double caseCourant = 0.847; ///< c_p dt/h of the case: 226 m/s x 1 ms/(4/15 m)

Index power(Index base, int exponent)
{
    Index result = 1;
    for (int i = 0; i < exponent; ++i)
        result *= base;
    return result;
}

/// Whole cells that cover [-12, 16] x [0, 12] m, the case's box; z like x.
state::GridBox columnGrid(int dim, double h)
{
    const auto cells = [h](double length) { return Index(std::ceil(length / h - 1e-9)); };
    state::GridBox grid;
    grid.dim = dim;
    grid.h = h;
    grid.origin = {-h * double(cells(12)), 0, dim == 3 ? -h * double(cells(12)) : 0};
    grid.cells = {cells(12) + cells(16), cells(12), dim == 3 ? cells(12) + cells(16) : 1};
    return grid;
}

/// Largest common factor of the children's offsets that keeps their centres above the base.
double offsetFactor(double heightAboveBase, double reach)
{
    return reach > 0.9 * heightAboveBase ? 0.9 * heightAboveBase / reach : 1.0;
}

/// Children of particle i of `from`, written to `to` from index `first` on.
void makeChildren(const state::Particles& from, std::size_t i, state::Particles& to, std::size_t first, double base)
{
    const int dim = from.dim, children = 1 << dim;
    double edge[3][3] = {}, reach = 0;
    for (int k = 0; k < dim; ++k)
    {
        for (int a = 0; a < dim; ++a)
            edge[k][a] = 0.25 * from.F[a * dim + k][i] * from.length0[k][i];
        reach += std::abs(edge[k][1]);
    }
    const double factor = offsetFactor(from.x[1][i] - base, reach);
    for (int child = 0; child < children; ++child)
    {
        const std::size_t c = first + std::size_t(child);
        for (int a = 0; a < dim; ++a)
        {
            to.x[a][c] = from.x[a][i];
            for (int k = 0; k < dim; ++k)
                to.x[a][c] += (child >> k & 1 ? factor : -factor) * edge[k][a];
            to.v[a][c] = from.v[a][i];
            to.length0[a][c] = 0.5 * from.length0[a][i];
        }
        for (int k = 0; k < stressComponents(dim); ++k)
            to.stress[k][c] = from.stress[k][i];
        for (int k = 0; k < dim * dim; ++k)
            to.F[k][c] = from.F[k][i];
        to.mass[c] = from.mass[i] / children;
        to.volume0[c] = from.volume0[i] / children;
        to.volume[c] = from.volume[i] / children;
        to.id[c] = std::int64_t(c);
        to.sortKey[c] = std::int64_t(first); // until the first step sorts: the order of the parents
        to.material[c] = from.material[i];
    }
}
} // namespace

Index ColumnSize::particles() const
{
    return 2 * power(across, dim) * power(power(2, dim), refinements);
}

ColumnSize columnSize(int dim, Index wanted, Index widest)
{
    double across = std::pow(0.5 * double(wanted), 1.0 / dim);
    ColumnSize size{dim, 0, 0};
    for (; across > double(widest); across /= 2)
        ++size.refinements;
    size.across = std::max<Index>(2, std::llround(across));
    return size;
}

state::State seedColumn(int dim, Index across)
{
    const double spacing = width / double(across);
    const double K0 = moduli.poisson / (1 - moduli.poisson);
    state::State s(dim);
    s.grid = columnGrid(dim, 2 * spacing);
    s.materials = {"soil"};
    auto& p = s.particles;
    const ColumnSize size{dim, across, 0};
    p.resize(size.particles());
    for (Index i = 0; i < p.size(); ++i)
    {
        const std::size_t n = std::size_t(i);
        const Index at[3] = {i % across, i / across % (2 * across), i / across / (2 * across)};
        for (int a = 0; a < dim; ++a)
        {
            p.x[a][n] = (double(at[a]) + 0.5) * spacing;
            p.length0[a][n] = spacing;
        }
        p.stress[1][n] = -density * gravity * (height - p.x[1][n]);
        p.stress[0][n] = p.stress[2][n] = K0 * p.stress[1][n];
        p.volume0[n] = p.volume[n] = std::pow(spacing, dim);
        p.mass[n] = density * p.volume[n];
        p.id[n] = i;
    }
    p.padLastChunk();
    s.nextId = p.size();
    for (int a = 0; a < dim; ++a)
        s.seedSpacing[a] = spacing;
    return s;
}

stepping::Scene columnScene(const std::string& law, stepping::StressUpdate update)
{
    stepping::Scene scene;
    std::shared_ptr<const constitutive::Law> soil = std::make_shared<constitutive::LinearElastic>(moduli);
    if (law == "mohrCoulomb")
        soil = std::make_shared<constitutive::MohrCoulomb>(constitutive::MohrCoulombParameters{moduli, 1e3, 42, 0});
    scene.materials = {{"soil", density, soil}};
    scene.gravity = Vector3{0, -gravity, 0};
    scene.walls = {{"base", nodal::WallType::friction, 1, -1, 0, 0.6, true}};
    scene.stressUpdate = update;
    return scene;
}

splitting::Rule columnSplitting()
{
    splitting::Rule rule;
    rule.threshold = 2.5;
    rule.interval = 1;
    rule.maxGeneration = 4;
    rule.maxParticles = 100000000;
    return rule;
}

double columnDeltaT(stepping::Stepper& stepper, const state::State& state, const stepping::Scene& scene,
                    bool ignoresMass)
{
    const auto limit = stepping::stabilityLimit(stepper, state, scene, ignoresMass);
    return std::min(caseCourant * state.grid.h / limit.waveSpeed, 0.9 * limit.deltaT);
}

state::State refine(const state::State& coarse)
{
    const auto& from = coarse.particles;
    const int dim = from.dim, children = 1 << dim;
    state::State fine(dim);
    fine.time = coarse.time;
    fine.grid = coarse.grid;
    fine.grid.h = 0.5 * coarse.grid.h;
    fine.materials = coarse.materials;
    for (int a = 0; a < dim; ++a)
    {
        fine.grid.cells[a] = 2 * coarse.grid.cells[a];
        fine.seedSpacing[a] = 0.5 * coarse.seedSpacing[a];
    }
    fine.particles.resize(from.size() * children);
    for (Index i = 0; i < from.size(); ++i)
        makeChildren(from, std::size_t(i), fine.particles, std::size_t(i * children), coarse.grid.origin[1]);
    fine.particles.padLastChunk();
    fine.nextId = fine.particles.size();
    return fine;
}

state::State ColumnCache::collapsed(const ColumnSize& size)
{
    auto [entry, isNew] = coarse_.try_emplace({size.dim, size.across}, seedColumn(size.dim, size.across));
    if (isNew)
    {
        state::State& state = entry->second;
        const auto scene = columnScene("mohrCoulomb", stepping::StressUpdate::MUSL);
        auto stepper = cases::makeStepper("uGIMP", state, scene);
        stepping::beginLedger(state, scene.materials);
        const double longest = columnDeltaT(*stepper, state, scene, true);
        const Index steps = Index(std::ceil(collapseTime / longest));
        for (Index i = 0; i < steps; ++i)
            stepper->step(collapseTime / double(steps));
        state.step = 0; // rows begin with a sort and a ledger of their own
        state.ledger = {};
    }
    state::State state = entry->second;
    for (int r = 0; r < size.refinements; ++r)
        state = refine(state);
    return state;
}

double yieldingShare(const state::State& state, const std::vector<constitutive::Material>& materials)
{
    const auto& p = state.particles;
    constitutive::Chunk<3> chunk = {};
    Index yielding = 0;
    for (Index first = 0; first < p.size(); first += lanes)
    {
        const Index count = std::min<Index>(lanes, p.size() - first);
        for (int k = 0; k < stressComponents(p.dim); ++k)
            for (int l = 0; l < lanes; ++l)
                chunk.stress[k][l] = p.stress[k][std::size_t(first + std::min<Index>(l, count - 1))];
        const auto& law = *materials[std::size_t(p.material[std::size_t(first)])].law;
        if (!law.plastic())
            continue;
        law.update(chunk);
        for (int l = 0; l < count; ++l)
            yielding += chunk.yield[l] > -1e-9;
    }
    return double(yielding) / double(std::max<Index>(1, p.size()));
}
} // namespace mpm::benchmark

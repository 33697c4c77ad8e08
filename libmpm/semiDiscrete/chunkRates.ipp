// The work of Equations on one tile and one chunk: loading, weights, projection, rates, and back into a state.
#pragma once
#include "semiDiscrete/equations.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::semiDiscrete
{
template <int dim, class Shape>
void Equations<dim, Shape>::load(const double* y, int column, Index first, int count, double (&out)[lanes]) const
{
    const double* from = y + Index(column) * count_;
    if (slot_.empty())
        return transfer::loadLanes(from + first, count, out);
    for (int l = 0; l < count; ++l)
        out[l] = from[slot_[std::size_t(first + l)]];
    std::fill(out + count, out + lanes, out[count - 1]);
}

/// Where a position lies in the box: positions in y run on through periodic sides.
template <int dim, class Shape>
double Equations<dim, Shape>::inBox(int axis, double x) const
{
    if (!box_.periodic[std::size_t(axis)])
        return x;
    const double low = box_.origin[std::size_t(axis)], length = box_.upper(axis) - low;
    return x - length * std::floor((x - low) / length);
}

template <int dim, class Shape>
void Equations<dim, Shape>::store(double* y, int column, Index first, int count, const double (&in)[lanes]) const
{
    double* to = y + Index(column) * count_;
    if (slot_.empty())
        std::copy_n(in, count, to + first);
    else
        for (int l = 0; l < count; ++l)
            to[slot_[std::size_t(first + l)]] = in[l];
}

/// Half lengths of the domains over h: initial edges, or following the stretch. Returns how many are held at the widest
/// size the shape allows.
template <int dim, class Shape>
Index Equations<dim, Shape>::domains(const state::Particles& p, Index first, int count,
                                     const constitutive::TensorLanes<dim>& F, Vectors& half) const
{
    Index capped = 0;
    if constexpr (Shape::hasDomain)
    {
        constexpr double widest = Shape::followsStretch ? 1.0 : 0.5;
        const double scale = 0.5 / box_.h;
        alignas(64) Vectors U;
        if constexpr (Shape::followsStretch)
            constitutive::stretchDiagonal(F, U);
        for (int a = 0; a < dim; ++a)
        {
            transfer::loadLanes(p.length0[a].data() + first, count, half[a]);
            for (int l = 0; l < lanes; ++l)
            {
                double size = scale * half[a][l];
                if constexpr (Shape::followsStretch)
                    size *= U[a][l];
                capped += size > widest * (1 + 1e-6) && l < count;
                half[a][l] = size > widest ? widest : size;
            }
        }
    }
    return capped;
}

/// visit(law, mine) for each law of F in a chunk; mine(lane): is the lane of it?
template <int dim, class Shape>
template <class Visit>
void Equations<dim, Shape>::forHyperelastic(const state::Particles& p, Index first, int count, Visit&& visit) const
{
    if (!hasHyperelastic_)
        return;
    const std::int32_t* material = p.material.data() + first;
    const auto [low, high] = std::minmax_element(material, material + count);
    for (std::int32_t m = *low; m <= *high; ++m)
        if (const auto* law = moduli_[std::size_t(m)].hyperelastic)
            if (std::find(material, material + count, m) != material + count)
                visit(*law, [=](int lane) { return material[lane < count ? lane : count - 1] == m; });
}

/// Stress of laws of F; lanes of other materials keep what they have.
template <int dim, class Shape>
void Equations<dim, Shape>::stressOf(const state::Particles& p, Index first, int count,
                                     const constitutive::TensorLanes<dim>& F,
                                     double (&stress)[stressSize<dim>][lanes]) const
{
    forHyperelastic(p, first, count, [&](const constitutive::Hyperelastic& law, auto mine) {
        constitutive::Chunk<dim> chunk;
        chunk.count = count;
        chunk.F = &F;
        law.update(chunk);
        for (int k = 0; k < stressSize<dim>; ++k)
            for (int l = 0; l < lanes; ++l)
                if (mine(l))
                    stress[k][l] = chunk.stress[k][l];
    });
}

/// x, v, F, J, V, stress, domains and masses of one chunk.
template <int dim, class Shape>
void Equations<dim, Shape>::loadChunk(Workspace& ws, Index first, int count, const double* y) const
{
    for (int a = 0; a < dim; ++a)
    {
        load(y, ofX + a, first, count, ws.x[a]);
        if (box_.periodic[std::size_t(a)])
            for (double& x : ws.x[a])
                x = inBox(a, x);
        load(y, ofV + a, first, count, ws.v[a]);
    }
    for (int k = 0; k < dim * dim; ++k)
        load(y, ofF + k, first, count, ws.F[k]);
    for (int k = 0; k < stressSize<dim> && hasStress_; ++k)
        load(y, ofStress + k, first, count, ws.stress[k]);
    constitutive::determinant(ws.F, ws.J);
    transfer::loadLanesOrZero(particles_.mass.data() + first, count, ws.mass);
    transfer::loadLanesOrZero(particles_.volume0.data() + first, count, ws.volume);
    for (int l = 0; l < lanes; ++l)
        ws.volume[l] *= ws.J[l];
    stressOf(particles_, first, count, ws.F, ws.stress);
    domains(particles_, first, count, ws.F, ws.half);
}

/// Weights at ws.x by the shape, or by its narrow form where no domain of the chunk needs more nodes.
template <int dim, class Shape>
template <class Body>
void Equations<dim, Shape>::withWeights(Workspace& ws, Body&& body) const
{
    bool narrow = true;
    if constexpr (Shape::followsStretch)
    {
        for (int a = 0; a < dim; ++a)
            narrow = narrow && transfer::allWithin(ws.half[a], 0, 0.5);
    }
    if (narrow)
    {
        ws.narrow.evaluate(ws.x, ws.half, box_, wallPlanes_);
        body(ws.narrow);
    }
    else if constexpr (Shape::followsStretch)
    {
        ws.wide.evaluate(ws.x, ws.half, box_, wallPlanes_);
        body(ws.wide);
    }
}

template <int dim, class Shape>
void Equations<dim, Shape>::projectTile(Workspace& ws, const state::Tile& tile, double t, const double* y, Sums& sums)
{
    constexpr double none = std::numeric_limits<double>::min(), immense = 1e30;
    grid_.template clearWindow<Record>(tile);
    for (Index first = tile.first; first < tile.first + tile.count; first += lanes)
    {
        const int count = int(std::min<Index>(lanes, tile.first + tile.count - first));
        loadChunk(ws, first, count, y);
        if (!transfer::allWithin(ws.J, none, immense) && sums.bad < 0)
            for (int l = count - 1; l >= 0; --l)
                if (!(ws.J[l] >= none && ws.J[l] <= immense))
                    sums.bad = first + l;
        for (int a = 0; a < dim; ++a)
        {
            if (!transfer::allWithin(ws.x[a], box_.origin[a], box_.upper(a)))
                sums.stray = true;
            std::copy_n(ws.x[a], count, particles_.x[a].data() + first);
        }
        if (sums.stray || sums.bad >= 0)
            continue;
        withWeights(ws, [&](auto& w) {
            if (!w.locate(tile.window))
            {
                sums.stray = true;
                return;
            }
            ws.forces.build(ws.mass, ws.v, ws.volume, ws.stress);
            projectChunk(w, ws.forces, count, grid_.template window<Record>(tile), tile.window, [] {});
            if (model_.bodyForce)
            {
                model_.bodyForce(particles_, first, count, t, ws.b);
                transfer::projectBodyForce<dim>(w, ws.mass, ws.b, count, grid_.template window<Record>(tile),
                                                tile.window);
            }
        });
    }
}

template <int dim, class Shape>
void Equations<dim, Shape>::gatherTile(Workspace& ws, const state::Tile& tile, double t, const double* y, double* rate,
                                       Powers* powers)
{
    using Values = transfer::ValueNode<dim>;
    using Gradients = transfer::GradientNode<dim, 1>;
    if (ws.values.size() < std::size_t(grid_.largestWindow()))
    {
        ws.values.resize(std::size_t(grid_.largestWindow()));
        ws.gradients.resize(std::size_t(grid_.largestWindow()));
    }
    grid_.copyToWindow(tile, ws.values.data(), [](const Record& r) { return Values::pack(r); });
    grid_.copyToWindow(tile, ws.gradients.data(), [](const Record& r) { return Gradients::pack(r); });
    for (Index first = tile.first; first < tile.first + tile.count; first += lanes)
    {
        const int count = int(std::min<Index>(lanes, tile.first + tile.count - first));
        loadChunk(ws, first, count, y);
        withWeights(ws, [&](auto& w) {
            w.locate(tile.window);
            gatherValues(w, ws.values.data(), tile.window, ws.value, [] {});
            gatherGradient(w, ws.gradients.data(), tile.window, ws.L, [] {});
        });
        for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
                for (int l = 0; l < lanes; ++l)
                {
                    double sum = 0;
                    for (int k = 0; k < dim; ++k)
                        sum += ws.L[i * dim + k][l] * ws.F[k * dim + j][l];
                    ws.FRate[i * dim + j][l] = sum;
                }
        stressRates(ws, first, count, powers);
        for (int a = 0; a < dim; ++a)
        {
            store(rate, ofX + a, first, count, ws.value.v[a]);
            store(rate, ofV + a, first, count, ws.value.a[a]);
        }
        for (int k = 0; k < dim * dim; ++k)
            store(rate, ofF + k, first, count, ws.FRate[k]);
        for (int k = 0; k < stressSize<dim> && hasStress_; ++k)
            store(rate, ofStress + k, first, count, ws.stressRate[k]);
        if (powers && model_.bodyForce)
        {
            model_.bodyForce(particles_, first, count, t, ws.b);
            for (int a = 0; a < dim; ++a)
                for (int l = 0; l < count; ++l)
                    powers->bodyForce += ws.mass[l] * ws.b[a][l] * ws.value.v[a][l];
        }
    }
}

/// C : D + W sigma - sigma W of rate laws, zero for laws of F; powers of stress.
template <int dim, class Shape>
void Equations<dim, Shape>::stressRates(Workspace& ws, Index first, int count, Powers* powers) const
{
    constexpr int nc = stressSize<dim>;
    const std::int32_t* material = particles_.material.data() + first;
    for (int l = 0; l < lanes; ++l)
    {
        const Modulus& modulus = moduli_[std::size_t(material[l < count ? l : count - 1])];
        // full 3 x 3 tensors, plane strain with a zero row and column in D and W
        double L[3][3] = {}, s[3][3] = {}, sigma[6] = {}, out[6];
        for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
                L[i][j] = ws.L[i * dim + j][l];
        for (int k = 0; k < nc; ++k)
            sigma[k] = ws.stress[k][l];
        constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
        for (int k = 0; k < 6; ++k)
            s[row[k]][column[k]] = s[column[k]][row[k]] = sigma[k];
        const double trace = L[0][0] + L[1][1] + L[2][2];
        double power = 0;
        for (int k = 0; k < 6; ++k)
        {
            const int i = row[k], j = column[k];
            const double D = 0.5 * (L[i][j] + L[j][i]);
            power += (k < 3 ? 1 : 2) * sigma[k] * D;
            out[k] = modulus.twoG * D + (k < 3 ? modulus.lame * trace : 0);
            for (int n = 0; n < 3; ++n) // W sigma - sigma W = W sigma + (W sigma)^T
                out[k] += 0.5 * ((L[i][n] - L[n][i]) * s[n][j] + (L[j][n] - L[n][j]) * s[n][i]);
        }
        for (int k = 0; k < nc; ++k)
            ws.stressRate[k][l] = modulus.hyperelastic ? 0 : out[k];
        if (powers && l < count)
        {
            powers->stress += ws.volume[l] * power;
            if (!modulus.hyperelastic)
                powers->finiteStrain += ws.volume[l] * trace * energyDensity(modulus, sigma);
        }
    }
}

/// 1/2 sigma : C^-1 : sigma.
template <int dim, class Shape>
double Equations<dim, Shape>::energyDensity(const Modulus& modulus, const double (&sigma)[6])
{
    const double p = (sigma[0] + sigma[1] + sigma[2]) * (1.0 / 3);
    double ss = 0;
    for (int k = 0; k < 6; ++k)
        ss += k < 3 ? (sigma[k] - p) * (sigma[k] - p) : 2 * sigma[k] * sigma[k];
    return p * p * modulus.halfOverBulk + ss * modulus.quarterOverShear;
}

template <int dim, class Shape>
void Equations<dim, Shape>::unpackChunk(const double* y, state::Particles& p, Index first, int count, Summary& sums,
                                        Index& bad) const
{
    constexpr int nc = stressSize<dim>;
    alignas(64) Vectors half;
    alignas(64) double column[lanes], vv[lanes] = {}, J[lanes], stress[nc][lanes] = {};
    alignas(64) constitutive::TensorLanes<dim> F;
    const auto read = [&](int from, double(&out)[lanes]) {
        transfer::loadLanes(y + Index(from) * count_ + first, count, out);
    };
    for (int a = 0; a < dim; ++a)
    {
        read(ofX + a, column);
        transfer::storeLanes(p.x[a].data() + first, count, column);
        read(ofV + a, column);
        transfer::storeLanes(p.v[a].data() + first, count, column);
        for (int l = 0; l < count; ++l)
        {
            vv[l] += column[l] * column[l];
            sums.momentum[std::size_t(a)] += p.mass[std::size_t(first + l)] * column[l];
        }
    }
    for (int k = 0; k < dim * dim; ++k)
    {
        read(ofF + k, F[k]);
        transfer::storeLanes(p.F[k].data() + first, count, F[k]);
    }
    constitutive::determinant(F, J);
    for (int k = 0; k < nc && hasStress_; ++k)
        read(ofStress + k, stress[k]);
    stressOf(p, first, count, F, stress);
    for (int k = 0; k < nc; ++k)
        transfer::storeLanes(p.stress[k].data() + first, count, stress[k]);
    sums.cappedDomains = domains(p, first, count, F, half);
    alignas(64) double stored[lanes], stiffness[lanes]; // of laws of F: W(F), wave speed squared over that at rest
    std::copy_n(J, lanes, stiffness);
    forHyperelastic(p, first, count, [&](const constitutive::Hyperelastic& law, auto mine) {
        alignas(64) double energy[lanes], factor[lanes];
        law.strainEnergy(F, energy);
        law.waveFactor(F, factor);
        for (int l = 0; l < lanes; ++l)
            if (mine(l))
            {
                stored[l] = energy[l];
                stiffness[l] = factor[l];
            }
    });
    for (int l = 0; l < count; ++l)
    {
        const std::size_t i = std::size_t(first + l);
        if (!(J[l] > 0 && J[l] < 1e30) || !std::isfinite(vv[l]))
            bad = bad < 0 ? first + l : bad;
        p.volume[i] = p.volume0[i] * J[l];
        sums.kineticEnergy += 0.5 * p.mass[i] * vv[l];
        sums.largestSpeed = std::max(sums.largestSpeed, std::sqrt(vv[l]));
        double sigma[6] = {};
        for (int k = 0; k < nc; ++k)
            sigma[k] = stress[k][l];
        const Modulus& modulus = moduli_[std::size_t(p.material[i])];
        sums.strainEnergy +=
            modulus.hyperelastic ? p.volume0[i] * stored[l] : p.volume[i] * energyDensity(modulus, sigma);
        sums.smallestJacobian = std::min(sums.smallestJacobian, J[l]);
        sums.largestJacobian = std::max(sums.largestJacobian, stiffness[l]);
    }
}
} // namespace mpm::semiDiscrete

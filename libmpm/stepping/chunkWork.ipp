// The work of ExplicitStepper on one chunk of particles: velocity, strain, stress, domains.
#pragma once
#include "constitutive/kinematics.hpp"
#include "stepping/explicitStepper.hpp"

#include <cmath>

namespace mpm::stepping
{
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

/// Half lengths of the domains over h: initial edges (uGIMP), or following the right stretch (cpGIMP). Domains wider
/// than the shape's support allows are held there and counted.
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
} // namespace mpm::stepping

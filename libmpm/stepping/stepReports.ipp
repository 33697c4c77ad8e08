// What ExplicitStepper tells of itself: the lightest node, speeds, times, and why a step failed.
#pragma once
#include "stepping/explicitStepper.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace mpm::stepping
{
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::smallestNodalMassFraction()
{
    if (!arranged_)
        buildTiles();
    if (!projected_ || stray_)
    {
        project();
        projected_ = true;
    }
    double density = 0;
    for (const auto& material : scene_.materials)
        density = std::max(density, material.density);
    const double full = density * std::pow(state_.grid.h, dim);
    std::vector<double> smallest(grid_.blocks().size(), std::numeric_limits<double>::infinity());
    std::vector<Index> all(grid_.blocks().size());
    std::iota(all.begin(), all.end(), Index(0));
    forEachRow(all, [&](nodal::NodeRow<dim>& row, const state::Block& block) {
        if (firstProjection() == Project::momentum)
            sumNodes<transfer::Momentum>(row, block);
        else
            sumNodes<transfer::Forces>(row, block);
        double& least = smallest[std::size_t(&block - grid_.blocks().data())];
        for (Index i = row.begin; i < row.end; ++i)
            if (row.carries(i))
                least = std::min(least, row.node[i][0] / full);
    });
    return smallest.empty() ? std::numeric_limits<double>::infinity()
                            : *std::min_element(smallest.begin(), smallest.end());
}

/// The passes over particles do several things at once; their wall time is shared out as measured chunk by chunk in
/// every 16th step.
template <int dim, class Shape>
PassTimes ExplicitStepper<dim, Shape>::times() const
{
    PassTimes t = sampled_;
    const double all = t.weights + t.toGrid + t.toParticles + t.law;
    const double scale = all > 0 ? particleSeconds_ / all : 0;
    for (double PassTimes::*part : {&PassTimes::weights, &PassTimes::toGrid, &PassTimes::toParticles, &PassTimes::law})
        t.*part *= scale;
    t.nodal = times_.nodal;
    t.sort = times_.sort;
    t.split = times_.split;
    return t;
}

template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::largestSpeed() const
{
    double fastest = 0;
    for (Index i = 0; i < state_.particles.size(); ++i)
    {
        double vv = 0;
        for (int a = 0; a < dim; ++a)
        {
            const double v = state_.particles.v[a][std::size_t(i)];
            vv += v * v;
        }
        fastest = std::max(fastest, vv);
    }
    return std::max(std::sqrt(fastest), actorSpeed());
}

/// Of the fastest moving wall or body now: soil it meets will be as fast.
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::actorSpeed() const
{
    double fastest = 0;
    for (const auto& body : bodies_)
        fastest = std::max(fastest, body.speedAt(state_.time));
    for (const auto& wall : scene_.walls)
        if (wall.motion)
        {
            const Vector3 v = wall.motion->velocity(state_.time);
            fastest = std::max(fastest, std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
        }
    return fastest;
}

template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::scratchBytesPerParticle() const
{
    double bytes = 0;
    const auto add = [&](const auto& columns) {
        for (const auto& column : columns)
            bytes += column.empty() ? 0 : double(sizeof(column[0]));
    };
    add(domain_);
    add(next_);
    add(gradient_);
    add(correction_);
    return bytes;
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::fail(Index particle, const std::string& what) const
{
    const auto& p = state_.particles;
    throw StepError(fmt::format("step {} at time {:.9g} s: particle {} {}", state_.step, state_.time,
                                p.id[std::size_t(particle)], what));
}

template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::failOutside() const
{
    const auto& p = state_.particles;
    const auto& box = state_.grid;
    for (Index i = 0; i < p.size(); ++i)
    {
        Vector3 x{};
        double vv = 0;
        std::string place, range;
        for (int a = 0; a < dim; ++a)
        {
            x[a] = p.x[a][std::size_t(i)];
            vv += p.v[a][std::size_t(i)] * p.v[a][std::size_t(i)];
            place += fmt::format("{}{:g}", a ? ", " : "", x[a]);
            range += fmt::format("{}[{:g}, {:g}]", a ? " x " : "", box.origin[a], box.upper(a));
        }
        if (!std::isfinite(vv))
            fail(i, "has no finite velocity any more: a smaller deltaT is needed");
        if (!box.contains(x))
            throw OutsideGrid(
                fmt::format("step {} at time {:.9g} s: particle {} lies at ({}), outside the grid {}, and "
                            "moves at {:.3g} m/s: if that is as it should be, enlarge min and max in "
                            "system/gridDict",
                            state_.step, state_.time, p.id[std::size_t(i)], place, range, std::sqrt(vv)));
    }
    throw StepError("a particle just sorted lies outside the nodes its key stands for"); // would be our own mistake
}
} // namespace mpm::stepping

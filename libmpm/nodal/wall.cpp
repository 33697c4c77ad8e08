#include "nodal/wall.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::nodal
{
double wallPosition(const Wall& wall, const state::GridBox& grid, double time)
{
    const auto axis = std::size_t(wall.axis);
    if (!wall.motion)
        return grid.origin[axis] + grid.h * double(wall.plane);
    return wall.position + wall.motion->displacement(time)[axis];
}

Index wallPlane(const Wall& wall, const state::GridBox& grid, double time)
{
    if (!wall.motion)
        return wall.plane;
    const double index = (wallPosition(wall, grid, time) - grid.origin[std::size_t(wall.axis)]) / grid.h;
    return Index(wall.side < 0 ? std::floor(index + 0.5 + 1e-6) : std::ceil(index - 0.5 - 1e-6));
}

template <int dim>
void WallEffect<dim>::place(double time, double dt, const state::GridBox& grid)
{
    if (!wall_.motion)
        return;
    const auto axis = std::size_t(wall_.axis);
    velocity_ = wall_.motion->meanVelocity(time, dt);
    if (!(std::abs(velocity_[axis]) * dt <= (1 + 1e-9) * grid.h))
        throw StepError(fmt::format("at time {:.9g} s the wall '{}' moves {:.3g} m in a step of {:.3g} s, allowed is "
                                    "a cell, {:.3g} m: a smaller deltaT is needed",
                                    time, wall_.name, std::abs(velocity_[axis]) * dt, dt, grid.h));
    plane_ = wallPlane(wall_, grid, time);
}

/// Gives node i the wall's velocity along an axis.
template <int dim>
void WallEffect<dim>::take(NodeRow<dim>& row, Index i, int a) const
{
    Record& r = row.node[i];
    const std::size_t n = std::size_t(i - row.begin);
    const double excess = r[row.trial + a] - velocity_[a], impulse = -r[0] * excess;
    row.walls->pushed[n][a] += excess;
    row.walls->other[n][a] += impulse;
    row.sums->motionWork += impulse * velocity_[a];
    row.sums->wallLoss += impulse * velocity_[a];
    if (actor_ >= 0 && row.actors)
        row.actors[actor_].impulse[std::size_t(a)] += impulse;
    r[row.trial + a] = velocity_[a];
}

template <int dim>
void WallEffect<dim>::push(NodeRow<dim>& row) const
{
    const auto [begin, end] = range(row);
    if (begin == end)
        return;
    row.walls->open(std::size_t(row.end - row.begin));
    for (Index i = begin; i < end; ++i)
    {
        Record& r = row.node[i];
        const double into = wall_.side * (r[row.trial + wall_.axis] - velocity_[wall_.axis]);
        if (!row.carries(i) || (wall_.separation && !(into > 0)))
            continue;
        for (int a = 0; a < dim; ++a)
            if (a == wall_.axis || wall_.type == WallType::fixed)
                take(row, i, a);
    }
}

template <int dim>
void WallEffect<dim>::pushAgain(NodeRow<dim>& row) const
{
    const auto [begin, end] = range(row);
    for (Index i = begin; i < end; ++i)
        if (row.carries(i) &&
            (!wall_.separation || wall_.side * (row.node[i][row.trial + wall_.axis] - velocity_[wall_.axis]) > 0))
            take(row, i, wall_.axis);
}

template <int dim>
void WallEffect<dim>::rub(NodeRow<dim>& row) const
{
    if (wall_.type != WallType::friction || wall_.mu == 0)
        return;
    const auto [begin, end] = range(row);
    for (Index i = begin; i < end; ++i)
    {
        const std::size_t n = std::size_t(i - row.begin);
        const double into = wall_.side * row.walls->pushed[n][wall_.axis];
        if (!(into > 0))
            continue;
        Record& r = row.node[i];
        double square = 0;
        for (int a = 0; a < dim; ++a)
            if (a != wall_.axis)
                square += (r[row.trial + a] - velocity_[a]) * (r[row.trial + a] - velocity_[a]);
        const double keep = square > 0 ? std::max(0.0, 1 - wall_.mu * into / std::sqrt(square)) : 0;
        for (int a = 0; a < dim; ++a)
            if (a != wall_.axis)
            {
                const double slip = r[row.trial + a] - velocity_[a], impulse = r[0] * (keep - 1) * slip;
                row.walls->friction[n][a] += impulse;
                row.sums->motionWork += impulse * velocity_[a];
                row.sums->frictionLoss += impulse * velocity_[a];
                if (actor_ >= 0 && row.actors)
                    row.actors[actor_].impulse[std::size_t(a)] += impulse;
                r[row.trial + a] = keep * slip + velocity_[a];
            }
        row.sums->contacts += 1;
    }
}

template <int dim>
void WallEffect<dim>::follow(NodeRow<dim>& row) const
{
    const bool fixed = wall_.type == WallType::fixed;
    const bool sticks = wall_.type == WallType::friction && wall_.mu > 0;
    const auto [begin, end] = range(row);
    for (Index i = begin; i < end; ++i)
    {
        Record& r = row.node[i];
        const auto with = [&](int a) { return r[row.velocity + a] == velocity_[a]; };
        const bool held = with(wall_.axis);
        bool rests = held;
        for (int a = 0; a < dim; ++a)
            rests = rests && with(a);
        if (held || wall_.side * (r[row.trial + wall_.axis] - velocity_[wall_.axis]) > 0)
            r[row.trial + wall_.axis] = velocity_[wall_.axis];
        for (int a = 0; a < dim; ++a)
            if ((sticks && rests) || (fixed && held && with(a)))
                r[row.trial + a] = velocity_[a];
    }
}

template class WallEffect<2>;
template class WallEffect<3>;
} // namespace mpm::nodal

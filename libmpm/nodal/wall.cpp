#include "nodal/wall.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::nodal
{
template <int dim>
std::pair<Index, Index> WallEffect<dim>::range(const NodeRow<dim>& row) const
{
    const auto behind = [&](Index index) { return wall_.side < 0 ? index <= wall_.plane : index >= wall_.plane; };
    if (wall_.axis > 0)
        return behind(wall_.axis == 1 ? row.j : row.k) ? std::pair(row.begin, row.end) : std::pair(row.end, row.end);
    if (wall_.side < 0)
        return {row.begin, std::clamp(wall_.plane + 1, row.begin, row.end)};
    return {std::clamp(wall_.plane, row.begin, row.end), row.end};
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
        const double into = wall_.side * r[row.trial + wall_.axis];
        if (!row.carries(i) || (wall_.separation && !(into > 0)))
            continue;
        const std::size_t n = std::size_t(i - row.begin);
        for (int a = 0; a < dim; ++a)
            if (a == wall_.axis || wall_.type == WallType::fixed)
            {
                row.walls->pushed[n][a] += r[row.trial + a];
                row.walls->other[n][a] -= r[0] * r[row.trial + a];
                r[row.trial + a] = 0;
            }
    }
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
                square += r[row.trial + a] * r[row.trial + a];
        const double keep = square > 0 ? std::max(0.0, 1 - wall_.mu * into / std::sqrt(square)) : 0;
        for (int a = 0; a < dim; ++a)
            if (a != wall_.axis)
            {
                row.walls->friction[n][a] += r[0] * (keep - 1) * r[row.trial + a];
                r[row.trial + a] *= keep;
            }
        row.sums->contacts += 1;
    }
}

template <int dim>
void WallEffect<dim>::follow(NodeRow<dim>& row) const
{
    const bool sticks = wall_.type == WallType::fixed || (wall_.type == WallType::friction && wall_.mu > 0);
    const auto [begin, end] = range(row);
    for (Index i = begin; i < end; ++i)
    {
        Record& r = row.node[i];
        bool rests = true;
        for (int a = 0; a < dim; ++a)
            rests = rests && r[row.velocity + a] == 0;
        if (r[row.velocity + wall_.axis] == 0 || wall_.side * r[row.trial + wall_.axis] > 0)
            r[row.trial + wall_.axis] = 0;
        for (int a = 0; a < dim && sticks && rests; ++a)
            r[row.trial + a] = 0;
    }
}

template class WallEffect<2>;
template class WallEffect<3>;
} // namespace mpm::nodal

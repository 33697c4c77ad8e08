#include "nodal/absorbingBoundary.hpp"

#include "nodal/vectors.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::nodal
{
template <int dim>
void AbsorbingBoundary<dim>::place(double time, double dt)
{
    if (plane_.incoming)
        drive_ = times(2, plane_.incoming->meanVelocity(time, dt));
}

template <int dim>
void AbsorbingBoundary<dim>::absorb(NodeRow<dim>& row) const
{
    const auto behind = [&](Index index) { return plane_.side < 0 ? index <= plane_.plane : index >= plane_.plane; };
    Index begin = row.begin, end = row.end;
    if (plane_.axis > 0 && !behind(plane_.axis == 1 ? row.j : row.k))
        return;
    if (plane_.axis == 0)
        plane_.side < 0 ? end = std::clamp(plane_.plane + 1, begin, end) : begin = std::clamp(plane_.plane, begin, end);
    if (begin == end)
        return;
    double decay[dim], reduction[dim]; // e - 1, phi - 1
    for (int a = 0; a < dim; ++a)
    {
        const double s = row.dt * (a == plane_.axis ? plane_.normalRate : plane_.shearRate);
        decay[a] = std::expm1(-s);
        reduction[a] = s > 0 ? -std::expm1(-s) / s - 1 : 0;
    }
    row.walls->open(std::size_t(row.end - row.begin));
    if (row.walls->absorbed.empty())
        row.walls->absorbed.assign(std::size_t(row.end - row.begin), {});
    for (Index i = begin; i < end; ++i)
    {
        if (!row.carries(i))
            continue;
        Record& r = row.node[i];
        for (int a = 0; a < dim; ++a)
        {
            if (decay[a] == 0)
                continue;
            const double before = r[row.velocity + a], V = drive_[std::size_t(a)];
            const double change = decay[a] * (before - V) + reduction[a] * (r[row.trial + a] - before);
            const double impulse = r[0] * change;
            row.walls->absorbed[std::size_t(i - row.begin)][std::size_t(a)] += impulse;
            row.sums->motionWork += impulse * V;
            row.sums->absorbed += impulse * V;
            r[row.trial + a] += change;
        }
    }
}

template class AbsorbingBoundary<2>;
template class AbsorbingBoundary<3>;
} // namespace mpm::nodal

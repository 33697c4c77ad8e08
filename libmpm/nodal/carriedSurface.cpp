#include "nodal/carriedSurface.hpp"

#include "base/error.hpp"
#include "nodal/pointWeights.hpp"

#include <fmt/format.h>

namespace mpm::nodal
{
template <int dim>
void SurfaceCarrier<dim>::scatter(const state::GridBox& grid, state::TileGrid& nodes, double smallestMass)
{
    added_.clear();
    for (std::size_t n = 0; n < surface_->forces.size(); ++n)
    {
        const Vector3 &force = surface_->forces[n], &x = surface_->points[n];
        if (force == Vector3{})
            continue;
        const PointWeights<dim> w(x, grid, nodes, body_, smallestMass, Use::load);
        if (!w.found)
            throw StepError(fmt::format("point {} of the surface '{}' at ({:g}, {:g}, {:g}) carries a load where no "
                                        "particle is",
                                        n, surface_->name, x[0], x[1], x[2]));
        for (int c = 0; c < w.count; ++c)
        {
            if (!w.node[c])
                continue;
            Added add{const_cast<Record*>(w.node[c]), {}};
            for (int a = 0; a < dim; ++a)
            {
                add.force[std::size_t(a)] = w.N[c] * force[std::size_t(a)];
                (*add.node)[1 + dim + a] += add.force[std::size_t(a)];
            }
            added_.push_back(add);
        }
    }
}

template <int dim>
std::pair<double, double> SurfaceCarrier<dim>::book(double dt, double& work, Vector3& impulse) const
{
    double start = 0, end = 0;
    surface_->work = 0;
    surface_->impulse = {};
    for (const auto& add : added_)
        for (int a = 0; a < dim; ++a)
        {
            const double force = add.force[std::size_t(a)];
            const double after = dt * force * (*add.node)[1 + a], change = dt * dt * force * (*add.node)[1 + dim + a];
            end += after;
            start += after - change;
            surface_->work += after - 0.5 * change;
            surface_->impulse[std::size_t(a)] += dt * force;
        }
    work += surface_->work;
    for (std::size_t a = 0; a < 3; ++a)
        impulse[a] += surface_->impulse[a];
    return {start, end};
}

template <int dim>
void SurfaceCarrier<dim>::move(const state::GridBox& grid, const state::TileGrid& nodes, double smallestMass, double dt)
{
    for (std::size_t n = 0; n < surface_->points.size(); ++n)
    {
        Vector3 &x = surface_->points[n], &velocity = surface_->velocities[n];
        if (const PointWeights<dim> w(x, grid, nodes, body_, smallestMass, Use::motion); w.found)
        {
            velocity = {};
            for (int c = 0; c < w.count; ++c)
                for (int a = 0; a < dim && w.node[c]; ++a)
                    velocity[std::size_t(a)] += w.N[c] * (*w.node[c])[1 + a];
        }
        for (std::size_t a = 0; a < 3; ++a)
            x[a] += dt * velocity[a];
    }
}

template class SurfaceCarrier<2>;
template class SurfaceCarrier<3>;
} // namespace mpm::nodal

// Normal stresses that forces see and laws do not: their work, and treatment/bulkViscosity.hpp.
#pragma once
#include "stepping/explicitStepper.hpp"

namespace mpm::stepping
{
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::prepareBulkViscosity()
{
    state_.particles.keep(&state::Particles::bulkViscousStress, bulkViscous());
    if (!bulkViscous())
        return;
    const auto& b = *scene_.bulkViscosity;
    const double h = state_.grid.h;
    for (const auto& material : scene_.materials)
        bulkViscosities_.push_back({material.density * h * b.linear * material.waveSpeed(),
                                    material.density * h * h * b.quadratic * b.quadratic});
}

/// tr e of the strain `strain` that the forces of normal stresses work on: the particle's own.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::traceOfForces(Workspace& ws, double dt, const constitutive::StressLanes<dim>& strain,
                                                double (&trace)[lanes]) const
{
    for (int l = 0; l < lanes; ++l)
    {
        trace[l] = 0;
        for (int a = 0; a < dim; ++a)
            trace[l] += strain[a][l];
        if (conjugate()) // `strain` is then the averaged one
            trace[l] -= dt * dim * ws.spread[l];
    }
}

/// sum V q tr e.
template <int dim, class Shape>
double ExplicitStepper<dim, Shape>::viscousWork(const double (&stress)[lanes], const double (&trace)[lanes],
                                                const double (&volume)[lanes]) const
{
    alignas(64) double work[lanes];
    for (int l = 0; l < lanes; ++l)
        work[l] = stress[l] * trace[l];
    return transfer::sumOfProducts(volume, work);
}

/// - q at the end of the step, from ws.J.
template <int dim, class Shape>
void ExplicitStepper<dim, Shape>::renewBulkViscosity(Workspace& ws, Index first, int count, double dt,
                                                     const double (&trace)[lanes])
{
    const std::int32_t* material = state_.particles.material.data() + first;
    for (int l = 0; l < lanes; ++l)
    {
        const auto& [linear, quadratic] = bulkViscosities_[std::size_t(material[l < count ? l : 0])];
        ws.bulkViscous[l] = treatment::bulkViscousStress(linear, quadratic, ws.J[l], trace[l] / dt);
    }
    transfer::storeLanes(state_.particles.bulkViscousStress.data() + first, count, ws.bulkViscous);
}
} // namespace mpm::stepping

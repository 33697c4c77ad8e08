#include "stepping/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::stepping
{
namespace
{
/// Columns of floats round velocities after every step.
constexpr double momentumTolerance = std::is_same_v<state::Stored, double> ? 1e-8 : 1e-3;
constexpr double yieldTolerance = std::is_same_v<state::Stored, double> ? 1e-6 : 1e-3;

double length(const Vector3& v)
{
    return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}
} // namespace

Monitor::Monitor(const state::State& state, const Scene& scene, const MonitorRule& rule)
    : rule_(rule), bodyForces_(scene.bodyForce != nullptr)
{
    const auto& p = state.particles;
    for (Index i = 0; i < p.size(); ++i)
        mass_ += p.mass[std::size_t(i)];
    double density = 0;
    for (const auto& material : scene.materials)
        density = std::max(density, material.density);
    fullNode_ = density * std::pow(state.grid.h, p.dim);
    extremes_.nodalMass = std::numeric_limits<double>::infinity();
}

Finding Monitor::look(const state::State& state, const StepReport& report, const StabilityLimit& limit)
{
    extremes_.jacobian = std::min(extremes_.jacobian, report.smallestJacobian);
    extremes_.courant = std::max(extremes_.courant, (limit.waveSpeed + limit.speed) * state.deltaT / state.grid.h);
    extremes_.limitUse = std::max(extremes_.limitUse, state.deltaT / limit.deltaT);
    extremes_.nodalMass = std::min(extremes_.nodalMass, report.lightestNode / fullNode_);
    extremes_.yieldViolation = std::max(extremes_.yieldViolation, report.maxYieldViolation);
    if (auto finding = energy(state.ledger, report); !finding.text.empty())
        return finding;
    if (report.maxYieldViolation > yieldTolerance)
        return {fmt::format("stress lies {:g} of its size outside the yield surface: the material's parameters are "
                            "beyond what the law can resolve",
                            report.maxYieldViolation)};
    return balance(state, report);
}

Finding Monitor::energy(const state::Ledger& l, const StepReport& report)
{
    const double work = l.gravityWork + l.tractionWork + l.bodyForceWork + l.motionWork + l.finiteStrainWork;
    const double dissipated =
        l.plasticDissipation + l.frictionDissipation + l.dampingDissipation + l.absorbedEnergy + l.splitMergeLoss;
    const double start = l.initialKineticEnergy + l.initialStrainEnergy;
    const double used = l.kineticEnergy + report.strainEnergy + dissipated;
    const double nowhere = used - start - work;
    const double known = start + std::abs(l.gravityWork) + std::abs(l.tractionWork) + std::abs(l.bodyForceWork) +
                         l.motionSupply + std::abs(dissipated) + std::max(0.0, l.transferLoss + l.wallLoss);
    if (!std::isfinite(nowhere))
        return {"energy is no longer a finite number: a smaller deltaT is needed", true};
    if (known > 0)
        extremes_.energyFromNowhere = std::max(extremes_.energyFromNowhere, nowhere / known);
    if (!(nowhere > rule_.energyTolerance * known))
        return {};
    return {fmt::format("{:.3g} J have come from nowhere, {:.0f} % of the energy that was there or supplied (allowed: "
                        "{:g} %): the step is unstable here; a smaller deltaT, or adjustTimeStep yes, is needed",
                        nowhere, 100 * nowhere / known, 100 * rule_.energyTolerance)};
}

Finding Monitor::balance(const state::State& state, const StepReport& report) const
{
    const auto& l = state.ledger;
    double scale = std::sqrt(2 * mass_ * l.kineticEnergy);
    for (const auto* part :
         {&l.initialMomentum, &l.wallImpulse, &l.gravityImpulse, &l.tractionImpulse, &l.dampingImpulse, &l.restImpulse})
        scale += length(*part);
    Vector3 off{};
    for (std::size_t a = 0; a < 3; ++a)
        off[a] = report.momentum[a] - l.initialMomentum[a] - l.wallImpulse[a] - l.gravityImpulse[a] -
                 l.tractionImpulse[a] - l.dampingImpulse[a] - l.restImpulse[a];
    if (bodyForces_ || length(off) <= momentumTolerance * scale)
        return {};
    return {
        fmt::format("{:.3g} N s of momentum have come from nowhere, {:.1g} of what there is: a mistake of the solver",
                    length(off), length(off) / scale)};
}
} // namespace mpm::stepping

#include "stepping/energyBudget.hpp"

#include "constitutive/particleEnergy.hpp"

#include <algorithm>

namespace mpm::stepping
{
double strainEnergy(const state::State& state, const std::vector<constitutive::Material>& materials, Index first,
                    Index count)
{
    double energy = 0;
    for (Index i = first; i < first + count; ++i)
        energy += constitutive::particleEnergy(state.particles, std::size_t(i),
                                               *materials[std::size_t(state.particles.material[std::size_t(i)])].law);
    return energy;
}

Totals totals(const state::State& state, const std::vector<constitutive::Material>& materials)
{
    const auto& p = state.particles;
    Totals t;
    t.kineticEnergy = state.ledger.kineticEnergy;
    for (Index i = 0; i < p.size(); ++i)
    {
        const std::size_t n = std::size_t(i);
        t.mass += p.mass[n];
        t.volume += p.volume[n];
        t.strainEnergy += constitutive::particleEnergy(p, n, *materials[std::size_t(p.material[n])].law);
        for (int a = 0; a < p.dim; ++a)
        {
            t.momentum[a] += p.mass[n] * p.v[a][n];
            t.extents.low[a] = i == 0 ? p.x[a][n] : std::min(t.extents.low[a], p.x[a][n]);
            t.extents.high[a] = i == 0 ? p.x[a][n] : std::max(t.extents.high[a], p.x[a][n]);
        }
    }
    return t;
}

void beginLedger(state::State& state, const std::vector<constitutive::Material>& materials)
{
    if (state.step > 0)
        return;
    auto& p = state.particles;
    double kinetic = 0;
    for (Index i = 0; i < p.size(); ++i)
        for (int a = 0; a < p.dim; ++a)
            kinetic += 0.5 * p.mass[std::size_t(i)] * p.v[a][std::size_t(i)] * p.v[a][std::size_t(i)];
    const Totals t = totals(state, materials);
    state.ledger.kineticEnergy = state.ledger.initialKineticEnergy = kinetic;
    state.ledger.initialStrainEnergy = t.strainEnergy;
    state.ledger.initialMomentum = t.momentum;
}

double residual(const state::Ledger& l, double strainEnergy)
{
    return l.gravityWork + l.tractionWork + l.bodyForceWork + l.motionWork + l.finiteStrainWork +
           (l.staggering - l.initialStaggering) - (l.kineticEnergy - l.initialKineticEnergy) -
           (strainEnergy - l.initialStrainEnergy) - l.plasticDissipation - l.frictionDissipation -
           l.dampingDissipation - l.absorbedEnergy - l.wallLoss - l.splitMergeLoss - l.transferLoss - l.relaxationLoss -
           l.averagingLoss - l.viscosityLoss - l.bulkViscosityLoss - l.gapWork - l.restLoss - l.contactFriction -
           l.contactLoss;
}

const std::vector<std::string>& historyColumns()
{
    static const std::vector<std::string> columns = {"time",
                                                     "dt",
                                                     "particles",
                                                     "mass",
                                                     "volume",
                                                     "apexVolume",
                                                     "momentumX",
                                                     "momentumY",
                                                     "momentumZ",
                                                     "wallImpulseX",
                                                     "wallImpulseY",
                                                     "wallImpulseZ",
                                                     "kineticEnergy",
                                                     "strainEnergy",
                                                     "plasticDissipation",
                                                     "frictionDissipation",
                                                     "splitMergeLoss",
                                                     "transferLoss",
                                                     "gravityWork",
                                                     "residual",
                                                     "apexReturns",
                                                     "maxYieldViolation",
                                                     "minX",
                                                     "maxX",
                                                     "minY",
                                                     "maxY",
                                                     "minZ",
                                                     "maxZ"};
    return columns;
}

std::vector<double> historyRow(const state::State& s, const Totals& t, const StepReport& report)
{
    const auto& l = s.ledger;
    return {s.time,
            s.deltaT,
            double(s.particles.size()),
            t.mass,
            t.volume,
            l.apexVolume,
            t.momentum[0],
            t.momentum[1],
            t.momentum[2],
            l.wallImpulse[0],
            l.wallImpulse[1],
            l.wallImpulse[2],
            t.kineticEnergy,
            t.strainEnergy,
            l.plasticDissipation,
            l.frictionDissipation,
            l.splitMergeLoss,
            l.transferLoss,
            l.gravityWork,
            residual(l, t.strainEnergy),
            double(l.apexReturns),
            report.maxYieldViolation,
            t.extents.low[0],
            t.extents.high[0],
            t.extents.low[1],
            t.extents.high[1],
            t.extents.low[2],
            t.extents.high[2]};
}

const std::vector<std::string>& budgetColumns()
{
    static const std::vector<std::string> columns = {"time",
                                                     "kineticChange",
                                                     "strainChange",
                                                     "plasticDissipation",
                                                     "frictionDissipation",
                                                     "dampingDissipation",
                                                     "wallLoss",
                                                     "splitMergeLoss",
                                                     "transferLoss",
                                                     "gravityWork",
                                                     "tractionWork",
                                                     "bodyForceWork",
                                                     "finiteStrainWork",
                                                     "staggering",
                                                     "relaxationLoss",
                                                     "averagingLoss",
                                                     "viscosityLoss",
                                                     "gapWork",
                                                     "restLoss",
                                                     "motionWork",
                                                     "contactFriction",
                                                     "contactLoss",
                                                     "bulkViscosityLoss",
                                                     "absorbedEnergy",
                                                     "residual"};
    return columns;
}

std::vector<double> budgetRow(const state::State& s, const Totals& t)
{
    const auto& l = s.ledger;
    return {s.time,
            l.kineticEnergy - l.initialKineticEnergy,
            t.strainEnergy - l.initialStrainEnergy,
            l.plasticDissipation,
            l.frictionDissipation,
            l.dampingDissipation,
            l.wallLoss,
            l.splitMergeLoss,
            l.transferLoss,
            l.gravityWork,
            l.tractionWork,
            l.bodyForceWork,
            l.finiteStrainWork,
            l.staggering - l.initialStaggering,
            l.relaxationLoss,
            l.averagingLoss,
            l.viscosityLoss,
            l.gapWork,
            l.restLoss,
            l.motionWork,
            l.contactFriction,
            l.contactLoss,
            l.bulkViscosityLoss,
            l.absorbedEnergy,
            residual(l, t.strainEnergy)};
}
} // namespace mpm::stepping

#include "smoothing/volumeBudget.hpp"

#include <cmath>

namespace mpm::smoothing
{
double elasticVolume(const state::State& state, const std::vector<constitutive::Material>& materials)
{
    const auto& p = state.particles;
    double initial = 0, sum = 0;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        const auto& law = *materials[std::size_t(p.material[i])].law;
        const double mean = (double(p.stress[0][i]) + double(p.stress[1][i]) + double(p.stress[2][i])) / 3;
        initial += p.volume0[i];
        sum += law.hyperelastic() ? p.volume[i] - p.volume0[i] : p.volume0[i] * std::expm1(mean / law.bulkModulus());
    }
    return sum / initial;
}

VolumeBudget volumeBudget(const state::State& state, const std::vector<constitutive::Material>& materials, double start)
{
    const auto& p = state.particles;
    VolumeBudget out;
    double now = 0;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        out.initial += p.volume0[i];
        now += p.volume[i];
    }
    out.change = (now - out.initial) / out.initial;
    out.elastic = elasticVolume(state, materials) - start;
    out.inelastic = out.change - out.elastic;
    out.dropped = state.ledger.apexVolume / out.initial;
    return out;
}
} // namespace mpm::smoothing

#include "smoothing/filteredNoise.hpp"

#include "smoothing/stressTargets.hpp"

#include <cmath>

namespace mpm::smoothing
{
FilteredNoise filteredNoise(const state::Particles& p, const WeightTable& table, const SmoothedStress& smoothed)
{
    StressColumns widened, filtered, again;
    const double* raw = stressColumns(p, widened)[1];
    stressTarget(StressTarget::filtered, {raw}, p, table, filtered);
    stressTarget(StressTarget::smoothed, {filtered[0].data()}, p, table, again);
    double beyond = 0, bent = 0, size = 0;
    for (std::size_t i = 0; i < filtered[0].size(); ++i)
    {
        const double f = filtered[0][i], smooth = smoothed.smoothed[1][i];
        beyond += (raw[i] - f) * (raw[i] - f);
        bent += (f - again[0][i]) * (f - again[0][i]);
        size += smooth * smooth;
    }
    return {std::sqrt(beyond / size), std::sqrt(bent / size)};
}
} // namespace mpm::smoothing

#include "smoothing/componentNoise.hpp"

#include "smoothing/stressQuality.hpp"

#include <cmath>

namespace mpm::smoothing
{
ComponentNoise componentNoise(const state::Particles& p, const SmoothedStress& smoothed)
{
    const auto n = std::size_t(p.size());
    ComponentNoise noise;
    std::vector<double> meanRaw(n, 0.0), meanSmoothed(n, 0.0), rms;
    for (std::size_t c = 0; c < smoothed.smoothed.size(); ++c)
    {
        const auto& smooth = smoothed.smoothed[c];
        double difference = 0, size = 0;
        for (std::size_t i = 0; i < n; ++i)
        {
            const double raw = p.stress[c][i];
            difference += (raw - smooth[i]) * (raw - smooth[i]);
            size += smooth[i] * smooth[i];
            if (c < 3)
            {
                meanRaw[i] += raw / 3;
                meanSmoothed[i] += smooth[i] / 3;
            }
        }
        rms.push_back(std::sqrt(difference / double(n)));
        noise.own.push_back(std::sqrt(difference / size));
    }
    double square = 0;
    for (const double value : meanSmoothed)
        square += value * value;
    noise.scale = std::sqrt(square / double(n));
    for (const double value : rms)
        noise.ofMean.push_back(value / noise.scale);
    noise.mean = relativeDifference(meanRaw, meanSmoothed);
    return noise;
}
} // namespace mpm::smoothing

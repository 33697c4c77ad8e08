#include "smoothing/stressQuality.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::smoothing
{
namespace
{
double mean(const std::vector<double>& values)
{
    double sum = 0;
    for (double value : values)
        sum += value;
    return values.empty() ? 0 : sum / double(values.size());
}

double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
    const double meanA = mean(a), meanB = mean(b);
    double aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        aa += (a[i] - meanA) * (a[i] - meanA);
        bb += (b[i] - meanB) * (b[i] - meanB);
        ab += (a[i] - meanA) * (b[i] - meanB);
    }
    return ab / std::sqrt(aa * bb);
}
} // namespace

FieldQuality fieldQuality(const std::vector<double>& values, const std::vector<double>& overburden)
{
    if (values.empty())
        return {};
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        squares += (values[i] - overburden[i]) * (values[i] - overburden[i]);
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    return {*min, *max, std::sqrt(squares / double(values.size())), correlation(values, overburden)};
}

double relativeDifference(const std::vector<double>& a, const std::vector<double>& b, const double* weight)
{
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        const double w = weight ? weight[i] : 1;
        difference += w * (a[i] - b[i]) * (a[i] - b[i]);
        size += w * b[i] * b[i];
    }
    return std::sqrt(difference / size);
}

StressQuality stressQuality(const state::State& state, const WeightTable& table, const SmoothedStress& smoothed,
                            const Vector3& gravity, std::vector<double>* overburden)
{
    const auto& p = state.particles;
    StressQuality quality;
    std::vector<double> atParticles(std::size_t(p.size()), std::nan("")),
        atNodes(smoothed.nodePosition.size(), std::nan(""));
    if (Overburden::defined(gravity, p.dim))
    {
        const Overburden above(state, gravity);
        quality.axis = above.axis();
        for (Index i = 0; i < p.size(); ++i)
            atParticles[std::size_t(i)] = above.atParticle(i);
        for (std::size_t n = 0; n < atNodes.size(); ++n)
            atNodes[n] = above.atPoint(smoothed.nodePosition[n]);
    }
    const auto axis = std::size_t(quality.axis);
    const std::vector<double> raw(p.stress[axis].begin(), p.stress[axis].begin() + p.size());
    const auto& smooth = smoothed.smoothed[axis];

    quality.nodal = fieldQuality(smoothed.nodal[axis], atNodes);
    quality.raw = fieldQuality(raw, atParticles);
    quality.smoothed = fieldQuality(smooth, atParticles);
    quality.noise = relativeDifference(raw, smooth);
    quality.noiseByMass = relativeDifference(raw, smooth, p.mass.data());
    quality.noiseFloor = relativeDifference(atParticles, smoothColumns({atParticles.data()}, p, table).smoothed[0]);
    for (std::size_t i = 0; i < smooth.size(); ++i)
        if (std::abs(smooth[i] - atParticles[i]) > std::abs(quality.worstError))
        {
            quality.worstError = smooth[i] - atParticles[i];
            for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
                quality.worstPlace[a] = p.x[a][i];
        }
    if (overburden && Overburden::defined(gravity, p.dim))
        *overburden = std::move(atParticles);
    return quality;
}
} // namespace mpm::smoothing

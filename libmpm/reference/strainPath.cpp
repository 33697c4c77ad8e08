#include "reference/strainPath.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::reference
{
double Harmonic::rate(double t) const
{
    return amplitude * (sine ? std::sin(angularFrequency * t) : std::cos(angularFrequency * t));
}

double Harmonic::integral(double t) const
{
    if (angularFrequency == 0)
        return sine ? 0 : amplitude * t;
    const double half = std::sin(0.5 * angularFrequency * t);
    return amplitude / angularFrequency * (sine ? 2 * half * half : std::sin(angularFrequency * t));
}

StrainPath StrainPath::harmonic(const std::array<Harmonic, 6>& components, double end)
{
    if (!(end > 0))
        throw InputError(fmt::format("end of a strain path: found {}, allowed is > 0", end));
    StrainPath path;
    path.breaks_ = {0, end};
    path.rate_ = [components](std::size_t, double t) {
        SymmetricTensor out;
        for (int k = 0; k < 6; ++k)
            out[k] = components[k].rate(t);
        return out;
    };
    path.increment_ = [components](std::size_t, double from, double to) {
        SymmetricTensor out;
        for (int k = 0; k < 6; ++k)
            out[k] = components[k].integral(to) - components[k].integral(from);
        return out;
    };
    return path;
}

SymmetricTensor turned(const SymmetricTensor& t, double angle)
{
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * c * t[0] - 2 * c * s * t[3] + s * s * t[1],
            s * s * t[0] + 2 * c * s * t[3] + c * c * t[1],
            t[2],
            c * s * (t[0] - t[1]) + (c * c - s * s) * t[3],
            s * t[5] + c * t[4],
            c * t[5] - s * t[4]};
}

StrainPath StrainPath::turning(const std::array<Harmonic, 6>& components, double spin, double end)
{
    StrainPath path = harmonic(components, end);
    path.spin_ = spin;
    path.inAxes_ = [increment = path.increment_](double from, double to) { return increment(0, from, to); };
    if (spin == 0)
        return path;
    double fastest = std::abs(spin);
    for (const auto& component : components)
        fastest = std::max(fastest, std::abs(component.angularFrequency));
    path.rate_ = [rate = path.rate_, spin](std::size_t piece, double t) { return turned(rate(piece, t), spin * t); };
    path.increment_ = [rate = path.rate_, fastest](std::size_t piece, double from, double to) {
        // Gauss' rule of 8 points on parts of at most 0.1 rad: round-off
        static constexpr double at[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
        static constexpr double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                             0.1012285362903763};
        const int parts = int(std::ceil(10 * fastest * (to - from))) + 1;
        SymmetricTensor sum{};
        for (int n = 0; n < parts; ++n)
        {
            const double half = 0.5 * (to - from) / parts, middle = from + (2 * n + 1) * half;
            for (int k = 0; k < 4; ++k)
                for (const double sign : {-1.0, 1.0})
                {
                    const SymmetricTensor e = rate(piece, middle + sign * at[k] * half);
                    for (int c = 0; c < 6; ++c)
                        sum[c] += weight[k] * half * e[c];
                }
        }
        return sum;
    };
    return path;
}

StrainPath StrainPath::table(std::vector<double> times, std::vector<SymmetricTensor> strains)
{
    if (times.size() < 2 || times.size() != strains.size())
        throw InputError(fmt::format("strain path: found {} rows, allowed are at least 2", times.size()));
    std::vector<SymmetricTensor> rates(times.size() - 1);
    for (std::size_t i = 0; i + 1 < times.size(); ++i)
    {
        if (!(times[i + 1] > times[i]))
            throw InputError(
                fmt::format("strain path: found time {} after {}, allowed are growing times", times[i + 1], times[i]));
        for (int k = 0; k < 6; ++k)
            rates[i][k] = (strains[i + 1][k] - strains[i][k]) / (times[i + 1] - times[i]);
    }
    StrainPath path;
    path.breaks_ = std::move(times);
    path.straight_ = true;
    path.rate_ = [rates](std::size_t piece, double) { return rates[piece]; };
    path.increment_ = [rates](std::size_t piece, double from, double to) {
        SymmetricTensor out;
        for (int k = 0; k < 6; ++k)
            out[k] = rates[piece][k] * (to - from);
        return out;
    };
    return path;
}
} // namespace mpm::reference

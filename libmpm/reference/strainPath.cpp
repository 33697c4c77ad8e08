#include "reference/strainPath.hpp"

#include "base/error.hpp"

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

#include "coupling.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace springWall
{
void Coupling::explicitWindow(double window, Row& row)
{
    wall_.advance(window, force_, force_);
    row.wallImpulse += force_ * window;
    const SoilWindow soil = soil_.advance(window, wall_.state().position);
    row.soilImpulse += soil.force * window;
    row.soilWork = soil.work;
    force_ = soil.force;
    row.iterations = 1;
}

void Coupling::implicitWindow(double window, Row& row)
{
    const auto start = wall_.save();
    soil_.save();
    wall_.advance(window, force_, force_); // a first guess
    double x = wall_.state().position, before = 0;
    SoilWindow soil;
    for (row.iterations = 1;; ++row.iterations)
    {
        soil = soil_.advance(window, x);
        wall_.restore(start);
        wall_.advance(window, soil.force, soil.force);
        const double r = wall_.state().position - x;
        row.mismatch = std::abs(r);
        if (row.mismatch <= scheme_.tolerance)
            break;
        if (row.iterations == scheme_.mostIterations)
            throw SoilLost(fmt::format("window from {:g} s: {:g} m apart after {} iterations", start.time, row.mismatch,
                                       row.iterations));
        if (row.iterations > 1 && r != before)
            omega_ = std::clamp(-omega_ * before / (r - before), 1e-3, 1.0);
        before = r;
        x += omega_ * r;
        soil_.restore();
    }
    row.soilImpulse += soil.force * window;
    row.wallImpulse += soil.force * window;
    row.soilWork = soil.work;
    force_ = soil.force;
}

void Coupling::run(double end, const std::function<void(const Row&)>& tell)
{
    Row row{};
    const double begin = soil_.time();
    const auto windows = std::llround((end - begin) / scheme_.window);
    for (long long k = 0; k < windows; ++k)
    {
        if (scheme_.implicitly)
            implicitWindow(scheme_.window, row);
        else
            explicitWindow(scheme_.window, row);
        soil_.accept();
        row.time = soil_.time();
        row.force = force_;
        tell(row);
    }
}
} // namespace springWall

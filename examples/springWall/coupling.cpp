#include "coupling.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

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

namespace
{
/// r falls with x: a wall that goes further is pushed less. Where both signs are known, the next x lies between.
class Bracket
{
  public:
    void learn(double x, double r) { (r > 0 ? low_ : high_) = x; }
    double keep(double next)
    {
        const double width = high_ - low_; // infinite until both ends are known
        const bool slow = std::isfinite(width) && ++tries_ % 3 == 0 && width > 0.5 * before_;
        if (tries_ % 3 == 1)
            before_ = width;
        return slow || next <= low_ || next >= high_ ? 0.5 * (low_ + high_) : next;
    }

  private:
    double low_ = -std::numeric_limits<double>::infinity(), high_ = std::numeric_limits<double>::infinity();
    double before_ = high_;
    int tries_ = 0;
};
} // namespace

void Coupling::implicitWindow(double window, Row& row)
{
    const auto start = wall_.save();
    soil_.save();
    wall_.advance(window, force_, force_); // a first guess
    double x = wall_.state().position, before = 0;
    SoilWindow soil;
    Bracket bracket;
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
            omega_ = std::clamp(-omega_ * before / (r - before), 1e-4, 1.0);
        bracket.learn(x, r);
        const double next = bracket.keep(x + omega_ * r);
        omega_ = (next - x) / r;
        before = r;
        x = next;
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

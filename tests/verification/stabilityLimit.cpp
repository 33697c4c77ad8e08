// The largest stable Courant number c_p dt/h of the step itself: a free elastic bar, two particles per cell, positions
// and domains frozen (the linearised step), spectral radius by power iteration on velocities and stresses. The known
// critical numbers come from an independent 1D calculation (spectral radius of the assembled step matrix): just below
// them the motion must stay bounded, just above it must grow. delta: distance of the first particle from where it sits
// in an aligned cell, in cells.
#include "case/makeStepper.hpp"
#include "stepping/timeStep.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <random>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
constexpr double modulus = 1e6, density = 1000, h = 0.5;

/// Growth of the free motion per step, over the last of many steps.
double growth(const std::string& shape, StressUpdate update, double delta, double courant)
{
    const Index N = 8;
    auto s = scenes::seedBlock({.corner = {2 * h + delta * h, 0, 0},
                                .n = {2 * N, 2, 1},
                                .spacing = h / 2,
                                .h = h,
                                .density = density,
                                .cells = {N + 6, 1, 1}});
    stepping::Scene scene;
    scene.materials = {scenes::elastic(modulus, 0, density)};
    scene.stressUpdate = update;
    using nodal::WallType;
    scene.walls = {{"below", WallType::roller, 1, -1, 0, 0, false}, {"above", WallType::roller, 1, 1, 1, 0, false}};
    scene.sortInterval = 1 << 30;
    auto stepper = cases::makeStepper(shape, s, scene);
    auto& p = s.particles;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1e-9, 1e-9);
    std::vector<double> perRow(std::size_t(2 * N));
    for (double& v : perRow)
        v = any(random);
    const double low = 2 * h + delta * h;
    for (Index i = 0; i < p.size(); ++i)
        p.v[0][std::size_t(i)] = perRow[std::size_t(std::lround((p.x[0][std::size_t(i)] - low) / (h / 2) - 0.5))];
    const auto rest = p;
    const double dt = courant * h / std::sqrt(modulus / density);
    const auto size = [&] {
        double sum = 0;
        for (Index i = 0; i < p.size(); ++i)
            sum += density * p.v[0][std::size_t(i)] * p.v[0][std::size_t(i)] +
                   p.stress[0][std::size_t(i)] * p.stress[0][std::size_t(i)] / modulus;
        return std::sqrt(sum);
    };
    const double start = size();
    double grown = 0;
    const int steps = 1500, counted = 500;
    for (int n = 0; n < steps; ++n)
    {
        stepper->step(dt);
        p.x = rest.x;
        p.F = rest.F;
        p.volume = rest.volume;
        const double now = size();
        for (auto* columns : {&p.v[0], &p.v[1], &p.stress[0], &p.stress[1], &p.stress[2], &p.stress[3]})
            for (double& value : *columns)
                value *= start / now;
        stepper->particlesChanged();
        if (n >= steps - counted)
            grown += std::log(now / start);
    }
    return std::exp(grown / counted);
}
} // namespace

TEST_CASE("critical Courant numbers of the step and the solver's bounds")
{
    struct Row
    {
        std::string shape;
        double delta, massFraction, usl, musl;
    };
    // basis, shift, smallest nodal mass fraction, critical c_p dt/h for USL and for MUSL and USF (1D, spectral radius)
    const std::vector<Row> rows = {{"linear", 0, 0.5, 0.75, 1.73},
                                   {"linear", 0.24, 0.26, 0.67, 1.44},
                                   {"linear", 0.26, 5e-3, 0.14, 1.43},
                                   {"linear", 0.4, 7.5e-2, 0.52, 1.68},
                                   {"uGIMP", 0, 0.5, 0.75, 1.73},
                                   {"uGIMP", 0.1, 5e-3, 0.65, 1.88},
                                   {"uGIMP", 0.3, 4.5e-2, 0.70, 1.96},
                                   {"uGIMP", 0.49, 0.12, 0.66, 1.75},
                                   {"quadraticBSpline", 0, 1.56e-2, 0.88, 2.30},
                                   {"quadraticBSpline", 0.249, 2.5e-7, 0.69, 2.17},
                                   {"quadraticBSpline", 0.2, 6.25e-4, 0.74, 2.22}};
    for (const auto& row : rows)
        for (const auto update : {StressUpdate::USL, StressUpdate::MUSL, StressUpdate::USF})
        {
            const double known = update == StressUpdate::USL ? row.usl : row.musl;
            const double bound = stepping::criticalCourant(2, row.shape != "linear", update, row.massFraction);
            const double below = growth(row.shape, update, row.delta, known - 0.02);
            const double above = growth(row.shape, update, row.delta, known + 0.02);
            fmt::print(
                "{:>16} {:<5} shift {:<5} critical {:.2f}: growth a step {:.5f} just below, {:.5f} just above; the "
                "solver allows {:.3f}\n",
                row.shape, stepping::stressUpdateName(update), row.delta, known, below, above, bound);
            CHECK(below < 1.002); // modes beat, but do not grow
            CHECK(above > 1.05);
            CHECK(bound <= known + 0.005);
        }
}

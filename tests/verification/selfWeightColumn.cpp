// A confined elastic column under its own weight, brought to rest. Exact at material Y for any strain, as the area is
// constant: sigma_yy = - rho0 g (H - Y). Positions for the rate form sigma = M ln(dy/dY):
//     y(Y) = (M/(rho0 g)) (exp(-s(Y)/M) - exp(-s(0)/M)),  s(Y) = rho0 g (H - Y)
// H = 50 m, M = E = 1 MPa (nu = 0), rho0 = 80 kg/m^3, g = 10 m/s^2 (the column of the AMPLE tests, W. Coombs): its top
// settles by 0.98680 m. Rest is reached by kinetic damping: all velocities are set to zero at each peak of the kinetic
// energy.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace mpm;

namespace
{
constexpr double H = 50, M = 1e6, rho = 80, g = 10;

double weightAbove(double Y)
{
    return rho * g * (H - Y);
}

double position(double Y)
{
    return M / (rho * g) * (std::exp(-weightAbove(Y) / M) - std::exp(-weightAbove(0) / M));
}

struct Errors
{
    double stress = 0, position = 0; ///< RMS over particles [Pa], [m]
};

Errors settle(const std::string& shape, Index N)
{
    const double h = H / double(N);
    auto s = scenes::seedBlock({.n = {2, 2 * N, 1}, .spacing = h / 2, .h = h, .density = rho, .cells = {1, N, 1}});
    std::vector<double> Y;
    for (Index i = 0; i < s.particles.size(); ++i)
        Y.push_back(s.particles.x[1][std::size_t(i)]);
    stepping::Scene scene;
    scene.materials = {scenes::elastic(M, 0, rho)};
    scene.gravity = Vector3{0, -g, 0};
    using nodal::WallType;
    scene.walls = {{"base", WallType::fixed, 1, -1, 0, 0, false},
                   {"left", WallType::roller, 0, -1, 0, 0, false},
                   {"right", WallType::roller, 0, 1, 1, 0, false}};
    auto stepper = cases::makeStepper(shape, s, scene);
    stepping::beginLedger(s, scene.materials);
    const double dt = 0.5 * h / std::sqrt(M / rho);
    double last = 0;
    for (Index n = 0; n < 60 * N; ++n)
    {
        stepper->step(dt);
        if (s.ledger.kineticEnergy < last)
        {
            for (auto& v : s.particles.v)
                std::fill(v.begin(), v.end(), 0.0);
            s.ledger.kineticEnergy = 0;
            stepper->particlesChanged();
        }
        last = s.ledger.kineticEnergy;
    }
    Errors errors;
    for (Index i = 0; i < s.particles.size(); ++i)
    {
        const double y0 = Y[std::size_t(s.particles.id[std::size_t(i)])];
        errors.stress += std::pow(s.particles.stress[1][std::size_t(i)] + weightAbove(y0), 2);
        errors.position += std::pow(s.particles.x[1][std::size_t(i)] - position(y0), 2);
    }
    errors.stress = std::sqrt(errors.stress / double(s.particles.size()));
    errors.position = std::sqrt(errors.position / double(s.particles.size()));
    return errors;
}
} // namespace

TEST_CASE("the closed form gives the published settlement")
{
    CHECK(H - position(H) == Approx(0.98680).epsilon(1e-5));
}

TEST_CASE("self-weight column: GIMP converges to stress and position")
{
    for (const std::string shape : {"uGIMP", "cpGIMP"})
    {
        Errors first, last;
        for (const Index N : {10, 20, 40, 80})
        {
            const auto e = settle(shape, N);
            fmt::print("{:>7} N {:>3}  stress error {:.3f} Pa ({:.4f} % of rho g H)  position error {:.3e} m\n", shape,
                       N, e.stress, 100 * e.stress / (rho * g * H), e.position);
            CHECK((N == 10 || (e.stress < 0.7 * last.stress && e.position < 0.7 * last.position)));
            if (N == 10)
                first = e;
            last = e;
        }
        // of first order, as the literature has it for GIMP
        CHECK(std::log2(first.stress / last.stress) / 3 > 0.9);
        CHECK(std::log2(first.position / last.position) / 3 > 0.9);
        CHECK(last.stress < 0.005 * rho * g * H);
        CHECK(last.position < 1e-3);
    }
}

// The manufactured 1D bar, in the rate-form law sigma = M ln F that incremental elasticity integrates exactly.
//
// Set-up: fixed ends, L = 1 m, u = A sin(pi X) sin(c pi t), c = sqrt(M/rho); body force
//     b = pi^2 (M/rho) u (1/F - 1),   F = 1 + pi A cos(pi X) sin(c pi t).
// E = 10 MPa, nu = 0 (M = E), rho = 1000 kg/m^3: c = 100 m/s. One cell thick between rollers, two particles per cell an
// axis, Courant number 0.1, velocities start half a step early, to t = 0.015 s (three quarters of a period).
// Error: the largest RMS displacement error over time [m].
// Source: Wallstedt & Guilkey, J. Comput. Phys. 227 (2008) 9628, for the solution and the choice of A; the rate form's
// body force is derived in the text above (b = u_tt - (M/rho) F_X/F).
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace mpm;

namespace
{
constexpr double modulus = 1e7, density = 1000, speed = 100;

double displacement(double A, double X, double t)
{
    return A * std::sin(M_PI * X) * std::sin(speed * M_PI * t);
}

class BarForce : public stepping::BodyForce
{
  public:
    BarForce(double A, std::vector<double> X) : A_(A), X_(std::move(X)) {}
    void acceleration(const state::Particles& p, Index first, int count, double t, double (&b)[3][lanes]) const override
    {
        for (int l = 0; l < count; ++l)
        {
            const double X = X_[std::size_t(p.id[std::size_t(first + l)])];
            const double F = 1 + M_PI * A_ * std::cos(M_PI * X) * std::sin(speed * M_PI * t);
            b[0][l] = M_PI * M_PI * modulus / density * displacement(A_, X, t) * (1 / F - 1);
            b[1][l] = b[2][l] = 0;
        }
    }

  private:
    double A_;
    std::vector<double> X_;
};

/// Largest RMS displacement error of a bar of N cells.
double barError(const std::string& shape, stepping::StressUpdate update, double A, Index N)
{
    const double h = 1.0 / double(N), dt = 0.1 * h / speed;
    auto s = scenes::seedBlock({.n = {2 * N, 2, 1}, .spacing = h / 2, .h = h, .density = density, .cells = {N, 1, 1}});
    std::vector<double> X;
    for (Index i = 0; i < s.particles.size(); ++i)
    {
        X.push_back(s.particles.x[0][std::size_t(i)]);
        s.particles.v[0][std::size_t(i)] =
            A * M_PI * speed * std::sin(M_PI * X.back()) * std::cos(speed * M_PI * 0.5 * dt);
    }
    stepping::Scene scene;
    scene.materials = {scenes::elastic(modulus, 0, density)};
    scene.stressUpdate = update;
    scene.bodyForce = std::make_shared<BarForce>(A, X);
    using nodal::WallType;
    scene.walls = {{"left", WallType::roller, 0, -1, 0, 0, false},
                   {"right", WallType::roller, 0, 1, N, 0, false},
                   {"below", WallType::roller, 1, -1, 0, 0, false},
                   {"above", WallType::roller, 1, 1, 1, 0, false}};
    auto stepper = cases::makeStepper(shape, s, scene);
    double worst = 0;
    const Index steps = Index(std::lround(0.015 / dt));
    for (Index n = 0; n < steps; ++n)
    {
        stepper->step(dt);
        double sum = 0;
        for (Index i = 0; i < s.particles.size(); ++i)
        {
            const double x0 = X[std::size_t(s.particles.id[std::size_t(i)])];
            const double error = s.particles.x[0][std::size_t(i)] - x0 - displacement(A, x0, s.time);
            sum += error * error;
        }
        worst = std::max(worst, std::sqrt(sum / double(s.particles.size())));
    }
    return worst;
}

struct Convergence
{
    std::vector<double> error, order;
};

Convergence converge(const std::string& shape, stepping::StressUpdate update, double A, const std::vector<Index>& cells)
{
    Convergence out;
    for (const Index N : cells)
    {
        double error = 1;
        try
        {
            error = barError(shape, update, A, N);
        }
        catch (const std::exception&) // a scheme that diverges may end by an error of its own
        {}
        if (!out.error.empty())
            out.order.push_back(std::log2(out.error.back() / error));
        out.error.push_back(error);
        fmt::print("{:>7} A {:<6} N {:>3}  error {:.4e} m  order {}\n", shape, A, N, error,
                   out.order.empty() ? "" : fmt::format("{:.2f}", out.order.back()));
    }
    return out;
}
} // namespace

TEST_CASE("manufactured bar: small strain, every shape is of second order")
{
    for (const std::string shape : {"linear", "uGIMP", "cpGIMP"})
    {
        const auto c = converge(shape, stepping::StressUpdate::USL, 1e-4, {8, 16, 32, 64});
        for (const double order : c.order)
            CHECK(order > 1.95);
        CHECK(c.order.back() == Approx(2).margin(0.05));
    }
}

TEST_CASE("manufactured bar: at large strain only domains that follow the stretch converge")
{
    using stepping::StressUpdate;
    const auto cp = converge("cpGIMP", StressUpdate::USL, 0.05, {8, 16, 32, 64, 128});
    for (const double order : cp.order)
        CHECK(order > 1.95);
    CHECK(cp.order.back() == Approx(2).margin(0.05));
    CHECK(cp.error.back() <= 1.5e-5);

    const auto u = converge("uGIMP", StressUpdate::USL, 0.05, {8, 16, 32, 64});
    CHECK(u.order.front() > 1.8);
    CHECK(u.order.back() < 1); // gaps between domains of fixed size

    const auto linear = converge("linear", StressUpdate::USL, 0.05, {8, 16, 32, 64});
    CHECK(linear.error.back() > linear.error.front()); // particles cross cell faces: it diverges
}

TEST_CASE("manufactured bar: MUSL keeps the order of its shape")
{
    const auto cp = converge("cpGIMP", stepping::StressUpdate::MUSL, 0.05, {8, 16, 32, 64});
    for (const double order : cp.order)
        CHECK(order > 1.95);
    CHECK(cp.order.back() == Approx(2).margin(0.05));
}

#include "reference/semiDiscreteSolution.hpp"

#include "base/error.hpp"
#include "reference/odeSolver.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::reference
{
namespace
{
/// Absolute tolerances of all columns of y.
std::vector<double> tolerances(const state::State& state, const semiDiscrete::Model& model, std::size_t size,
                               double window, double tolerance, double speedScale)
{
    const auto& p = state.particles;
    const std::size_t n = std::size_t(p.size()), dim = std::size_t(p.dim);
    double wave = 0, modulus = 0;
    for (const auto& material : model.materials)
    {
        wave = std::max(wave, material.waveSpeed());
        modulus = std::max(modulus, material.law->waveModulus());
    }
    double speed = speedScale;
    for (std::size_t i = 0; i < n; ++i)
    {
        for (std::size_t a = 0; a < dim; ++a)
            speed = std::max(speed, std::abs(double(p.v[a][i])));
        for (std::size_t k = 0; k < std::size_t(stressComponents(p.dim)); ++k)
            speed = std::max(speed, std::abs(double(p.stress[k][i])) / modulus * wave);
    }
    if (model.gravity)
        for (const double g : *model.gravity)
            speed = std::max(speed, std::abs(g) * window);
    if (speed == 0)
        speed = 1e-6 * wave;
    std::vector<double> out(size);
    for (std::size_t i = 0; i < size; ++i)
    {
        const std::size_t column = i / n;
        out[i] = tolerance * speed *
                 (column < dim                   ? state.grid.h / wave
                  : column < 2 * dim             ? 1
                  : column < 2 * dim + dim * dim ? 1 / wave
                                                 : modulus / wave);
    }
    return out;
}
} // namespace

SemiDiscreteSolution integrateSemiDiscrete(semiDiscrete::SemiDiscrete& equations, const state::State& state,
                                           const semiDiscrete::Model& model, double window, double tolerance,
                                           double speedScale)
{
    equations.arrange(state);
    std::vector<double> start;
    equations.pack(state, start);
    const std::size_t size = start.size();
    std::vector<double> y(size);
    const auto from = [&](const double* change) {
        for (std::size_t i = 0; i < size; ++i)
            y[i] = start[i] + change[i];
    };
    const double begin = state.time;
    OdeSolver ode(tolerance, tolerances(state, model, size, window, tolerance, speedScale),
                  [&](double t, const double* change, double* rate) {
                      from(change);
                      equations.rates(begin + t, y.data(), rate);
                  });
    ode.restart(0, std::vector<double>(size, 0));
    while (ode.advance(window) != OdeSolver::Stop::end)
    {}
    SemiDiscreteSolution out;
    from(ode.state().data());
    out.y = std::move(y);
    out.evaluations = ode.evaluations();
    out.tolerance = tolerance;
    return out;
}
} // namespace mpm::reference

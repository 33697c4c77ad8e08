#pragma once
/// The semi-discrete equations over a window of time to tight tolerance, by SUNDIALS CVODE (Adams formulas): the
/// solution every time integration of them converges to.
///
/// Unknowns are the changes d = y - y(t0), so that tolerances and round-off are measured by what happens and not by
/// coordinates. Local errors are held under tolerance times |d| and times the scales a wave of the largest speed s in
/// sight gives each column: x s h/c, v s, F s/c, sigma M s/c, with c the wave speed, M the P-wave modulus and s =
/// max(|v|, |g| window, c max|sigma|/M, speedScale).
#include "semiDiscrete/semiDiscrete.hpp"

namespace mpm::reference
{
struct SemiDiscreteSolution
{
    std::vector<double> y; ///< at the end
    long evaluations = 0;
    double tolerance = 0;
};

/// From y at time t0 over `window` [s]. Throws StepError where the equations or CVODE cannot go on.
SemiDiscreteSolution integrateSemiDiscrete(semiDiscrete::SemiDiscrete& equations, const state::State& state,
                                           const semiDiscrete::Model& model, double window, double tolerance = 1e-12,
                                           double speedScale = 0);
} // namespace mpm::reference

#pragma once
/// Explicit Runge-Kutta steps on the semi-discrete equations (semiDiscrete/semiDiscrete.hpp).
///     RK2  the midpoint rule (Runge 1895): y + dt g(t + dt/2, y + dt/2 g(t, y))
///     RK4  the classical formula (Kutta 1901): dt/6 (k1 + 2 k2 + 2 k3 + k4)
/// Two and four evaluations a step, each a projection and a gather: as much work as two and four USL steps.
///
///     timeIntegration RK4;      // mpmSchemes: symplecticEuler | RK2 | RK4
///
/// The order is seen where the right-hand side is smooth enough along the motion: cubic splines and, while no particle
/// crosses a cell face, all others. Where particles cross, second derivatives of uGIMP, cpGIMP and quadratic splines
/// jump: RK4 then ends at order 2 to 1, at errors far below those of the symplectic schemes.
///
/// Refused, as the equations are not smooth or no ODE of the particles: laws that can yield, walls that separate or
/// rub, splitting, picRate > 0, local damping, bulk viscosity, merging, loads on surfaces (which are carried by the
/// grid), shapes whose gradients jump.
///
/// Energy budget: gravity, body force and damping work are quadratures of their powers with the stages and weights of
/// the step itself, as are the impulses and the energy rate laws make. Kinetic and strain energies are those of the
/// particles. There is no transfer, wall or staggering loss in an ODE that conserves energy, so the residual is the
/// temporal error of the energy: it falls as dt^3 (RK2) and dt^5 (RK4).
///
/// Stability (rungeKuttaCourant): vibrations turn on the imaginary axis at up to omega = 1.40 c_p/h in 2D and 1.56
/// c_p/h in 3D, the largest found over free blocks (tests/verification/rungeKutta.cpp).
///     RK4  |1 + iz - z^2/2 - iz^3/6 + z^4/24| <= 1 up to z = omega dt = 2.828
///     RK2  |1 + iz - z^2/2|^2 = 1 + z^4/4: no step is stable, the fastest vibration grows by z^4/8 a step. The limit
///          is z = 0.3, where it takes 990 steps to grow to e times its size; slower ones grow far less (order z^3 in
///          time). Longer runs want RK4 or a symplectic scheme.
#include "semiDiscrete/semiDiscrete.hpp"
#include "stepping/stepper.hpp"

namespace mpm::stepping
{
enum class RungeKuttaOrder
{
    RK2 = 2,
    RK4 = 4
};

/// What of a scene the semi-discrete equations see. Throws InputError for what they cannot: the reason as whyNotSmooth
/// gives it.
semiDiscrete::Model semiDiscreteModel(const Scene& scene);
/// Why a scene has no smooth equations; empty if it has.
std::string whyNotSmooth(const Scene& scene);

/// `equations` are those of the scene, on the same state.
std::unique_ptr<Stepper> makeRungeKutta(RungeKuttaOrder order, std::unique_ptr<semiDiscrete::SemiDiscrete> equations,
                                        state::State& state, const Scene& scene);

/// Largest c_p dt/h: 1.88 and 1.66 for RK4 in 2D and 3D, 0.2 and 0.176 for RK2.
double rungeKuttaCourant(RungeKuttaOrder order, int dim);
} // namespace mpm::stepping

#pragma once
/// The equations MPM solves before time is cut into steps: an ODE for position, velocity, deformation gradient and
/// stress of every particle (METHOD Eqs. 1-8 without dt),
///     m_i = sum m_p N_ip,   v_i = sum m_p v_p N_ip / m_i,   f_i = - sum V_p sigma_p . gradN_ip + sum m_p b_p N_ip
///     a_i = f_i/m_i + g - v_i/tau
///     x_p' = sum N_ip v_i,  v_p' = sum N_ip a_i,  F_p' = L_p F_p,  L_p = sum v_i (x) gradN_ip,  V_p = V0_p det F_p
///     sigma_p' = C : D + W sigma - sigma W   (linearElastic, the Jaumann rate; D, W = sym L, skew L)
///     sigma_p  = sigma(F_p)                  (laws of F; then stress is no unknown)
/// Domains of cpGIMP follow F. It is the limit of the explicit steps for dt -> 0 away from walls, what Runge-Kutta
/// methods integrate (stepping/rungeKutta.hpp), and with SUNDIALS the measure of temporal errors (checkIntegration
/// -time).
///
/// The system is an ODE where its right-hand side is continuous: shapes with continuous gradients (uGIMP, cpGIMP,
/// B-splines), laws that never yield. Walls are mirrors: at their nodes the normal velocity (fixed: all of it) and
/// acceleration are zero, as mirrored particles would make them. Explicit steps also take the normal velocity that is
/// projected to such a node from the particles, in the first few steps and whatever dt; where particles lie that close
/// to a wall and move towards it, their limit differs by this.
///
/// Energy is conserved exactly: d/dt (sum m v^2/2) = sum f_i . v_i + sum m_i (g - v_i/tau) . v_i, and
/// - sum f_i . v_i = sum V sigma : D. With a rate law the elastic energy u V also grows by u V tr D, which is no work.
///
/// Sums run over tiles in an order that particle keys fix, so results do not depend on the number of threads.
/// Verified in tests/unit/semiDiscrete.cpp and tests/verification/timeIntegration.cpp.
#include "constitutive/material.hpp"
#include "nodal/boundaries.hpp"
#include "state/state.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace mpm::semiDiscrete
{
/// b[axis][lane] [m/s^2] of the `count` particles from `first` on, at their places in `particles`.
using BodyForce =
    std::function<void(const state::Particles& particles, Index first, int count, double time, double (&b)[3][lanes])>;

/// What acts on the particles.
struct Model
{
    std::vector<constitutive::Material> materials; ///< by Particles::material
    std::optional<Vector3> gravity;                ///< [m/s^2]
    std::optional<double> relaxationTime;          ///< tau of viscous damping [s]
    std::vector<nodal::Wall> walls;
    BodyForce bodyForce;
};

/// Why these have no smooth equations; empty if they have. ("law mohrCoulomb can yield: ...")
std::string whyNotSmooth(const Model& model);

/// Rates of work and momentum at one instant, in 2D per metre. Sums over nodes or particles.
struct Powers
{
    double gravity = 0;      ///< sum m_i g . v_i [W]
    double bodyForce = 0;    ///< sum m_p b_p . x_p' [W]
    double damping = 0;      ///< sum m_i v_i . v_i/tau, taken from the body [W]
    double stress = 0;       ///< sum V sigma : D [W]
    double finiteStrain = 0; ///< sum V u tr D of rate laws: elastic energy nobody supplied [W]
    Vector3 gravityForce{}, wallForce{}, dampingForce{}; ///< on the body [N]
    double lightestNode = 0;                             ///< smallest mass of a node that carries any [kg]
};

/// Sums over particles of one state.
struct Summary
{
    double kineticEnergy = 0, strainEnergy = 0; ///< [J]
    Vector3 momentum{};                         ///< [N s]
    double largestSpeed = 0;                    ///< [m/s]
    double smallestJacobian = 1;
    double largestJacobian = 1; ///< as State::largestJacobian
    Index cappedDomains = 0;    ///< domains wider than the shape allows, held there
};

class SemiDiscrete
{
  public:
    virtual ~SemiDiscrete() = default;

    /// Takes number, order, masses, sizes and materials of the particles from a state; y belongs to that order until
    /// the next call.
    virtual void arrange(const state::State& state) = 0;
    /// Number of unknowns, columns of y times particles: x, v, F and, if a law needs it, sigma, component by component.
    virtual std::size_t size() const = 0;
    virtual void pack(const state::State& state, std::vector<double>& y) const = 0;
    /// Writes x, v, F, V and stress; time and ledger stay. Throws StepError where det F <= 0.
    virtual Summary unpack(const double* y, state::State& state) const = 0;
    /// y' at time t. Particles may lie anywhere in the grid: tiles are cut anew where one has left its own.
    /// Throws StepError for particles outside the grid, det F <= 0 and numbers that are not finite.
    virtual void rates(double t, const double* y, double* rate, Powers* powers = nullptr) = 0;
    /// Were tiles cut anew since arrange()? Then a state should be sorted by position before it is arranged again.
    virtual bool strayed() const = 0;
    /// Nodes an axis of the support that sort keys stand for.
    virtual int keyNodes() const = 0;
    /// Evaluations of rates() so far.
    virtual long evaluations() const = 0;
};

/// The instantiated pairs are those of shapes with continuous gradients. Throws InputError if whyNotSmooth says
/// something.
template <int dim, class Shape>
std::unique_ptr<SemiDiscrete> makeSemiDiscrete(const state::State& state, Model model);
} // namespace mpm::semiDiscrete

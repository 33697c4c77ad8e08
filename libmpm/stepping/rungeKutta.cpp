#include "stepping/rungeKutta.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "stepping/sortParticles.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::stepping
{
namespace
{
/// One row of a method's tableau: the stage's time and where it starts from, y + start dt k, and its weight.
struct Stage
{
    double start, weight;
};

const std::vector<Stage>& stages(RungeKuttaOrder order)
{
    static const std::vector<Stage> midpoint = {{0, 0}, {0.5, 1}};
    static const std::vector<Stage> classical = {{0, 1.0 / 6}, {0.5, 1.0 / 3}, {0.5, 1.0 / 3}, {1, 1.0 / 6}};
    return order == RungeKuttaOrder::RK2 ? midpoint : classical;
}

class RungeKutta : public Stepper
{
  public:
    RungeKutta(RungeKuttaOrder order, std::unique_ptr<semiDiscrete::SemiDiscrete> equations, state::State& state,
               const Scene& scene)
        : order_(order), equations_(std::move(equations)), state_(state), scene_(scene), layout_(state.grid)
    {
        sortByStoredKeys(state_);
    }

    void step(double dt) override;
    void particlesChanged() override { arranged_ = false; }
    const StepReport& report() const override { return report_; }
    PassTimes times() const override { return times_; }
    double smallestNodalMassFraction() override;
    double largestSpeed() const override;

  private:
    void arrange();
    void sortAnew();
    void takeStages(double dt);
    void book(double dt, double weight, const semiDiscrete::Powers& powers);
    void finish();

    RungeKuttaOrder order_;
    std::unique_ptr<semiDiscrete::SemiDiscrete> equations_;
    state::State& state_;
    const Scene scene_;
    state::TileLayout layout_;
    bool arranged_ = false;
    std::vector<double> start_, at_, rate_, sum_; ///< y at the start, y of a stage, its rate, y at the end
    StepReport report_;
    PassTimes times_;
};

/// The order of particles follows from the state alone, so a continued run does the same.
void RungeKutta::arrange()
{
    if (state_.step % scene_.sortInterval == 0)
        sortAnew();
    else if (!arranged_)
    {
        Clock clock(times_.sort);
        equations_->arrange(state_);
    }
    arranged_ = true;
}

void RungeKutta::sortAnew()
{
    Clock clock(times_.sort);
    sortByPosition(state_, layout_, equations_->keyNodes());
    equations_->arrange(state_);
}

void RungeKutta::step(double dt)
try
{
    arrange();
    equations_->pack(state_, start_);
    takeStages(dt);
    finish();
    state_.time += dt;
    state_.deltaT = dt;
    ++state_.step;
    if (equations_->strayed()) // tiles of a stage, or of a particle on its way out of its own
        sortAnew();
}
catch (const OutsideGrid& error)
{
    throw OutsideGrid(fmt::format("step {} at time {:.9g} s: {}", state_.step, state_.time, error.what()));
}
catch (const StepError& error)
{
    throw StepError(fmt::format("step {} at time {:.9g} s: {}", state_.step, state_.time, error.what()));
}

void RungeKutta::takeStages(double dt)
{
    const std::size_t size = equations_->size();
    at_.resize(size);
    rate_.resize(size);
    sum_.resize(size);
    const Index n = Index(size);
    const auto& table = stages(order_);
    for (std::size_t s = 0; s < table.size(); ++s)
    {
        const double start = table[s].start * dt, weight = table[s].weight * dt;
        if (s > 0)
        {
#pragma omp parallel for schedule(static)
            for (Index i = 0; i < n; ++i)
                at_[std::size_t(i)] = start_[std::size_t(i)] + start * rate_[std::size_t(i)];
        }
        semiDiscrete::Powers powers;
        {
            Clock clock(times_.toGrid);
            equations_->rates(state_.time + start, s == 0 ? start_.data() : at_.data(), rate_.data(), &powers);
        }
        if (scene_.bodyForce)
            if (const auto fault = scene_.bodyForce->takeFault(); !fault.empty())
                throw StepError(fault);
        report_.lightestNode = powers.lightestNode;
        book(dt, table[s].weight, powers);
        const auto& before = s == 0 ? start_ : sum_;
#pragma omp parallel for schedule(static)
        for (Index i = 0; i < n; ++i)
            sum_[std::size_t(i)] = before[std::size_t(i)] + weight * rate_[std::size_t(i)];
    }
}

void RungeKutta::book(double dt, double weight, const semiDiscrete::Powers& powers)
{
    auto& ledger = state_.ledger;
    const double share = weight * dt;
    ledger.gravityWork += share * powers.gravity;
    ledger.bodyForceWork += share * powers.bodyForce;
    ledger.dampingDissipation += share * powers.damping;
    ledger.finiteStrainWork += share * powers.finiteStrain;
    for (std::size_t a = 0; a < 3; ++a)
    {
        ledger.gravityImpulse[a] += share * powers.gravityForce[a];
        ledger.wallImpulse[a] += share * powers.wallForce[a];
        ledger.dampingImpulse[a] += share * powers.dampingForce[a];
    }
}

void RungeKutta::finish()
{
    Clock clock(times_.toParticles);
    const auto summary = equations_->unpack(sum_.data(), state_);
    wrapPositions(state_);
    state_.ledger.kineticEnergy = summary.kineticEnergy;
    state_.largestJacobian = summary.largestJacobian;
    report_.strainEnergy = summary.strainEnergy;
    report_.momentum = summary.momentum;
    report_.largestSpeed = summary.largestSpeed;
    report_.smallestJacobian = summary.smallestJacobian;
    report_.cappedDomains = summary.cappedDomains;
}

double RungeKutta::smallestNodalMassFraction()
{
    arrange();
    equations_->pack(state_, start_);
    rate_.resize(start_.size());
    semiDiscrete::Powers powers;
    equations_->rates(state_.time, start_.data(), rate_.data(), &powers);
    double density = 0;
    for (const auto& material : scene_.materials)
        density = std::max(density, material.density);
    return powers.lightestNode / (density * std::pow(state_.grid.h, state_.particles.dim));
}

double RungeKutta::largestSpeed() const
{
    double fastest = 0;
    const auto& p = state_.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        double vv = 0;
        for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
            vv += double(p.v[a][i]) * p.v[a][i];
        fastest = std::max(fastest, vv);
    }
    return std::sqrt(fastest);
}

/// What a scene has that an ODE of its particles cannot have.
std::string whyNoOde(const Scene& scene)
{
    if (scene.splitting)
        return "splitting changes the number of particles";
    if (!scene.bodies.empty())
        return fmt::format("the rigid body '{}' pushes: its force jumps", scene.bodies.front().name);
    if (!scene.absorbing.empty())
        return fmt::format("the boundary '{}' absorbs waves step by step", scene.absorbing.front().name);
    if (scene.gravityRamp)
        return "gravity comes on by a ramp";
    if (scene.picRate > 0)
        return "picRate blends velocities once a step, which is no part of the equations of motion";
    if (scene.transfer != Transfer::FLIP)
        return "only the transfer FLIP has a limit for small steps: the others filter velocities once a step";
    if (scene.contact)
        return "contact between bodies is decided once a step";
    if (scene.bulkViscosity)
        return "bulk viscosity begins where compression does, with a kink of the right-hand side";
    if (scene.merging)
        return "merging changes the number of unknowns";
    if (scene.localDamping)
        return "local damping turns round with the velocity, where the right-hand side jumps";
    if (!scene.carried.empty())
        return fmt::format("the surface '{}' is carried along", scene.carried.front()->name);
    if (!scene.loads.empty())
        return fmt::format(
            "the load on '{}' acts on a surface carried by the grid, which is no unknown of the particles",
            scene.loads.front().patch);
    return {};
}

semiDiscrete::Model modelOf(const Scene& scene)
{
    semiDiscrete::Model model;
    model.materials = scene.materials;
    model.gravity = scene.gravity;
    model.relaxationTime = scene.relaxationTime;
    model.walls = scene.walls;
    if (scene.bodyForce)
        model.bodyForce = [force = scene.bodyForce](const state::Particles& particles, Index first, int count,
                                                    double time, double(&b)[3][lanes]) {
            force->acceleration(particles, first, count, time, b);
        };
    return model;
}
} // namespace

std::string whyNotSmooth(const Scene& scene)
{
    const auto why = whyNoOde(scene);
    return why.empty() ? semiDiscrete::whyNotSmooth(modelOf(scene)) : why;
}

semiDiscrete::Model semiDiscreteModel(const Scene& scene)
{
    if (const auto why = whyNotSmooth(scene); !why.empty())
        throw InputError(why);
    return modelOf(scene);
}

std::unique_ptr<Stepper> makeRungeKutta(RungeKuttaOrder order, std::unique_ptr<semiDiscrete::SemiDiscrete> equations,
                                        state::State& state, const Scene& scene)
{
    return std::make_unique<RungeKutta>(order, std::move(equations), state, scene);
}

double rungeKuttaCourant(RungeKuttaOrder order, int dim)
{
    const double omega = dim == 2 ? 1.5 : 1.7; // of the fastest vibration, in c_p/h, and some room
    return (order == RungeKuttaOrder::RK4 ? 2.828 : 0.3) / omega;
}
} // namespace mpm::stepping

// Soil at rest sleeps (stepping/rest.hpp): what is left out is bounded by the tolerance, the books close, and who
// sleeps follows from the state.
#include "case/makeStepper.hpp"
#include "support/scenes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <omp.h>

using namespace mpm;
using stepping::StressUpdate;

namespace
{
constexpr double h = 0.5, E = 20e6, nu = 0.3, density = 1000;

std::shared_ptr<const dictionary::Motion> motion(const std::string& text)
{
    return std::make_shared<const dictionary::Motion>(
        dictionary::Motion::read(dictionary::Dictionary::fromText(text), 2));
}

constitutive::Material soil()
{
    return scenes::elastic(E, nu, density);
}

/// A bar along x, 128 cells long and 2 high (in 3D 32 x 1 x 1), two particles a cell, between smooth walls.
state::State bar(int dim)
{
    const Index length = dim == 2 ? 128 : 32, width = dim == 2 ? 2 : 1;
    return scenes::seedBlock({.dim = dim,
                              .corner = {0, 0, 0},
                              .n = {2 * length, 2 * width, dim == 3 ? 2 * width : 1},
                              .spacing = h / 2,
                              .h = h,
                              .density = density,
                              .low = {-2 * h, 0, 0},
                              .cells = {length + 4, width, dim == 3 ? width : 1}});
}

stepping::Scene barScene(std::optional<stepping::Rest> rest, int dim = 2, StressUpdate update = StressUpdate::MUSL)
{
    stepping::Scene scene;
    scene.materials = {soil()};
    scene.stressUpdate = update;
    scene.rest = rest;
    for (int a = 1; a < dim; ++a)
        for (const int side : {-1, 1})
            scene.walls.push_back(
                {"side", nodal::WallType::roller, a, side, side < 0 ? 0 : (dim == 2 ? Index(2) : Index(1)), 0, false});
    return scene;
}

/// The left end of the bar moves inwards at `speed`, falling to nothing over four cells.
void push(state::State& s, double speed)
{
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        p.v[0][i] = p.x[0][i] < 4 * h ? 0.5 * speed * (1 + std::cos(M_PI * p.x[0][i] / (4 * h))) : 0;
    p.padLastChunk();
}

double stepOf(double courant = 0.3)
{
    return courant * h / soil().waveSpeed();
}

struct Outcome
{
    state::State state;
    Index mostResting = 0, leastResting = std::numeric_limits<Index>::max();
    double restingStress = 0;
};

Outcome run(state::State s, const stepping::Scene& scene, int steps, const std::string& shape = "uGIMP")
{
    Outcome out{std::move(s)};
    auto stepper = cases::makeStepper(shape, out.state, scene);
    stepping::beginLedger(out.state, scene.materials);
    for (int n = 0; n < steps; ++n)
    {
        stepper->step(stepOf());
        out.mostResting = std::max(out.mostResting, stepper->report().resting);
        out.leastResting = std::min(out.leastResting, stepper->report().resting);
        out.restingStress = std::max(out.restingStress, stepper->report().restingStress);
    }
    return out;
}

/// Values by id: positions, velocities, stresses.
std::vector<double> valuesOf(const state::Particles& p)
{
    const int row = 2 * p.dim + stressComponents(p.dim);
    std::vector<double> out(std::size_t(p.size() * row));
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        double* at = out.data() + std::size_t(p.id[i]) * std::size_t(row);
        for (int a = 0; a < p.dim; ++a)
            *at++ = p.x[a][i];
        for (int a = 0; a < p.dim; ++a)
            *at++ = p.v[a][i];
        for (int k = 0; k < stressComponents(p.dim); ++k)
            *at++ = p.stress[k][i];
    }
    return out;
}

/// Largest difference of sigma_xx over M.
double strainError(const state::State& a, const state::State& b)
{
    std::vector<double> of(std::size_t(a.particles.size()));
    double largest = 0;
    for (std::size_t i = 0; i < of.size(); ++i)
        of[std::size_t(a.particles.id[i])] = a.particles.stress[0][i];
    for (std::size_t i = 0; i < of.size(); ++i)
        largest = std::max(largest, std::abs(b.particles.stress[0][i] - of[std::size_t(b.particles.id[i])]));
    return largest / (density * soil().waveSpeed() * soil().waveSpeed());
}

double residualOf(const state::State& s, const stepping::Scene& scene)
{
    return stepping::residual(s.ledger, stepping::totals(s, scene.materials).strainEnergy);
}
} // namespace

TEST_CASE("Soil that rests in balance sleeps through a run and keeps every bit")
{
    omp_set_num_threads(1);
    auto ground = scenes::seedBlock({.corner = {0, 0, 0},
                                     .n = {80, 40, 1},
                                     .spacing = h / 2,
                                     .h = h,
                                     .density = density,
                                     .low = {0, 0, 0},
                                     .cells = {40, 24, 1}});
    auto& p = ground.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.stress[1][i] = -9.8 * density * (20 * h - p.x[1][i]);
        p.stress[0][i] = p.stress[2][i] = nu / (1 - nu) * p.stress[1][i];
    }
    p.padLastChunk();
    auto scene = barScene(stepping::Rest{1e-6, 3});
    scene.gravity = Vector3{0, -9.8, 0};
    scene.walls = {{"base", nodal::WallType::fixed, 1, -1, 0, 0, false},
                   {"left", nodal::WallType::roller, 0, -1, 0, 0, false},
                   {"right", nodal::WallType::roller, 0, 1, 40, 0, false}};
    const auto before = valuesOf(p);
    const auto out = run(ground, scene, 100);
    CHECK(out.leastResting == p.size());
    CHECK(out.state.ledger.wakes == 0);
    CHECK(valuesOf(out.state.particles) == before);
    CHECK(out.state.ledger.restingSteps == 100 * p.size());
    // the stress is in balance node by node, to round-off of 100 kPa
    CHECK(out.restingStress < 1e-6);

    SECTION("and is woken by a weight that is not borne: all of it, in the first step")
    {
        auto heavier = scene;
        heavier.gravity = Vector3{0, -12, 0};
        const auto woken = run(ground, heavier, 1);
        CHECK(woken.state.ledger.wakes > 0);
        const auto plain = run(
            ground,
            [&] {
                auto s = heavier;
                s.rest.reset();
                s.tileBits = state::TileLayout::bitsOf(2, true);
                return s;
            }(),
            1);
        CHECK(valuesOf(woken.state.particles) == valuesOf(plain.state.particles));
    }
}

TEST_CASE("What a wave meets wakes in time: the error stays at the tolerance")
{
    omp_set_num_threads(1);
    const int dim = GENERATE(2, 3);
    const auto update = GENERATE(StressUpdate::MUSL, StressUpdate::USL, StressUpdate::USF);
    CAPTURE(dim, int(update));
    auto start = bar(dim);
    push(start, 1e-3 * soil().waveSpeed());
    // the wave comes three quarters of the way
    const int steps = int(0.75 * (dim == 2 ? 128 : 32) / 0.3);
    const auto plain = run(start, barScene({}, dim, update), steps);
    double last = 0;
    for (const double tolerance : {1e-5, 1e-6, 1e-7})
    {
        const auto scene = barScene(stepping::Rest{tolerance, 5}, dim, update);
        const auto out = run(start, scene, steps);
        CAPTURE(tolerance);
        CHECK(out.mostResting > start.particles.size() / 2);
        CHECK(out.leastResting < start.particles.size() / 2);
        CHECK(out.state.ledger.wakes > 0);
        CHECK(out.restingStress <= tolerance * density * std::pow(soil().waveSpeed(), 2));
        last = strainError(out.state, plain.state);
        CHECK(last < 5 * tolerance);
        CHECK(std::abs(residualOf(out.state, scene)) < 1e-10 * out.state.ledger.initialKineticEnergy);
        // momentum that went nowhere is booked
        const auto totals = stepping::totals(out.state, scene.materials);
        const auto& l = out.state.ledger;
        for (int a = 0; a < dim; ++a)
            CHECK(std::abs(totals.momentum[a] - l.initialMomentum[a] - l.wallImpulse[a] - l.restImpulse[a]) <
                  1e-10 * l.initialMomentum[0]);
    }
}

TEST_CASE("A tolerance nothing undercuts changes no bit")
{
    omp_set_num_threads(1);
    auto start = bar(2);
    push(start, 0.1);
    for (std::size_t i = 0; i < std::size_t(start.particles.size()); ++i)
        start.particles.v[0][i] += 1;
    start.particles.padLastChunk();
    auto plainScene = barScene({});
    plainScene.tileBits = state::TileLayout::bitsOf(2, true); // the same order of sums
    const auto plain = run(start, plainScene, 60);
    const auto out = run(start, barScene(stepping::Rest{1e-6, 5}), 60);
    CHECK(out.mostResting == 0);
    CHECK(valuesOf(out.state.particles) == valuesOf(plain.state.particles));
    CHECK_FALSE(plain.state.particles.has(&state::Particles::quietLooks));
}

TEST_CASE("A state with the keys of other tiles is sorted anew and goes on")
{
    omp_set_num_threads(1);
    const int dim = GENERATE(2, 3);
    const bool smallFirst = GENERATE(false, true);
    CAPTURE(dim, smallFirst);
    auto start = bar(dim);
    push(start, 1e-2 * soil().waveSpeed());
    auto scene = barScene({}, dim);
    const auto whole = run(start, scene, 60);
    scene.tileBits = state::TileLayout::bitsOf(dim, smallFirst);
    const auto first = run(start, scene, 25);
    scene.tileBits = state::TileLayout::bitsOf(dim, !smallFirst);
    const auto out = run(first.state, scene, 35);
    CHECK(strainError(out.state, whole.state) < 1e-12);
    CHECK(std::abs(residualOf(out.state, scene)) < 1e-12 * out.state.ledger.initialKineticEnergy);
}

TEST_CASE("A damped bar falls asleep, its books closed, and lies where it lies without")
{
    omp_set_num_threads(1);
    auto start = bar(2);
    push(start, 1);
    auto scene = barScene(stepping::Rest{1e-5, 3});
    scene.relaxationTime = 0.02;
    scene.picRate = 20;
    auto plainScene = scene;
    plainScene.rest.reset();
    const auto out = run(start, scene, 1500), plain = run(start, plainScene, 1500);
    const auto& l = out.state.ledger;
    CHECK(out.mostResting > start.particles.size() / 2);
    CHECK(l.restLoss > 0);
    CHECK(std::abs(residualOf(out.state, scene)) < 1e-10 * l.initialKineticEnergy);
    const auto totals = stepping::totals(out.state, scene.materials);
    CHECK(std::abs(totals.momentum[0] - l.initialMomentum[0] - l.dampingImpulse[0] - l.wallImpulse[0] -
                   l.restImpulse[0]) < 1e-10 * l.initialMomentum[0]);
    CHECK(strainError(out.state, plain.state) < 5 * scene.rest->tolerance);
}

TEST_CASE("What sleeps may follow a slow push: one long step a look, and the bar is strained as it is without")
{
    omp_set_num_threads(1);
    const auto update = GENERATE(StressUpdate::MUSL, StressUpdate::USL, StressUpdate::USF);
    CAPTURE(int(update));
    const double tolerance = 1e-5;
    const auto start = bar(2);
    auto scene = barScene({}, 2, update);
    scene.relaxationTime = 0.1;
    scene.picRate = 10;
    // a plate moves in from the left, the far end is held
    const double speed = 2e-3;
    scene.walls.push_back({"plate", nodal::WallType::roller, 0, -1, 0, 0, false, 0,
                           motion("velocity (\"speed*min(t/1, 1)\" 0 0); constants { speed 2e-3; }")});
    scene.walls.push_back({"end", nodal::WallType::roller, 0, 1, 130, 0, false});
    scene.sortInterval = 5;
    const int steps = 3000;
    const auto plain = run(start, scene, steps);
    scene.rest = stepping::Rest{tolerance, 5, true};
    const auto out = run(start, scene, steps);
    const auto& l = out.state.ledger;
    const double strain = speed * (out.state.time - 0.5) / (128 * h);
    CHECK(strain > 5 * tolerance);
    CHECK(strainError(out.state, plain.state) < 2 * tolerance);
    CHECK(double(l.restingSteps) > 0.7 * steps * double(start.particles.size()));
    CHECK(out.restingStress <= tolerance * density * std::pow(soil().waveSpeed(), 2));
    CHECK(std::abs(residualOf(out.state, scene)) < 1e-10 * l.motionSupply);
    CHECK(std::abs(l.restLoss) < 0.25 * l.motionSupply); // mostly of the added inertia while the push begins
    const auto totals = stepping::totals(out.state, scene.materials);
    CHECK(std::abs(totals.momentum[0] - l.dampingImpulse[0] - l.wallImpulse[0] - l.restImpulse[0]) <
          1e-10 * std::abs(l.wallImpulse[0]));
}

TEST_CASE("Who sleeps follows from the state: restarts and threads change no bit")
{
    const bool follow = GENERATE(false, true);
    CAPTURE(follow);
    auto start = bar(2);
    push(start, 1e-2 * soil().waveSpeed());
    auto scene = barScene(stepping::Rest{1e-4, 2, follow});
    scene.relaxationTime = 0.03;
    omp_set_num_threads(1);
    const auto whole = run(start, scene, 400);
    CHECK(whole.state.ledger.wakes > 0);
    CHECK(whole.state.ledger.restLoss != 0);
    for (const int cut : {33, 207})
    {
        auto first = run(start, scene, cut);
        const auto second = run(first.state, scene, 400 - cut);
        CHECK(valuesOf(second.state.particles) == valuesOf(whole.state.particles));
        CHECK(second.state.ledger.restingSteps == whole.state.ledger.restingSteps);
        CHECK(second.state.ledger.restLoss == whole.state.ledger.restLoss);
    }
    for (const int threads : {2, 3})
    {
        omp_set_num_threads(threads);
        const auto other = run(start, scene, 400);
        CHECK(valuesOf(other.state.particles) == valuesOf(whole.state.particles));
        CHECK(other.state.ledger.restImpulse == whole.state.ledger.restImpulse);
    }
    omp_set_num_threads(1);
}

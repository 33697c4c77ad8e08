// Splitting keeps mass, momentum, centre, volume, stress and the domain; it respects walls and caps.
#include "splitting/splitParticles.hpp"
#include "support/scenes.hpp"
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;

namespace
{
/// One particle of unit spacing, stretched by F, at (0, y).
state::State one(int dim, const std::vector<double>& F, double y = 10)
{
    auto s = scenes::seedBlock(
        {.dim = dim, .corner = {-0.5, y - 0.5, -0.5}, .spacing = 1, .velocity = {3, -2, dim == 3 ? 1.0 : 0.0}});
    for (int k = 0; k < dim * dim; ++k)
        s.particles.F[k][0] = F[std::size_t(k)];
    s.particles.stress[0][0] = -7e3;
    s.particles.volume[0] = dim == 2 ? F[0] * F[3] - F[1] * F[2] : F[0] * F[4] * F[8];
    return s;
}

struct Sums
{
    double mass = 0, volume = 0, volume0 = 0;
    Vector3 centre{}, momentum{};
};

Sums sums(const state::Particles& p)
{
    Sums out;
    for (Index i = 0; i < p.size(); ++i)
    {
        const std::size_t k = std::size_t(i);
        out.mass += p.mass[k];
        out.volume += p.volume[k];
        out.volume0 += p.volume0[k];
        for (int a = 0; a < p.dim; ++a)
        {
            out.centre[a] += p.mass[k] * p.x[a][k];
            out.momentum[a] += p.mass[k] * p.v[a][k];
        }
    }
    return out;
}

void sameSums(const Sums& a, const Sums& b)
{
    CHECK(a.mass == b.mass); // halving is exact
    CHECK(a.volume == b.volume);
    CHECK(a.volume0 == b.volume0);
    for (int k = 0; k < 3; ++k)
    {
        CHECK(a.centre[k] == Approx(b.centre[k]).margin(1e-12 * a.mass));
        CHECK(a.momentum[k] == b.momentum[k]);
    }
}

splitting::Rule rule(splitting::Mode mode, double threshold = 2)
{
    splitting::Rule r;
    r.mode = mode;
    r.threshold = threshold;
    return r;
}
} // namespace

TEST_CASE("four-way splitting of a sheared particle")
{
    auto s = one(2, {2.5, 0.3, 0.8, 0.9});
    const auto before = sums(s.particles);
    const auto outcome = splitting::splitParticles(s, rule(splitting::Mode::fourWay), {});
    CHECK(outcome.split == 1);
    REQUIRE(s.particles.size() == 4);
    sameSums(before, sums(s.particles));
    const auto& p = s.particles;
    for (std::size_t i = 0; i < 4; ++i)
    {
        CHECK(p.length0[0][i] == 0.5);
        CHECK(p.length0[1][i] == 0.5);
        CHECK(p.stress[0][i] == -7e3);
        CHECK(p.F[1][i] == 0.3);
        CHECK(p.generation[i] == 1);
        // centres at x +- F l0_1/4 +- F l0_2/4, so that the four domains tile the parent's
        CHECK(std::abs(std::abs(p.x[0][i]) - 0.25 * 2.5) == Approx(0.25 * 0.3));
    }
    CHECK(p.id[0] == 0); // the first child keeps the parent's id
    CHECK(s.nextId == 4);
    CHECK(std::abs(s.ledger.splitMergeLoss) < 1e-12 * before.mass);
    CHECK(s.ledger.splitAngularMomentum < 1e-11 * before.mass);
}

TEST_CASE("children follow the material points at the quarters of the parent's initial domain")
{
    auto s = one(2, {2.5, 0.3, 0.8, 0.9});
    s.particles.enableX();
    s.particles.X[0][0] = 7;
    s.particles.X[1][0] = -3;
    splitting::splitParticles(s, rule(splitting::Mode::fourWay), {});
    const auto& p = s.particles;
    REQUIRE(p.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) // x - x_parent = F (X - X_parent)
        for (int a = 0; a < 2; ++a)
            CHECK(p.x[a][i] - (a == 1 ? 10 : 0) ==
                  Approx(p.F[2 * a][i] * (p.X[0][i] - 7) + p.F[2 * a + 1][i] * (p.X[1][i] + 3)).margin(1e-14));
    CHECK(p.X[0][0] != p.X[0][1]);
}

TEST_CASE("edges at or under the threshold do not split")
{
    auto s = one(2, {2, 0, 0, 2});
    CHECK(splitting::splitParticles(s, rule(splitting::Mode::fourWay), {}).split == 0);
    CHECK(s.particles.size() == 1);
}

TEST_CASE("3D: eight-way, or along stretched edges only")
{
    const std::vector<double> F = {2.5, 0, 0, 0, 1, 0, 0, 0, 2.2};
    auto eight = one(3, F), edges = one(3, F);
    const auto before = sums(eight.particles);
    splitting::splitParticles(eight, rule(splitting::Mode::fourWay), {});
    splitting::splitParticles(edges, rule(splitting::Mode::stretched), {});
    CHECK(eight.particles.size() == 8);
    REQUIRE(edges.particles.size() == 4);
    sameSums(before, sums(eight.particles));
    sameSums(before, sums(edges.particles));
    CHECK(edges.particles.length0[1][3] == 1); // the edge that was not stretched
    CHECK(edges.particles.length0[0][3] == 0.5);
}

TEST_CASE("no child's domain crosses a wall; all offsets shrink by one factor")
{
    const std::vector<splitting::Barrier> floor = {{1, -1, 0.0}};
    auto free = one(2, {2.5, 0, 0, 1}, 0.5), tight = one(2, {2.5, 0, 0, 1}, 0.4),
         pressed = one(2, {2.5, 0, 0, 1}, 0.26);
    const auto before = sums(tight.particles);

    splitting::splitParticles(free, rule(splitting::Mode::fourWay), floor);
    CHECK(std::abs(free.particles.x[1][0] - 0.5) == Approx(0.25));

    // half height of a child 0.25, reach 0.25: factor (0.4 - 0.25)/0.25 = 0.6
    splitting::splitParticles(tight, rule(splitting::Mode::fourWay), floor);
    REQUIRE(tight.particles.size() == 4);
    sameSums(before, sums(tight.particles));
    for (std::size_t i = 0; i < 4; ++i)
    {
        CHECK(tight.particles.x[1][i] - 0.25 >= -1e-15);
        CHECK(std::abs(tight.particles.x[0][i]) == Approx(0.6 * 0.25 * 2.5));
    }
    // factor 0.04 < 0.1: put off and counted
    CHECK(splitting::splitParticles(pressed, rule(splitting::Mode::fourWay), floor).putOff == 1);
    CHECK(pressed.particles.size() == 1);
    CHECK(pressed.ledger.splitsPutOff == 1);
}

TEST_CASE("caps on count and size are honoured")
{
    auto s = one(2, {2.5, 0, 0, 1});
    auto r = rule(splitting::Mode::fourWay);
    r.maxParticles = 3;
    CHECK(splitting::splitParticles(s, r, {}).capped == 1);
    CHECK(s.particles.size() == 1);
    r = rule(splitting::Mode::fourWay, 1.01);
    r.maxGeneration = 1;
    auto long1 = one(2, {5, 0, 0, 1});
    splitting::splitParticles(long1, r, {});
    CHECK(long1.particles.size() == 4);
    CHECK(splitting::splitParticles(long1, r, {}).capped == 4);
    CHECK(long1.particles.size() == 4);
}

TEST_CASE("a run looks where the last step saw long edges, and splits what a look at all particles would")
{
    auto s = treated::block();
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
        s.particles.v[0][i] = 2 * (s.particles.x[0][i] - 4.6);
    s.particles.padLastChunk();
    stepping::Scene sc;
    sc.materials = {scenes::elastic(10, 0)};
    for (const Index interval : {1, 7})
    {
        CAPTURE(interval);
        sc.splitting = splitting::Rule{.threshold = 1.4, .mode = splitting::Mode::stretched, .interval = interval};
        auto seen = s, everywhere = s;
        const auto a = cases::makeStepper("uGIMP", seen, sc), b = cases::makeStepper("uGIMP", everywhere, sc);
        for (auto* of : {&seen, &everywhere})
            stepping::beginLedger(*of, sc.materials);
        for (int n = 0; n < 400; ++n)
        {
            a->step(1e-3);
            b->particlesChanged(); // it knows nothing of the last step then
            b->step(1e-3);
        }
        CHECK(seen.ledger.splits > 20);
        CHECK(seen.ledger.splits < 36 * 3);
        CHECK(seen.particles.id == everywhere.particles.id);
        for (int k = 0; k < 2; ++k)
            CHECK(seen.particles.x[k] == everywhere.particles.x[k]);
    }
}

// Merging keeps mass, momentum, centre, volume and sum V sigma, books what it loses, and brings a body that was split
// and pressed back to what it was.
#include "splitting/mergeParticles.hpp"

#include "case/makeStepper.hpp"
#include "output/stateFile.hpp"
#include "support/scenes.hpp"
#include "support/temporaryFolder.hpp"
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace mpm;
using state::Particles;

namespace
{
const std::vector<constitutive::Material> materials = {scenes::elastic(1e6, 0.3)};

state::State lattice(int dim = 2)
{
    auto s = scenes::seedBlock({.dim = dim,
                                .corner = {2, 2, dim == 3 ? 2.0 : 0.0},
                                .n = {4, 4, 2},
                                .spacing = 0.5,
                                .h = 1,
                                .cells = {20, 20, 20},
                                .velocity = {1, -2, 0}});
    s.particles.keep(&Particles::family, true);
    return s;
}

/// x <- corner + stretch (x - corner) along x, and F with it.
void stretch(state::State& s, double factor)
{
    auto& p = s.particles;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        p.x[0][i] = 2 + factor * (p.x[0][i] - 2);
        for (int k = 0; k < p.dim; ++k)
            p.F[k][i] *= factor;
        p.volume[i] *= factor;
    }
    p.padLastChunk();
}

Index splitAll(state::State& s, double threshold = 2.55)
{
    splitting::Rule rule;
    rule.threshold = threshold;
    Index added = 0;
    for (Index more = 1; more > 0; added += more)
        more = splitting::splitParticles(s, rule, {}).added;
    return added;
}

Index mergeAll(state::State& s, const splitting::MergeRule& rule = {})
{
    Index merges = 0;
    for (Index more = 1; more > 0; merges += more)
        more = splitting::mergeParticles(s, rule, materials);
    return merges;
}

using Row = std::array<double, 8>;
std::map<std::int64_t, Row> byId(const Particles& p)
{
    std::map<std::int64_t, Row> out;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        out[p.id[i]] = {p.mass[i], p.volume0[i], p.length0[0][i], p.length0[1][i],
                        p.x[0][i], p.x[1][i],    p.F[0][i],       double(p.generation[i])};
    return out;
}

struct Sums
{
    double mass = 0, volume = 0, volume0 = 0, stress = 0;
    Vector3 centre{}, momentum{};
};
Sums sums(const Particles& p)
{
    Sums out;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        out.mass += p.mass[i];
        out.volume += p.volume[i];
        out.volume0 += p.volume0[i];
        out.stress += p.volume[i] * p.stress[0][i];
        for (int a = 0; a < p.dim; ++a)
        {
            out.centre[a] += p.mass[i] * p.x[a][i];
            out.momentum[a] += p.mass[i] * p.v[a][i];
        }
    }
    return out;
}

/// Two halves of one particle, side by side along x.
state::State halves()
{
    auto s = scenes::seedBlock({.corner = {2.1, 2.2}, .n = {2, 1, 1}, .spacing = 1, .h = 2, .cells = {10, 10, 1}});
    auto& p = s.particles;
    for (std::size_t i = 0; i < 2; ++i)
    {
        p.x[0][i] = 2.4 + 0.5 * double(i);
        p.length0[0][i] = 0.5;
        p.generation[i] = 1;
        p.mass[i] = i == 0 ? 400 : 600;
        p.volume0[i] = i == 0 ? 0.45 : 0.55;
        p.F[0][i] = i == 0 ? 0.9 : 1.05;
        p.F[1][i] = 0.1 * double(i);
        p.volume[i] = p.volume0[i] * p.F[0][i];
        p.v[0][i] = i == 0 ? 3 : -1;
        p.v[1][i] = i == 0 ? 0.5 : 2;
        p.stress[0][i] = i == 0 ? -4e3 : 1e3;
        p.stress[3][i] = 2e3 * double(i);
    }
    p.padLastChunk();
    return s;
}
} // namespace

TEST_CASE("a body that was split and pressed back is what it was, after one split and after a cascade")
{
    for (const int dim : {2, 3})
        for (const double factor : {2.6, 5.2})
        {
            CAPTURE(dim, factor);
            auto s = lattice(dim);
            const auto before = byId(s.particles);
            stretch(s, factor);
            const Index added = splitAll(s);
            CHECK(added == Index(before.size()) * ((factor > 3 ? (dim == 2 ? 16 : 64) : (dim == 2 ? 4 : 8)) - 1));
            CHECK(mergeAll(s) == 0); // edges are half of the threshold of splitting, and over that of merging
            stretch(s, 1 / factor);
            CHECK(mergeAll(s) == added);
            const auto after = byId(s.particles);
            REQUIRE(after.size() == before.size());
            for (const auto& [id, row] : before)
            {
                REQUIRE(after.count(id) == 1);
                for (std::size_t k = 0; k < row.size(); ++k)
                    CHECK(after.at(id)[k] == Approx(row[k]).epsilon(1e-13));
            }
            CHECK(s.ledger.merges == added);
            CHECK(std::abs(s.ledger.splitMergeLoss) < 1e-9);
        }
}

TEST_CASE("of two particles: sums are exact, energies and angular momentum are booked")
{
    auto s = halves();
    const auto before = sums(s.particles);
    stepping::beginLedger(s, materials);
    const auto t = stepping::totals(s, materials);
    const double kinetic = s.ledger.kineticEnergy;
    REQUIRE(mergeAll(s) == 1);
    REQUIRE(s.particles.size() == 1);
    const auto after = sums(s.particles);
    const auto& p = s.particles;
    CHECK(after.mass == before.mass);
    CHECK(after.volume0 == before.volume0);
    CHECK(after.volume == Approx(before.volume).epsilon(1e-15));
    CHECK(after.stress == Approx(before.stress).epsilon(1e-14));
    for (int a = 0; a < 2; ++a)
    {
        CHECK(after.centre[a] == Approx(before.centre[a]).epsilon(1e-14));
        CHECK(after.momentum[a] == Approx(before.momentum[a]).epsilon(1e-14));
    }
    CHECK(p.id[0] == 0);
    CHECK(p.length0[0][0] == 1);
    CHECK(p.length0[1][0] == 1);
    CHECK(p.generation[0] == 0);
    CHECK(p.F[0][0] * p.F[3][0] - p.F[1][0] * p.F[2][0] == Approx(p.volume[0] / p.volume0[0]).epsilon(1e-14));
    // mu |dv|^2/2, mu = 400 600/1000, dv = (4, -1.5); what is elastic is the energy of the mean stress less than the
    // mean
    const double lost = 0.5 * 240 * (16 + 2.25);
    CHECK(kinetic - s.ledger.kineticEnergy == Approx(lost).epsilon(1e-13));
    const double elastic = t.strainEnergy - stepping::totals(s, materials).strainEnergy;
    CHECK(elastic > 0);
    CHECK(s.ledger.splitMergeLoss == Approx(lost + elastic).epsilon(1e-13));
    stepping::Scene scene;
    scene.materials = materials;
    CHECK(treated::residual(s, scene) < 1e-12 * kinetic);
    CHECK(s.ledger.splitAngularMomentum == Approx(240 * 0.5 * 1.5).epsilon(1e-12)); // mu |dx x dv|, dx = (0.5, 0)
}

TEST_CASE("what does not belong together stays apart")
{
    const auto merges = [](auto&& change, splitting::MergeRule rule = {}) {
        auto s = halves();
        change(s);
        return splitting::mergeParticles(s, rule, {materials[0], materials[0]});
    };
    CHECK(merges([](auto&) {}) == 1);
    CHECK(merges([](auto& s) { s.particles.material[1] = 1; }) == 0);
    CHECK(merges([](auto& s) { s.particles.generation[1] = 0; }) == 0);
    CHECK(merges([](auto& s) { s.particles.length0[0][1] = 0.25; }) == 0);
    CHECK(merges([](auto& s) { s.particles.x[0][1] += 0.4; }) == 0); // a gap
    CHECK(merges([](auto& s) { s.particles.x[1][1] += 0.6; }) == 0); // beside it
    CHECK(merges([](auto& s) { s.grid.origin[0] = 0.6; }) == 0);     // another cell
    CHECK(merges([](auto& s) { s.particles.F[2][1] = 1.5; }) == 0);  // another shape
    CHECK(merges([](auto& s) { s.particles.F[0][1] = 1.25; }) == 0); // an edge over the threshold
    CHECK(merges([](auto&) {}, {.threshold = 0.4}) == 0);
    CHECK(merges([](auto& s) { s.seedSpacing[0] = 0.5; }) == 0); // they were seeded so
}

TEST_CASE("siblings come first, wherever particles lie in memory")
{
    // two families of a body whose cells hold parts of families
    auto s = lattice();
    stretch(s, 2.6);
    splitAll(s);
    stretch(s, 1 / 2.6);
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
        s.particles.v[0][i] = std::sin(double(s.particles.id[i])); // merges in another order would end elsewhere
    auto mixed = s;
    std::vector<Index> order;
    for (Index i = 0; i < s.particles.size(); ++i)
        order.push_back((i * 37 + 11) % s.particles.size());
    mixed.particles.permute(order);
    for (auto* of : {&s, &mixed})
        CHECK(splitting::mergeParticles(*of, {}, materials) == 32);
    CHECK(byId(s.particles) == byId(mixed.particles));
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
        CHECK(s.particles.length0[0][i] == 0.5); // along x first, all of them
}

TEST_CASE("drawn out and pushed back in a run: splits, then merges; the books close, a restart is bitwise")
{
    auto s = lattice();
    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
    {
        s.particles.v[0][i] = 2 * (s.particles.x[0][i] - 3);
        s.particles.v[1][i] = 0;
    }
    s.particles.keep(&Particles::family, false);
    stepping::Scene sc;
    sc.materials = {scenes::elastic(10, 0)};
    sc.splitting = splitting::Rule{};
    sc.splitting->threshold = 2.2;
    sc.merging = splitting::MergeRule{.threshold = 0.54};
    for (auto& x : s.particles.x[0])
        x += 6;
    const auto stepper = cases::makeStepper("uGIMP", s, sc);
    stepping::beginLedger(s, sc.materials);
    const double whole = s.ledger.initialKineticEnergy;
    for (int n = 0; n < 1100; ++n)
        stepper->step(1e-3);
    CHECK(s.ledger.splits >= 8);
    const Index split = s.particles.size();
    for (int a = 0; a < 2; ++a)
        for (auto& v : s.particles.v[a])
            v = -v;
    stepper->particlesChanged();
    const state::State turned = s;
    for (int n = 0; n < 1100; ++n)
        stepper->step(1e-3);
    CHECK(s.ledger.merges >= 24);
    CHECK(s.particles.size() == 16 + 3 * s.ledger.splits - s.ledger.merges);
    CHECK(s.particles.size() < split / 2);
    CHECK(stepping::totals(s, sc.materials).mass == Approx(16 * 250).epsilon(1e-14));
    CHECK(treated::residual(s, sc) < 1e-10 * whole);

    auto again = treated::run(turned, "uGIMP", sc, 1010, 1e-3);
    const tests::TemporaryFolder folder;
    output::writeState(folder.path() / "1", again);
    again = treated::run(output::readState(folder.path() / "1" / "state.h5"), "uGIMP", sc, 90, 1e-3);
    CHECK(again.ledger.merges == s.ledger.merges);
    CHECK(again.particles.x[0] == s.particles.x[0]);
    CHECK(again.particles.v[0] == s.particles.v[0]);
}

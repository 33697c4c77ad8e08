// Softening of Mohr-Coulomb and Tresca: closed forms, the implicit step, the band's energy, scenes with history.
#include "constitutive/tresca.hpp"
#include "output/stateFile.hpp"
#include "support/mohrCoulombStates.hpp"
#include "support/temporaryFolder.hpp"
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>
#include <cstring>

using namespace mpm;
using namespace mpm::test;
using constitutive::Softening;
using constitutive::updatePoint;

namespace
{
MohrCoulombParameters softened(MohrCoulombParameters p, const Softening& s)
{
    p.softening = s;
    return p;
}

/// Everything falls: cohesion, friction and dilation.
const MohrCoulombParameters all = softened({{20e6, 0.3}, 10e3, 35, 10}, {0.002, 0.05, 2e3, 25, 0, 0.5}),
                            cohesive = softened({{20e6, 0.3}, 10e3, 0, 0}, {0.001, 0.02, 4e3, 0, 0, 0.5}),
                            sand = softened({{20e6, 0.42}, 0, 42, 0}, {0, 0.1, 0, 30, 0, 0.5});

MohrCoulombParameters at(MohrCoulombParameters p, double kappa)
{
    const Softening s = *p.softening;
    const double w = std::clamp((kappa - s.from) / s.over, 0.0, 1.0);
    p.cohesion += w * (s.cohesion - p.cohesion);
    p.frictionAngle += w * (s.frictionAngle - p.frictionAngle);
    p.dilationAngle += w * (s.dilationAngle - p.dilationAngle);
    p.softening.reset();
    return p;
}

/// sqrt(2/3) |dev C^-1 (trial - end)|.
double equivalentStrain(const MohrCoulombParameters& p, const SymmetricTensor& trial, const SymmetricTensor& end)
{
    const Eigen::Matrix3d lost = matrix(trial) - matrix(end);
    return std::sqrt(2.0 / 3) * (lost - lost.trace() / 3 * Eigen::Matrix3d::Identity()).norm() / (2 * p.moduli.shear());
}
} // namespace

TEST_CASE("cohesion that falls in simple shear: the closed form at any number of steps")
{
    // tau = G (gamma - gamma_p), kappa = scale gamma_p/sqrt 3, tau = c(kappa)
    const auto& s = *cohesive.softening;
    const double G = cohesive.moduli.shear();
    for (const double h : {0.5, 0.1})
    {
        constitutive::Tresca law(cohesive);
        law.regularise(h);
        CHECK(law.usesHistory());
        const double scale = h / s.referenceLength, slope = (cohesive.cohesion - s.cohesion) / s.over;
        for (const int n : {1, 7, 300})
            for (const double gamma : {0.0005, 0.003, 0.02, 0.5})
            {
                SymmetricTensor stress{};
                double kappa = 0;
                for (int i = 0; i < n; ++i)
                {
                    const auto out = updatePoint(law, stress, {0, 0, 0, 0.5 * gamma / n, 0, 0}, {}, kappa);
                    stress = out.stress;
                    kappa = out.plasticStrain;
                }
                const double peak = cohesive.cohesion / G, perStrain = scale / std::sqrt(3.0);
                double tau = G * gamma, plastic = 0;
                if (gamma > peak)
                {
                    const double flat = gamma - peak; // at the peak, then on the slope, then on the residual
                    const double toSlope = s.from / perStrain, toEnd = (s.from + s.over) / perStrain;
                    // G (gamma - g) = c - slope (perStrain g - from)
                    const double onSlope = (G * gamma - cohesive.cohesion - slope * s.from) / (G - slope * perStrain);
                    plastic = flat <= toSlope ? flat : onSlope <= toEnd ? onSlope : gamma - s.cohesion / G;
                    tau = G * (gamma - plastic);
                }
                INFO("h " << h << ", " << n << " steps, gamma " << gamma);
                CHECK(stress[3] == Approx(tau).epsilon(2e-9));
                CHECK(kappa == Approx(perStrain * plastic).margin(2e-9));
            }
    }
}

TEST_CASE("the step is implicit: stress on the surface of the kappa that is kept, kappa from the strain of that return")
{
    std::mt19937_64 random(41);
    std::uniform_real_distribution<double> uniform(0, 1);
    double worst = 0, worstGrowth = 0, worstYield = 0, worstWork = 0;
    int yielded = 0, softening = 0;
    auto noTension = all;
    noTension.tensionCutOff = 100;
    for (const auto& p : {all, cohesive, sand, noTension})
    {
        const double scale = 0.25 / p.softening->referenceLength;
        MohrCoulomb law(p);
        law.regularise(0.25);
        for (int i = 0; i < 500; ++i)
        {
            const double kappa = 1.2 * (p.softening->from + p.softening->over) * std::max(0.0, uniform(random) - 0.2);
            // a stress inside the present surface, and a step
            const Eigen::Matrix3d axes = randomAxes(random);
            const auto start =
                constitutive::returnMap(MohrCoulomb(at(p, kappa)),
                                        tensor(axes * randomTrial(p, random).asDiagonal() * axes.transpose()))
                    .stress;
            SymmetricTensor strain;
            for (double& e : strain)
                e = 2e-3 * (uniform(random) - 0.5);
            const auto trial = updatePoint(constitutive::LinearElastic(p.moduli), start, strain).stress;
            const auto out = updatePoint(law, start, strain, {}, kappa);
            const auto now = at(p, out.plasticStrain);
            const double size = std::max({largest(trial), largest(start), strength(p)});
            const auto expected = constitutive::returnMap(MohrCoulomb(now), trial);
            if (out.region == Region::elastic)
            {
                CHECK(out.stress == trial);
                CHECK(out.plasticStrain == kappa);
                continue;
            }
            ++yielded;
            softening += at(p, kappa).cohesion > p.softening->cohesion && out.plasticStrain > p.softening->from;
            worst = std::max(worst, distance(out.stress, expected.stress) / size);
            worstYield = std::max(worstYield, yieldOf(now, out.stress));
            worstGrowth = std::max(
                worstGrowth, std::abs(out.plasticStrain - kappa - scale * equivalentStrain(p, trial, out.stress)) /
                                 (scale * equivalentStrain(p, trial, out.stress)));
            CHECK(out.region == expected.region);
            const double before =
                             constitutive::elasticEnergyDensity<3>(*reinterpret_cast<const double(*)[6]>(start.data()),
                                                                   law.bulkModulus(), law.shearModulus()),
                         after = constitutive::elasticEnergyDensity<3>(
                             *reinterpret_cast<const double(*)[6]>(out.stress.data()), law.bulkModulus(),
                             law.shearModulus());
            const double work = (0.5 * (matrix(start) + matrix(out.stress))).cwiseProduct(matrix(strain)).sum();
            worstWork = std::max(worstWork, std::abs(work - (after - before) - out.plasticWork) /
                                                (size * size / p.moduli.shear()));
        }
    }
    std::printf("%d yield, %d soften: stress %.1e, f %.1e, growth of kappa %.1e, work %.1e\n", yielded, softening,
                worst, worstYield, worstGrowth, worstWork);
    CHECK(yielded >= 400);
    CHECK(softening >= 150);
    CHECK(worst <= 1e-12);
    CHECK(worstYield <= 1e-12);
    CHECK(worstGrowth <= 1e-3);
    CHECK(worstWork <= 1e-12);
}

TEST_CASE("a slip plane takes the same energy per area on every grid, and not without the cell size")
{
    // beyond the residual strength over the slip: the triangle of c over gamma_p = sqrt 3 kappa/scale, times the width
    // h
    const auto& s = *cohesive.softening;
    const double slip = 0.2;
    const auto energy = [&](double h, double reference) {
        auto p = cohesive;
        p.softening->referenceLength = reference;
        constitutive::Tresca law(p);
        law.regularise(h);
        SymmetricTensor stress{};
        double kappa = 0, work = 0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i)
        {
            const auto out = updatePoint(law, stress, {0, 0, 0, 0.5 * slip / h / steps, 0, 0}, {}, kappa);
            stress = out.stress;
            kappa = out.plasticStrain;
            work += out.plasticWork * h;
        }
        const double plasticSlip = slip - h * s.cohesion / p.moduli.shear();
        return work - s.cohesion * plasticSlip;
    };
    const double perArea = (cohesive.cohesion - s.cohesion) * (s.from + 0.5 * s.over) * std::sqrt(3.0);
    for (const double h : {0.4, 0.1, 0.025})
    {
        CHECK(energy(h, 0.1) == Approx(perArea * 0.1).epsilon(5e-3));
        CHECK(energy(h, h) == Approx(perArea * h).epsilon(5e-3));
    }
}

TEST_CASE("residual values equal to the peak are no softening; far from yielding and far beyond it the plain law holds")
{
    const auto read = [](const std::string& words) {
        return constitutive::makeLaw(dictionary::Dictionary::fromText(
            "law mohrCoulomb; E 20e6; nu 0.3; cohesion 10e3; frictionAngle 35; dilationAngle 10; " + words));
    };
    const auto none = read(""), same = read("softening { over 0.1; referenceLength 0.1; }");
    CHECK_FALSE(same->usesHistory());
    CHECK(same->describe() == none->describe());
    const auto falls =
        read("softening { from 0.002; over 0.05; cohesion 2e3; frictionAngle 25; referenceLength 0.5; }");
    CHECK(falls->usesHistory());
    CHECK(falls->dilates());
    CHECK_FALSE(falls->dropsApexVolume());
    CHECK(read("softening { over 0.05; frictionAngle 20; dilationAngle 0; referenceLength 0.5; }")->dropsApexVolume());
    std::mt19937_64 random(43);
    for (int i = 0; i < 200; ++i)
    {
        const Eigen::Matrix3d axes = randomAxes(random);
        const auto trial = tensor(axes * randomTrial(all, random).asDiagonal() * axes.transpose());
        CHECK(constitutive::returnMap(*same, trial).stress == constitutive::returnMap(*none, trial).stress);
        auto late = all, early = all;
        late.softening->from = 1e9;
        const double size = largest(trial);
        CHECK(distance(constitutive::returnMap(MohrCoulomb(late), trial).stress,
                       constitutive::returnMap(*none, trial).stress) <= 1e-14 * size);
        const auto residual = at(all, 1e9);
        CHECK(distance(updatePoint(MohrCoulomb(early), trial, {}, {}, 1.0).stress,
                       constitutive::returnMap(MohrCoulomb(residual), trial).stress) <= 1e-14 * size);
    }
    using Catch::Matchers::Contains;
    CHECK_THROWS_WITH(read("softening { over 0.1; cohesion 20e3; referenceLength 1; }"),
                      Contains("cohesion") && Contains("10000"));
    CHECK_THROWS_WITH(read("softening { over 0; referenceLength 1; }"), Contains("over") && Contains("> 0"));
    CHECK_THROWS_WITH(read("softening { over 0.1; }"), Contains("referenceLength"));
    CHECK_THROWS_WITH(read("softening { over 0.1; cohesion 1; referenceLength 1; } substep { tolerance 1e-3; }"),
                      Contains("substep") && Contains("softening"));
    CHECK_THROWS_AS(MohrCoulomb(softened(paper, {0, 0.1, 2e3, 42, 0, 1})), InputError);
    CHECK_THROWS_AS(MohrCoulomb(sand, constitutive::Substep{1e-3}), InputError);
}

TEST_CASE("strength that falls faster than stress can be unloaded is lost over a few steps, with dissipation")
{
    auto brittle = cohesive;
    brittle.softening->over = 1e-6;
    brittle.softening->from = 0;
    constitutive::Tresca law(brittle);
    SymmetricTensor stress{};
    double kappa = 0, last = 0;
    int steps = 0;
    const double de = 0.5e-5;
    for (int i = 0; i < 400; ++i)
    {
        const auto out = updatePoint(law, stress, {0, 0, 0, de, 0, 0}, {}, kappa);
        CHECK(out.plasticStrain >= kappa);
        CHECK(out.plasticWork >= -1e-12);
        CHECK(out.yield <= 1e-12);
        steps += out.plasticStrain > 0 && out.stress[3] > brittle.softening->cohesion * (1 + 1e-9);
        stress = out.stress;
        kappa = out.plasticStrain;
        last = stress[3];
    }
    CHECK(last == Approx(brittle.softening->cohesion).epsilon(1e-12));
    CHECK(steps <= 5);
}

TEST_CASE("lanes do not know of each other")
{
    std::mt19937_64 random(47);
    Chunk<3> chunk, turned;
    for (int l = 0; l < lanes; ++l)
    {
        const Eigen::Matrix3d axes = randomAxes(random);
        const auto s = tensor(axes * (0.3 * test::randomTrial(all, random)).asDiagonal() * axes.transpose());
        fill(chunk, l, s, {1e-4 * l, -1e-4 * l, 0, 2e-5, 0, 0});
        chunk.plasticStrain[l] = 1e-3 * l;
        fill(turned, 63 - l, s, {1e-4 * l, -1e-4 * l, 0, 2e-5, 0, 0});
        turned.plasticStrain[63 - l] = 1e-3 * l;
    }
    MohrCoulomb(all).update(chunk);
    MohrCoulomb(all).update(turned);
    for (int l = 0; l < lanes; ++l)
    {
        CHECK(chunk.plasticStrain[l] == turned.plasticStrain[63 - l]);
        CHECK(stressOf(chunk, l) == stressOf(turned, 63 - l));
    }
}

// Scenes --------------------------------------------------------------------------------------------------------------

namespace
{
using namespace treated;

/// A block that falls apart: thrown about without order.
state::State thrown(int dim)
{
    auto s = block(dim);
    auto& p = s.particles;
    for (int k = 0; k < 3; ++k)
        std::fill(p.stress[std::size_t(k)].begin(), p.stress[std::size_t(k)].end(), -2e3);
    stir(s, 1.0);
    return s;
}

constitutive::Material material(const MohrCoulombParameters& p, double h = 1)
{
    auto law = std::make_shared<MohrCoulomb>(p);
    law->regularise(h);
    return {"solid", 1000, law};
}

const MohrCoulombParameters weak = softened({{1e6, 0.3}, 1e3, 30, 5}, {0.001, 0.05, 200, 20, 0, 1});
} // namespace

TEST_CASE("particles carry the history, the budget closes, and laws without history carry none")
{
    for (const int dim : {2, 3})
        for (const StressUpdate update : updates)
        {
            const auto s = scene(material(weak), {}, update);
            const auto end = run(thrown(dim), "uGIMP", s, 120, 2e-3);
            const auto& p = end.particles;
            REQUIRE(p.has(&state::Particles::plasticStrain));
            const auto column = p.plasticStrain;
            CHECK(*std::max_element(column.begin(), column.end()) > 0.06);
            CHECK(*std::min_element(column.begin(), column.end()) >= 0);
            const double dissipated = end.ledger.plasticDissipation;
            CHECK(dissipated > 0);
            CHECK(residual(end, s) <= 1e-9 * end.ledger.initialKineticEnergy);
            auto strong = weak;
            strong.softening.reset();
            const auto plain = run(thrown(dim), "uGIMP", scene(material(strong), {}, update), 120, 2e-3);
            CHECK_FALSE(plain.particles.has(&state::Particles::plasticStrain));
        }
}

TEST_CASE("two materials in one chunk: alike they are one, and each has its own history")
{
    const auto one = scene(material(weak), {});
    auto two = one;
    two.materials = {material(weak), material(weak)};
    const auto split = [](state::State s) {
        for (std::size_t i = 0; i < s.particles.material.size(); ++i)
            s.particles.material[i] = std::int32_t(s.particles.id[i] % 2);
        s.particles.padLastChunk();
        s.materials = {"solid", "other"};
        return s;
    };
    const auto a = run(thrown(2), "uGIMP", one, 100, 2e-3), b = run(split(thrown(2)), "uGIMP", two, 100, 2e-3);
    const auto same = [](const auto& x, const auto& y) { return std::equal(x.begin(), x.end(), y.begin(), y.end()); };
    CHECK(same(a.particles.plasticStrain, b.particles.plasticStrain));
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(same(a.particles.stress[k], b.particles.stress[k]));
    CHECK(same(a.particles.x[0], b.particles.x[0]));
    CHECK(a.ledger.plasticDissipation == b.ledger.plasticDissipation);

    // beside a law without history
    auto strong = weak;
    strong.softening.reset();
    two.materials[1] = material(strong);
    const auto c = run(split(thrown(2)), "uGIMP", two, 100, 2e-3);
    double most = 0;
    for (std::size_t i = 0; i < std::size_t(c.particles.size()); ++i)
        if (c.particles.material[i] == 1)
            CHECK(c.particles.plasticStrain[i] == 0);
        else
            most = std::max(most, c.particles.plasticStrain[i]);
    CHECK(most > 0.01);
}

TEST_CASE("children of a split keep the history, and a restart goes on to the last bit")
{
    auto s = scene(material(weak), {});
    auto start = run(thrown(2), "uGIMP", s, 40, 2e-3);
    const auto& p = start.particles;
    const auto most = std::size_t(std::max_element(p.plasticStrain.begin(), p.plasticStrain.begin() + p.size()) -
                                  p.plasticStrain.begin());
    const double kappa = p.plasticStrain[most];
    REQUIRE(kappa > 0);
    auto cut = start;
    cut.particles.F[0][most] = 5; // one long particle
    splitting::Rule rule;
    rule.threshold = 2.5;
    const auto outcome = splitting::splitParticles(cut, rule, {});
    CHECK(outcome.split == 1);
    for (std::size_t i = std::size_t(p.size()); i < std::size_t(cut.particles.size()); ++i)
        CHECK(cut.particles.plasticStrain[i] == kappa);
    CHECK(cut.particles.plasticStrain[most] == kappa);

    const tests::TemporaryFolder folder;
    output::writeState(folder.path(), start);
    auto again = output::readState(folder.path() / "state.h5");
    CHECK(again.particles.has(&state::Particles::plasticStrain));
    const auto a = run(start, "uGIMP", s, 40, 2e-3), b = run(again, "uGIMP", s, 40, 2e-3);
    CHECK(std::equal(a.particles.plasticStrain.begin(), a.particles.plasticStrain.end(),
                     b.particles.plasticStrain.begin()));
    CHECK(std::equal(a.particles.stress[0].begin(), a.particles.stress[0].end(), b.particles.stress[0].begin()));
}

// The tension gap: one point in closed form, a body pulled apart and pushed together, and what the column takes part
// in.
#include "treatment/tensionGap.hpp"
#include "output/stateFile.hpp"
#include "support/temporaryFolder.hpp"
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace treated;

namespace
{
struct Step
{
    double pressure, gap, apexStrain, gapWork, plasticWork;
};

/// One point of Mohr-Coulomb soil, driven by volumetric strain and, if asked, shear.
template <int dim>
class Point
{
  public:
    Point(const constitutive::Material& material, bool withGap, double pressure)
        : law_(*material.law), withGap_(withGap)
    {
        for (int l = 0; l < lanes; ++l)
            for (int k = 0; k < stressSize<dim>; ++k)
                chunk_.stress[k][l] = k < 3 ? pressure : 0;
        std::fill_n(open_.gap, lanes, 0.0);
    }

    Step go(double volume, double shear = 0)
    {
        for (int l = 0; l < lanes; ++l)
            for (int k = 0; k < stressSize<dim>; ++k)
                chunk_.dStrain[k][l] = k < 3 ? volume / 3 : shear;
        const bool open = open_.gap[0] > 0;
        open_.work[0] = 0;
        if (withGap_)
            treatment::openGap(chunk_, open_, open);
        law_.update(chunk_);
        if (withGap_ && (open || chunk_.apexReturns > 0)) // as the step does
            treatment::closeGap(chunk_, open_);
        for (int k = 0; k < 3; ++k)
            CHECK(chunk_.dStrain[k][0] == volume / 3);
        return {treatment::meanStress(chunk_, 0), open_.gap[0], chunk_.apexStrain[0], open_.work[0],
                chunk_.plasticWork[0]};
    }

  private:
    const constitutive::Law& law_;
    bool withGap_;
    constitutive::Chunk<dim> chunk_;
    treatment::OpenGap open_;
};

/// Volumetric strain of a cycle: compressed, drawn out, compressed again, back where it began.
double path(int n, int steps)
{
    const double t = double(n) / steps;
    return 4e-3 * std::sin(2 * M_PI * t) * (1 + t * (1 - t));
}

template <int dim>
void cycle(double cohesion)
{
    const double friction = 35, start = -3e3;
    const auto sand = soil(10e6, 0.25, cohesion, friction);
    const double K = sand.law->bulkModulus(), apex = cohesion / std::tan(friction * M_PI / 180);
    const double opens = (apex - start) / K; // volumetric strain at which the apex is reached
    Point<dim> with(sand, true, start), without(sand, false, start);
    const int steps = 400;
    double lastGap = 0, gapWork = 0, work = 0, pressure = start;
    double spurious = 0;
    for (int n = 1; n <= steps; ++n)
    {
        const double dv = path(n, steps) - path(n - 1, steps), v = path(n, steps);
        const Step s = with.go(dv);
        CHECK(s.pressure == Approx(start + K * std::min(v, opens)).margin(1e-8 * K * 4e-3));
        CHECK(s.gap == Approx(std::max(0.0, v - opens)).margin(1e-15));
        CHECK(s.apexStrain == Approx(s.gap - lastGap).margin(1e-17));
        CHECK(s.gapWork == Approx(0.5 * (pressure + s.pressure) * (s.gap - lastGap)).margin(1e-12 * K * 4e-3));
        CHECK(std::abs(s.plasticWork) < 1e-12 * K * 4e-3 * 4e-3);
        // what the step was given is stored in the soil or in the gap
        CHECK(0.5 * (pressure + s.pressure) * dv ==
              Approx((s.pressure * s.pressure - pressure * pressure) / (2 * K) + s.gapWork).margin(1e-10));
        gapWork += s.gapWork;
        work += 0.5 * (pressure + s.pressure) * dv;
        lastGap = s.gap;
        pressure = s.pressure;
        spurious = without.go(dv).pressure;
    }
    const double step = 4e-3 * 2 * M_PI * 1.25 / steps; // the steps that open and close are cut in other places
    CHECK(std::abs(gapWork) < 0.5 * K * step * step);
    CHECK(work == Approx(gapWork).margin(1e-9));
    CHECK(pressure == Approx(start).epsilon(1e-9));
    CHECK(lastGap == 0);
    double most = 0; // of the path
    for (int n = 0; n <= steps; ++n)
        most = std::max(most, path(n, steps));
    CHECK(spurious == Approx(start - K * (most - opens)).epsilon(1e-9));
}
} // namespace

TEST_CASE("a point that opens, closes and is compressed follows one line, and its gap gives back all it took")
{
    for (const double cohesion : {0.0, 2e3})
    {
        CAPTURE(cohesion);
        cycle<2>(cohesion);
        cycle<3>(cohesion);
    }
}

TEST_CASE("energy that opens a gap against cohesion comes back exactly on the same way")
{
    const auto clay = soil(10e6, 0.25, 5e3, 30);
    Point<3> point(clay, true, 0);
    double sum = 0, most = 0;
    for (int n = 0; n < 200; ++n)
    {
        sum += point.go(n < 100 ? 5e-5 : -5e-5).gapWork;
        most = std::max(most, sum);
    }
    const double apex = 5e3 / std::tan(30 * M_PI / 180), g = 100 * 5e-5 - apex / clay.law->bulkModulus();
    CHECK(most == Approx(apex * g).epsilon(0.02)); // the step that opens it has half the stress
    CHECK(std::abs(sum) < 1e-12 * most);
}

TEST_CASE("shear of open soil changes no gap, and no gap ever lets a stress out of the cone")
{
    const auto sand = soil(10e6, 0.25, 0, 35);
    const double K = sand.law->bulkModulus();
    Point<3> point(sand, true, -1e3);
    double v = 0;
    for (int n = 0; n < 300; ++n)
    {
        const double dv = 2e-5 * (std::sin(0.05 * n) + 0.3 * std::sin(1.3 * n));
        v += dv;
        const Step s = point.go(dv, v > 2e3 / K ? 1e-4 * std::sin(2.0 * n) : 0);
        CHECK(s.gap == Approx(std::max(0.0, v - 1e3 / K)).margin(1e-14));
        CHECK(s.pressure <= 1e-9);
    }
}

namespace
{
/// Volume over what it was, after cycles that draw a block of sand out by 1 % a time, push it together and leave it.
double volumeAfterCycles(const std::string& shape, bool gap, int cycles)
{
    auto s = scenes::seedBlock({.corner = {2, 2, 0}, .n = {16, 16, 1}, .spacing = 0.5, .h = 1, .cells = {12, 12, 1}});
    StressTreatment t;
    t.tensionGap = gap;
    auto sc = scene(soil(1e6, 0.3, 0, 35), t);
    sc.relaxationTime = 0.05;
    auto stepper = cases::makeStepper(shape, s, sc);
    auto& p = s.particles;
    const double dt = 4e-3;
    for (int c = 0; c < cycles; ++c)
        for (int n = 0; n < 300; ++n)
        {
            if (n <= 100) // driven; then left alone
            {
                const double rate = n < 50 ? 0.05 : n < 100 ? -0.05 : 0;
                for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
                    for (int a = 0; a < 2; ++a)
                        p.v[a][i] = rate * (p.x[a][i] - 6);
                stepper->particlesChanged();
            }
            stepper->step(dt);
        }
    double volume = 0, seeded = 0;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        volume += p.volume[i];
        seeded += p.volume0[i];
    }
    return volume / seeded;
}
} // namespace

TEST_CASE("a body pulled apart and pushed together keeps its volume with gaps and grows without")
{
    for (const std::string shape : {"uGIMP", "cpGIMP", "CPDI", "quadraticBSpline"})
    {
        CAPTURE(shape);
        CHECK(std::abs(volumeAfterCycles(shape, true, 2) - 1) < 1e-3);
        CHECK(volumeAfterCycles(shape, false, 2) > 1.01);
    }
}

TEST_CASE("gaps close the budget in every shape and order of the step")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapes)
            for (const auto update : updates)
                for (const double cohesion : {0.0, 1e3})
                {
                    CAPTURE(dim, shape, int(update), cohesion);
                    StressTreatment t;
                    t.tensionGap = true;
                    auto sc = scene(soil(1e6, 0.3, cohesion, 30), t, update);
                    auto s = block(dim);
                    stir(s, 2);
                    s = run(s, shape, sc, 25, 4e-3);
                    const auto total = stepping::totals(s, sc.materials);
                    CHECK(residual(s, sc) < 1e-11 * total.mass);
                    CHECK(std::abs(s.ledger.gapWork) > 1e-8 * total.mass);
                    double open = 0;
                    for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
                        open = std::max(open, double(s.particles.tensionGap[i]));
                    CHECK(open > 1e-4);
                    CHECK(s.ledger.apexVolume > 0);
                }
}

TEST_CASE("children of a split are as open as their parent")
{
    for (const int dim : {2, 3})
    {
        auto s = block(dim);
        auto& p = s.particles;
        p.keep(&state::Particles::tensionGap, true);
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            p.tensionGap[i] = 1e-3 * double(i);
            p.F[0][i] = i % 3 == 0 ? 4 : 1;
            p.volume[i] = p.volume0[i] * double(p.F[0][i]);
        }
        p.padLastChunk();
        const Index before = p.size();
        double open = 0, after = 0;
        for (std::size_t i = 0; i < std::size_t(before); ++i)
            open += p.tensionGap[i] * p.volume[i];
        const auto done = splitting::splitParticles(s, {.threshold = 2.5}, {});
        CHECK(done.split == before / 3);
        REQUIRE(p.tensionGap.size() >= std::size_t(p.size()));
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
            after += p.tensionGap[i] * p.volume[i];
        CHECK(after == Approx(open).epsilon(1e-13));
    }
}

TEST_CASE("columns of a treatment come back from a file, are absent without it, and go when another run has none")
{
    tests::TemporaryFolder folder;
    for (const int dim : {2, 3})
    {
        auto s = block(dim);
        output::writeState(folder / "0", s);
        const auto plain = output::readState(folder / "0/state.h5");
        CHECK_FALSE(plain.particles.has(&state::Particles::tensionGap));
        CHECK_FALSE(plain.particles.has(&state::Particles::dilationRate));
        CHECK_FALSE(plain.particles.has(&state::Particles::viscousStress));
        auto& p = s.particles;
        p.keep(&state::Particles::tensionGap, true);
        p.keep(&state::Particles::dilationRate, true);
        p.keep(&state::Particles::viscousStress, true);
        for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
        {
            p.tensionGap[i] = 1e-3 / double(i + 1);
            p.dilationRate[i] = std::sin(double(i));
            p.viscousStress[i] = std::cos(double(i));
        }
        p.padLastChunk();
        output::writeState(folder / "1", s);
        auto back = output::readState(folder / "1/state.h5");
        REQUIRE(back.particles.has(&state::Particles::tensionGap));
        REQUIRE(back.particles.has(&state::Particles::dilationRate));
        CHECK(back.particles.tensionGap == p.tensionGap);
        CHECK(back.particles.dilationRate == p.dilationRate);
        CHECK(back.particles.viscousStress == p.viscousStress);
        const auto left = run(back, "uGIMP", scene(scenes::elastic(1e6, 0.3), {}), 1, 1e-3);
        CHECK_FALSE(left.particles.has(&state::Particles::tensionGap));
        CHECK_FALSE(left.particles.has(&state::Particles::dilationRate));
        CHECK_FALSE(left.particles.has(&state::Particles::viscousStress));
    }
}

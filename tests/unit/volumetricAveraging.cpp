// Volumetric averaging in the whole step: what it must leave alone, what it must make equal, and its books.
#include "support/treatmentScenes.hpp"

#include <catch2/catch.hpp>
#include <map>

using namespace mpm;
using namespace treated;

namespace
{
struct Kind
{
    AveragingRegion region;
    int repeats;
    AveragedPart of;
    bool conjugate;
    double viscosity = 0;
};
const std::vector<Kind> kinds = {{AveragingRegion::cell, 1, AveragedPart::total, false},
                                 {AveragingRegion::cell, 1, AveragedPart::total, true},
                                 {AveragingRegion::patch, 2, AveragedPart::total, false},
                                 {AveragingRegion::patch, 4, AveragedPart::total, true},
                                 {AveragingRegion::patch, 3, AveragedPart::elastic, false},
                                 {AveragingRegion::cell, 1, AveragedPart::total, true, 0.1},
                                 {AveragingRegion::patch, 1, AveragedPart::total, false, 0.3}};

StressTreatment treatmentOf(const Kind& k)
{
    auto t = averaged(k.region, k.repeats, k.of, k.conjugate);
    t.averaging->viscosity = k.viscosity;
    return t;
}

/// Random motion of a free block with gravity; the state after some swings of its smallest waves.
state::State shaken(int dim, const std::string& shape, const stepping::Scene& scene, double speed)
{
    auto s = block(dim);
    stir(s, speed);
    return run(s, shape, scene, 15, 4e-3);
}
} // namespace

TEST_CASE("the budget closes to round-off and momentum is kept, of every average, shape and order of the step")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapes)
            for (const auto update : updates)
                for (const auto& kind : kinds)
                {
                    CAPTURE(dim, shape, int(update), int(kind.region), kind.repeats, int(kind.of), kind.conjugate);
                    auto sc = scene(scenes::elastic(1e6, 0.45), treatmentOf(kind), update);
                    sc.gravity = Vector3{0.3, -0.2, 0};
                    const auto s = shaken(dim, shape, sc, 1);
                    const auto t = stepping::totals(s, sc.materials);
                    CHECK(residual(s, sc) < 1e-11 * t.mass);
                    for (int a = 0; a < 2; ++a)
                        CHECK(std::abs(t.momentum[a] - s.ledger.initialMomentum[a] - s.ledger.gravityImpulse[a]) <
                              1e-12 * t.mass);
                    CHECK((s.ledger.viscosityLoss != 0) == (kind.viscosity > 0));
                    if (kind.viscosity > 0) // motion no average sees dies out
                        CHECK(s.ledger.viscosityLoss > 1e-4 * t.mass);
                    if (kind.conjugate)
                        CHECK(s.ledger.averagingLoss == 0);
                    else // a body whose strains differ from those its forces work on exchanges that work
                        CHECK(std::abs(s.ledger.averagingLoss) > 1e-8 * t.mass);
                }
}

TEST_CASE("flow rules close the budget too, dilating ones where forces are conjugate or the elastic part is averaged")
{
    for (const int dim : {2, 3})
        for (const std::string shape : {"uGIMP", "CPDI", "quadraticBSpline"})
            for (const auto update : updates)
                for (const auto& kind : kinds)
                    for (const double dilation : {0.0, 15.0})
                    {
                        if (dilation > 0 && kind.of == AveragedPart::total && !kind.conjugate)
                            continue;
                        CAPTURE(dim, shape, int(update), int(kind.region), kind.repeats, int(kind.of), kind.conjugate);
                        const auto sc = scene(soil(1e6, 0.3, 2e3, 30, dilation), treatmentOf(kind), update);
                        const auto s = shaken(dim, shape, sc, 1);
                        const auto t = stepping::totals(s, sc.materials);
                        CHECK(residual(s, sc) < 1e-11 * t.mass);
                        CHECK(s.ledger.plasticDissipation > 1e-3 * t.mass);
                        if (kind.conjugate)
                            CHECK(s.ledger.averagingLoss == 0);
                    }
}

TEST_CASE("a uniform dilation is what it was: strains and stresses inside a body")
{
    // reach: how far from the surface a particle's gradient is that of a linear field, in cells
    const std::map<std::string, double> reach = {{"linear", 2}, {"uGIMP", 2.5},          {"cpGIMP", 2.5},
                                                 {"CPDI", 2.5}, {"quadraticBSpline", 3}, {"cubicBSpline", 4}};
    for (const int dim : {2, 3}) // along x and y in 2D; along x in 3D, periodic across
        for (const auto& [shape, disturbed] : reach)
            for (const auto& kind : kinds)
            {
                CAPTURE(dim, shape, int(kind.region), kind.repeats, int(kind.of), kind.conjugate);
                const Index n = 40;
                auto s = dim == 2
                             ? scenes::seedBlock(
                                   {.corner = {2, 2, 0}, .n = {n, n, 1}, .spacing = 0.5, .h = 1, .cells = {24, 24, 1}})
                             : scenes::seedBlock({.dim = 3,
                                                  .corner = {2, 0, 0},
                                                  .n = {n, 6, 6},
                                                  .spacing = 0.5,
                                                  .h = 1,
                                                  .cells = {24, 3, 3}});
                s.grid.periodic = {false, dim == 3, dim == 3};
                const int free = dim == 2 ? 2 : 1;
                for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
                    for (int a = 0; a < free; ++a)
                        s.particles.v[a][i] = 0.7 * s.particles.x[a][i];
                s.particles.padLastChunk();
                const auto plain = run(s, shape, scene(scenes::elastic(1e6, 0.3), {}), 1, 1e-3);
                const auto with = run(s, shape, scene(scenes::elastic(1e6, 0.3), treatmentOf(kind)), 1, 1e-3);
                const auto &p = plain.particles, &q = with.particles;
                const auto order = byId(q);
                std::size_t inside = 0;
                double strain = 0, stress = 0, right = 0;
                for (const std::size_t i : byId(p))
                {
                    const std::size_t j = order[std::size_t(p.id[i])];
                    bool deep = true;
                    for (int a = 0; a < free; ++a)
                        deep = deep && std::abs(p.x[a][i] - 12) < 10 - disturbed - 1 - kind.repeats;
                    if (!deep)
                        continue;
                    ++inside;
                    for (int k = 0; k < dim * dim; ++k)
                        strain = std::max(strain, std::abs(double(p.F[k][i]) - double(q.F[k][j])));
                    for (int k = 0; k < stressComponents(dim); ++k)
                        stress = std::max(stress, std::abs(double(p.stress[k][i]) - double(q.stress[k][j])));
                    right = std::max(right, std::abs(double(q.F[0][j]) - 1 - 0.7e-3));
                }
                CHECK(inside > 0);
                CHECK(strain < 1e-14);
                CHECK(stress < 1e-8); // of 1500 Pa
                CHECK(right < 1e-6);
            }
}

TEST_CASE("the average of a cell keeps the body's change of volume and makes that of its particles equal")
{
    for (const int dim : {2, 3})
        for (const auto& shape : shapes)
            for (const auto update : updates)
            {
                CAPTURE(dim, shape, int(update));
                const double dt = 1e-7; // what is of second order in dt |L| stays below 1e-5
                auto s = block(dim);
                stir(s, 1);
                const auto material = scenes::elastic(1e6, 0.499);
                const auto plain = run(s, shape, scene(material, {}, update), 1, dt);
                const auto with = run(s, shape, scene(material, averaged(AveragingRegion::cell, 1), update), 1, dt);
                const auto grown = [&](const state::State& of) {
                    double sum = 0;
                    for (std::size_t i = 0; i < std::size_t(of.particles.size()); ++i)
                        sum += of.particles.volume[i] - of.particles.volume0[i];
                    return sum / dt;
                };
                CHECK(grown(with) == Approx(grown(plain)).margin(1e-5));
                const auto widest = [&](const state::State& of) { // of pressures within a cell
                    std::map<std::array<Index, 3>, std::array<double, 2>> range;
                    for (std::size_t i = 0; i < std::size_t(of.particles.size()); ++i)
                    {
                        std::array<Index, 3> cell{};
                        for (int a = 0; a < dim; ++a)
                            cell[std::size_t(a)] = Index(std::floor(of.particles.x[a][i]));
                        const double p = meanStress(of.particles, i);
                        auto& r = range.try_emplace(cell, std::array<double, 2>{p, p}).first->second;
                        r = {std::min(r[0], p), std::max(r[1], p)};
                    }
                    double most = 0;
                    for (const auto& [cell, r] : range)
                        most = std::max(most, r[1] - r[0]);
                    return most / (dt * material.law->bulkModulus());
                };
                CHECK(widest(with) < 1e-5); // rates of volume change are about 1/s
                CHECK(widest(plain) > 0.1);
            }
}

TEST_CASE("patches average further than cells, and keep a body's pressure waves")
{
    // a long wave of volume change in a periodic box: cells and patches see nearly all of it
    for (const auto& kind : kinds)
    {
        auto s = scenes::seedBlock({.n = {64, 4, 1}, .spacing = 0.5, .h = 1, .cells = {32, 2, 1}});
        s.grid.periodic = {true, true, false};
        for (std::size_t i = 0; i < std::size_t(s.particles.size()); ++i)
            s.particles.v[0][i] = std::sin(2 * M_PI * s.particles.x[0][i] / 32);
        s.particles.padLastChunk();
        const auto material = scenes::elastic(1e6, 0.3);
        const double dt = 1e-6;
        const auto plain = run(s, "uGIMP", scene(material, {}), 1, dt);
        const auto with = run(s, "uGIMP", scene(material, treatmentOf(kind)), 1, dt);
        const auto amplitude = [&](const state::State& of) {
            double sum = 0;
            for (std::size_t i = 0; i < std::size_t(of.particles.size()); ++i)
                sum += meanStress(of.particles, i) * std::cos(2 * M_PI * of.particles.x[0][i] / 32);
            return sum;
        };
        // domains of uGIMP lie within their cells here, so that gradients are equal in a cell; a hat: (1 + cos kh)/2
        const double k = 2 * M_PI / 32;
        const double hats = kind.region == AveragingRegion::cell ? 1 : std::pow(0.5 * (1 + std::cos(k)), kind.repeats);
        CAPTURE(int(kind.region), kind.repeats);
        CHECK(amplitude(with) / amplitude(plain) == Approx(hats).epsilon(1e-6));
    }
}

TEST_CASE("what averages withhold from an elastic body is an energy of the state: bounded, never negative")
{
    // p = K A theta and forces B^T V p: what is booked adds up to K theta (A - A A) theta/2, and 0 <= A <= 1. A cell's
    // mean is a projection, A A = A.
    for (const std::string shape : {"uGIMP", "quadraticBSpline"})
        for (const int hats : {0, 2, 4})
        {
            CAPTURE(shape, hats);
            const auto sc = scene(scenes::elastic(1e6, 0.45),
                                  averaged(hats > 0 ? AveragingRegion::patch : AveragingRegion::cell, hats));
            auto s = block();
            stir(s, 1e-3); // no particle changes its cell
            auto stepper = cases::makeStepper(shape, s, sc);
            stepping::beginLedger(s, sc.materials);
            const double whole = s.ledger.initialKineticEnergy;
            double least = 0, most = 0;
            for (int n = 0; n < 1500; ++n)
            {
                stepper->step(4e-3);
                least = std::min(least, s.ledger.averagingLoss);
                most = std::max(most, s.ledger.averagingLoss);
            }
            CHECK(least > -1e-6 * whole);
            CHECK(most < (hats > 0 ? 0.5 : 1e-5) * whole);
            CHECK((most > 1e-3 * whole || hats == 0));
            CHECK(residual(s, sc) < 1e-10 * whole);
        }
}

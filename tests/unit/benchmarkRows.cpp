// The parts of the benchmark that do not depend on the clock, and that the others measure something at all.
#include "base/error.hpp"
#include "benchmark/peaks.hpp"
#include "benchmark/rowTable.hpp"
#include "case/makeStepper.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <omp.h>

using namespace mpm;
using namespace mpm::benchmark;
using stepping::StressUpdate;

namespace
{
struct Sums
{
    double mass = 0, volume = 0, volume0 = 0, kinetic = 0;
    Vector3 momentum{}, centre{};
};

Sums sumsOf(const state::Particles& p)
{
    Sums s;
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        s.mass += p.mass[i];
        s.volume += p.volume[i];
        s.volume0 += p.volume0[i];
        for (int a = 0; a < p.dim; ++a)
        {
            s.momentum[a] += p.mass[i] * p.v[a][i];
            s.centre[a] += p.mass[i] * p.x[a][i];
            s.kinetic += 0.5 * p.mass[i] * p.v[a][i] * p.v[a][i];
        }
    }
    return s;
}

/// A column that has moved, turned and strained.
state::State movedColumn(int dim)
{
    omp_set_num_threads(1); // small work; waiting threads would cost more
    auto state = seedColumn(dim, 8);
    const auto scene = columnScene("mohrCoulomb", StressUpdate::MUSL);
    const auto stepper = cases::makeStepper("uGIMP", state, scene);
    const double dt = columnDeltaT(*stepper, state, scene, true);
    while (state.time < 0.4)
        stepper->step(dt);
    return state;
}

Row someRow()
{
    Row row;
    row.setting.shape = "u\"GI\\MP\n";
    row.particles = 7200;
    row.ours = {40e-9, 39e-9, 43e-9};
    row.work = {400, 800};
    row.triad = 20e9;
    row.fmaPeak = 100e9;
    row.residentBytes = 250;
    return row;
}

cases::Options given(std::map<std::string, std::vector<std::string>> extra)
{
    cases::Options options;
    options.extra = std::move(extra);
    return options;
}
} // namespace

TEST_CASE("A refined column keeps mass, volume, momentum and centre")
{
    const int dim = GENERATE(2, 3);
    const auto coarse = movedColumn(dim);
    const auto fine = refine(coarse);
    REQUIRE(fine.particles.size() == coarse.particles.size() * (1 << dim));
    CHECK(fine.grid.h == 0.5 * coarse.grid.h);
    const Sums a = sumsOf(coarse.particles), b = sumsOf(fine.particles);
    CHECK(b.mass == Approx(a.mass).epsilon(1e-13));
    CHECK(b.volume == Approx(a.volume).epsilon(1e-13));
    CHECK(b.volume0 == Approx(a.volume0).epsilon(1e-13));
    CHECK(b.kinetic == Approx(a.kinetic).epsilon(1e-13));
    for (int k = 0; k < dim; ++k)
    {
        CHECK(std::abs(b.momentum[k] - a.momentum[k]) < 1e-12 * std::sqrt(2 * a.kinetic * a.mass));
        CHECK(std::abs(b.centre[k] - a.centre[k]) < 1e-12 * a.mass * 8);
    }
    // the box stays where it was, and the domains still fit the cells
    for (int k = 0; k < dim; ++k)
    {
        CHECK(fine.grid.origin[k] == coarse.grid.origin[k]);
        CHECK(fine.grid.upper(k) == Approx(coarse.grid.upper(k)).epsilon(1e-13));
    }
    for (std::size_t i = 0; i < std::size_t(fine.particles.size()); ++i)
        for (int k = 0; k < dim; ++k)
        {
            REQUIRE(fine.particles.length0[k][i] <= 0.5 * fine.grid.h * (1 + 1e-12));
            REQUIRE(fine.particles.x[1][i] > 0);
        }
}

TEST_CASE("Children of a particle tile its deformed domain")
{
    auto coarse = seedColumn(2, 4);
    coarse.particles.F[0][9] = 1.5; // a shear and a stretch: columns of F are the edges' directions
    coarse.particles.F[1][9] = 0.3;
    coarse.particles.F[2][9] = -0.2;
    const auto fine = refine(coarse);
    const double quarter = 0.25 * coarse.particles.length0[0][9];
    const auto& x = fine.particles.x;
    const double edge0[2] = {1.5 * quarter, -0.2 * quarter}, edge1[2] = {0.3 * quarter, 1.0 * quarter};
    for (int child = 0; child < 4; ++child)
        for (int a = 0; a < 2; ++a)
            CHECK(x[a][36 + std::size_t(child)] ==
                  Approx(coarse.particles.x[a][9] + (child & 1 ? 1 : -1) * edge0[a] + (child & 2 ? 1 : -1) * edge1[a]));
}

TEST_CASE("Sizes come near what is asked for, from columns of at most the widest")
{
    for (const Index wanted : {7200, 28800, 115200, 1036800, 10000000})
    {
        const auto size = columnSize(2, wanted, 119);
        CHECK(size.across <= 119);
        CHECK(std::abs(double(size.particles()) / double(wanted) - 1) < 0.02);
    }
    CHECK(columnSize(2, 115200, 119).particles() == 115200);
    CHECK(columnSize(3, 93312, 35).particles() == 93312);
    CHECK(columnSize(3, 1024000, 35).particles() == 1024000);
    CHECK(seedColumn(3, 6).particles.size() == columnSize(3, 432, 35).particles());
}

TEST_CASE("The seeded column is that of the case")
{
    const auto state = seedColumn(2, 30);
    REQUIRE(state.particles.size() == 1800);
    CHECK(state.grid.h == Approx(4.0 / 15));
    CHECK(state.grid.origin[0] == Approx(-12));
    CHECK(state.grid.upper(0) == Approx(16));
    CHECK(state.grid.upper(1) == Approx(12));
    const Sums sums = sumsOf(state.particles);
    CHECK(sums.mass == Approx(32000));
    CHECK(state.particles.stress[1][0] == Approx(-9800 * (8 - 4.0 / 60)));
    CHECK(state.particles.stress[0][0] == Approx(0.42 / 0.58 * state.particles.stress[1][0]));
    auto s = state;
    const auto scene = columnScene("mohrCoulomb", StressUpdate::MUSL);
    const auto stepper = cases::makeStepper("uGIMP", s, scene);
    CHECK(columnDeltaT(*stepper, s, scene, true) == Approx(1e-3).epsilon(1e-3));
    const auto lateScene = columnScene("mohrCoulomb", StressUpdate::USL);
    CHECK(columnDeltaT(*stepper, s, lateScene, true) < 0.71e-3); // under the limit of USL
}

TEST_CASE("A column collapses to the asked time, and then most of it yields")
{
    omp_set_num_threads(1);
    ColumnCache cache;
    const auto state = cache.collapsed({2, 20, 1});
    CHECK(state.time == Approx(collapseTime));
    CHECK(state.particles.size() == 3200);
    CHECK(state.step == 0);
    CHECK(yieldingShare(state, columnScene("mohrCoulomb", StressUpdate::MUSL).materials) > 0.5);
    CHECK(yieldingShare(state, columnScene("linearElastic", StressUpdate::MUSL).materials) == 0);
}

TEST_CASE("Counted bytes and flops")
{
    // by hand from the list in roofline.hpp: 9 + 27.5 doubles; 13 + 45.5; 29.5; 7 + 25.5; 25.5 + 11
    CHECK(countedWork(2, "uGIMP", StressUpdate::MUSL, "mohrCoulomb").bytes == 8 * 36.5);
    CHECK(countedWork(3, "uGIMP", StressUpdate::MUSL, "mohrCoulomb").bytes == 8 * 58.5);
    CHECK(countedWork(2, "uGIMP", StressUpdate::USL, "mohrCoulomb").bytes == 8 * 29.5);
    CHECK(countedWork(2, "linear", StressUpdate::MUSL, "mohrCoulomb").bytes == 8 * 32.5);
    CHECK(countedWork(2, "cpGIMP", StressUpdate::MUSL, "mohrCoulomb").bytes == 8 * 40.5);
    CHECK(countedWork(2, "uGIMP", StressUpdate::USF, "mohrCoulomb").bytes == 8 * 36.5);

    // floats for v, F, sigma, l: 6 + 20 of the 36.5 are half as large; 4 more of cpGIMP; 22; 18 + 4 of linear USF
    CHECK(countedWork(2, "uGIMP", StressUpdate::MUSL, "mohrCoulomb", 4).bytes == 8 * 36.5 - 4 * 26);
    CHECK(countedWork(2, "cpGIMP", StressUpdate::MUSL, "mohrCoulomb", 4).bytes == 8 * 40.5 - 4 * 30);
    CHECK(countedWork(2, "uGIMP", StressUpdate::USL, "mohrCoulomb", 4).bytes == 8 * 29.5 - 4 * 22);
    CHECK(countedWork(2, "linear", StressUpdate::USF, "mohrCoulomb", 4).bytes == 8 * 32.5 - 4 * 22);

    // 2D uGIMP: weights 46, records 5, projection 63 + 84, a 48, gradient 96, v* 48, motion 13, kinematics 115, law
    // 104; MUSL adds 2 + 42 of the second projection and 10 for the work of strain
    const auto musl = countedWork(2, "uGIMP", StressUpdate::MUSL, "mohrCoulomb").flops;
    CHECK(musl == 46 + 5 + 63 + 84 + 48 + 96 + 48 + 13 + 115 + 104 + 2 + 42 + 10);
    CHECK(countedWork(2, "uGIMP", StressUpdate::USL, "mohrCoulomb").flops == musl - 54 - 36);
    CHECK(countedWork(2, "uGIMP", StressUpdate::MUSL, "linearElastic").flops == musl - 90);
    for (const auto& shape : countedShapes())
        for (const auto& law : countedLaws())
            CHECK(countedWork(3, shape, StressUpdate::USF, law).flops > 0);
    CHECK_THROWS_AS(countedWork(2, "hexagon", StressUpdate::USL, "mohrCoulomb"), InputError);
    CHECK_THROWS_AS(countedWork(2, "linear", StressUpdate::USL, "clay"), InputError);
}

TEST_CASE("The roofline is the higher of two limits")
{
    CHECK(rooflineSeconds({400, 800}, 20e9, 100e9) == Approx(20e-9));
    CHECK(rooflineSeconds({400, 4000}, 20e9, 100e9) == Approx(40e-9));
    const Row row = someRow();
    CHECK(row.rooflineShare() == Approx(0.5));
    CHECK(row.bandwidth() == Approx(10e9));
    CHECK(row.flopRate() == Approx(20e9));
}

TEST_CASE("Rows become JSON that a strict parser reads")
{
    Row bare = someRow(), full = someRow();
    full.naive = Timing{200e-9, 190e-9, 210e-9};
    full.fmaPeak = 0; // a share that is not finite
    const tests::TemporaryFolder folder;
    const auto file = folder / "rows.json";
    std::ofstream(file) << jsonOf({bare, full});
    const std::string check =
        "/usr/bin/python3 -c 'import json, sys\n"
        "def refuse(word): raise ValueError(word)\n"
        "a, b = json.load(open(sys.argv[1]), parse_constant=refuse)\n"
        "names = \"dimension shape stressUpdate law real particles threads nsPerParticleStep naiveNsPerParticleStep "
        "bytesPerParticle triadGBs fmaGFs rooflineShare\".split()\n"
        "assert list(a) == names and list(b) == names\n"
        "assert a[\"shape\"] == \"u\" + chr(34) + \"GI\" + chr(92) + \"MP\" + chr(10)\n"
        "assert a[\"stressUpdate\"] == \"MUSL\" and a[\"real\"] == \"double\" and a[\"particles\"] == 7200\n"
        "assert a[\"nsPerParticleStep\"] == 40 and a[\"rooflineShare\"] == 0.5 and a[\"triadGBs\"] == 20\n"
        "assert a[\"naiveNsPerParticleStep\"] is None and b[\"naiveNsPerParticleStep\"] == 200\n"
        "assert b[\"rooflineShare\"] is None\n' " +
        file.string();
    CHECK(std::system(check.c_str()) == 0);
    std::ofstream(file) << jsonOf({});
    CHECK(std::system(("/usr/bin/python3 -m json.tool " + file.string() + " > /dev/null").c_str()) == 0);
}

TEST_CASE("Lists of options make a matrix")
{
    const auto rows = readSettings(given({{"shape", {"linear,uGIMP"}},
                                          {"dimension", {"2 3"}},
                                          {"stressUpdate", {"USL"}},
                                          {"particles", {"7200, 1.04M"}},
                                          {"threads", {"1,2"}},
                                          {"naive", {"off"}}}));
    REQUIRE(rows.size() == 16);
    CHECK(rows[0].threads == 1);
    CHECK(rows[1].threads == 2);
    CHECK(rows[2].particles == 1040000);
    CHECK(rows[4].shape == "uGIMP");
    CHECK(rows[8].dimension == 3);
    CHECK(rows[0].stressUpdate == StressUpdate::USL);
    CHECK_FALSE(rows[0].naive);
    CHECK(readSettings(given({})).size() == 2);

    CHECK_THROWS_WITH(readSettings(given({{"shape", {"ugimp"}}})), Catch::Contains("did you mean 'uGIMP'"));
    CHECK_THROWS_WITH(readSettings(given({{"stressUpdate", {"FLIP"}}})), Catch::Contains("USF, USL or MUSL"));
    for (const char* wrong : {"", ",", "12q", "0", "-5", "1e12", "nan", "k"})
        CHECK_THROWS_AS(readSettings(given({{"particles", {wrong}}})), InputError);
    CHECK_THROWS_AS(readSettings(given({{"threads", {"2000"}}})), InputError);
    CHECK_THROWS_AS(readSettings(given({{"naive", {"on,off"}}})), InputError);
    CHECK_THROWS_AS(readSettings(given({{"picRate", {"-1"}}})), InputError);
}

TEST_CASE("A row is measured as a whole")
{
    Setting setting;
    setting.quick = true;
    setting.particles = 800;
    Bench bench;
    const Row row = bench.measure(setting);
    CHECK(row.particles == 800);
    CHECK(row.ours.fastest > 0);
    CHECK(row.ours.fastest <= row.ours.median);
    CHECK(row.ours.median <= row.ours.slowest);
    REQUIRE(row.naive);
    CHECK(row.naive->median > 0);
    CHECK(row.triad > 1e8);
    CHECK(row.fmaPeak > 1e8);
    CHECK(row.columnBytes > 8 * 20);
    double shares = 0;
    for (const auto& [name, share] : row.passes)
        shares += share;
    CHECK(shares == Approx(1));
    CHECK(tableOf({row}).find("naive/ours") != std::string::npos);
}

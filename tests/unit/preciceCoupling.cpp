// The loop of a coupled run against a library and a peer made here: what is read, when; steps, checkpoints, output for
// accepted windows only; and every way it can end.
#include "precice/coupledRun.hpp"
#include "precice/stopWatch.hpp"
#include "support/fakeCoupling.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>

using namespace mpm;
using namespace mpm::precice;
using Catch::Contains;
using coupling::SurfaceKind;
using tests::FakeLibrary;
using tests::FakeSoil;

namespace
{
const Location here{"couplingDict", 7};

PreciceCoupling rigidWall()
{
    PreciceCoupling c;
    c.surfaces = {{"wall",
                   "SoilMesh",
                   SurfaceKind::Rigid,
                   {{Quantity::Displacement, "Displacement", here}, {Quantity::Rotation, "Rotation", here}},
                   {{Quantity::Force, "Force", here}, {Quantity::Torque, "Torque", here}},
                   here}};
    return c;
}

bool run(FakeSoil& soil, FakeLibrary& library, const PreciceCoupling& coupling, const Hooks& hooks = {})
{
    return CoupledRun<FakeLibrary, FakeSoil>(soil, library, coupling, hooks).run();
}
} // namespace

TEST_CASE("explicit coupling: read at the window's end, mean force out, every window accepted")
{
    FakeSoil soil;
    FakeLibrary library;
    REQUIRE(run(soil, library, rigidWall()));
    CHECK(library.coordinates["SoilMesh"] == std::vector<double>{4, 1}); // the reference point
    CHECK(soil.saves == 0);
    REQUIRE(soil.samples.size() == 5); // initial data, and the end of four windows
    CHECK(soil.samples[0].relative == 0);
    CHECK(soil.samples[3].relative == 0.5);
    CHECK(soil.samples[3].x == 1.5 * 1.5);
    REQUIRE(soil.accepted.size() == 4);
    CHECK(soil.accepted.back().time == 2);
    const auto& force = library.written["Force"];
    REQUIRE(force.size() == 5); // initial data first
    CHECK(force[1].values[0] == soil.accepted[0].mean);
    CHECK(library.written["Torque"][1].values.size() == 1);
    CHECK(library.finalized);
    CHECK(soil.finalizes == 1);
}

TEST_CASE("forces of the end of a step, and samples within it, on demand")
{
    FakeSoil soil;
    FakeLibrary library;
    auto coupling = rigidWall();
    coupling.windowAverage = false;
    coupling.samples = 4;
    library.initialData = false;
    run(soil, library, coupling);
    CHECK(library.written["Force"].size() == 4);
    CHECK(library.written["Force"][0].values[0] == soil.accepted[0].force);
    REQUIRE(soil.samples.size() == 17);
    CHECK(soil.samples[5].time == 0.5);
    CHECK(soil.samples[5].relative == 0.125);
    CHECK(soil.samples[8].relative == 0.5);
}

TEST_CASE("maxStep cuts a window evenly; only whole windows are accepted")
{
    FakeSoil soil;
    FakeLibrary library;
    auto coupling = rigidWall();
    coupling.maxStep = 0.2;
    run(soil, library, coupling);
    CHECK(soil.advances == 12);
    CHECK(soil.samples[1].relative == Approx(0.5 / 3));
    CHECK(soil.accepted.size() == 4);
    coupling.maxStep = 0.25; // fits: no third step for the sake of round-off
    FakeSoil other;
    FakeLibrary again;
    run(other, again, coupling);
    CHECK(other.advances == 8);
}

TEST_CASE("implicit coupling goes the accepted way as if the iterations before had never been")
{
    FakeSoil once, repeated;
    FakeLibrary exact, iterating;
    iterating.iterations = 4;
    auto coupling = rigidWall();
    coupling.maxStep = GENERATE(10.0, 0.2);
    Index iterations = 0;
    Hooks hooks;
    hooks.accepted = [&](const AcceptedWindow& window) { iterations += window.iterations; };
    run(once, exact, coupling);
    run(repeated, iterating, coupling, hooks);
    CHECK(repeated.saves == 4); // at window starts only, sub-cycled or not
    CHECK(repeated.restores == 12);
    CHECK(iterations == 16);
    REQUIRE(repeated.accepted.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
    {
        CHECK(repeated.accepted[k].time == once.accepted[k].time);
        CHECK(repeated.accepted[k].path == once.accepted[k].path);
        CHECK(repeated.accepted[k].mean == once.accepted[k].mean);
    }
}

TEST_CASE("the peer dies: one line, and the last accepted window on disk")
{
    FakeSoil soil;
    FakeLibrary library;
    library.iterations = GENERATE(1, 3);
    library.dieInWindow = 2;
    CHECK_THROWS_WITH(run(soil, library, rigidWall()), "preCICE: Receiving data from another participant failed");
    CHECK(soil.finalizes == 1);
    CHECK(soil.onDisk.time == 1);
    CHECK_FALSE(library.finalized); // nobody is there to speak to
}

TEST_CASE("a discarded window, a jump and a signal end the run with the last accepted window on disk")
{
    FakeSoil soil;
    FakeLibrary library;
    SECTION("discarded")
    {
        soil.discardAt = 3;
        CHECK_THROWS_WITH(run(soil, library, rigidWall()), "the soil flew apart");
        CHECK(soil.onDisk.time == 1.5);
    }
    SECTION("jump")
    {
        soil.farthest = 1.5;
        CHECK_THROWS_AS(run(soil, library, rigidWall()), StepError);
        CHECK(soil.onDisk.time == 1);
    }
    SECTION("signal")
    {
        Hooks hooks;
        hooks.stop = [&] { return soil.time() > 0.6; };
        CHECK_FALSE(run(soil, library, rigidWall(), hooks));
        CHECK(soil.onDisk.time == 1);
    }
    CHECK(soil.finalizes == 1);
}

TEST_CASE("meshes with edges; vectors lose and gain their z")
{
    FakeSoil soil;
    soil.surfaceKind = SurfaceKind::Deformable;
    FakeLibrary library;
    auto coupling = rigidWall();
    coupling.surfaces[0].kind = SurfaceKind::Deformable;
    coupling.surfaces[0].read.pop_back();
    coupling.surfaces[0].write[1] = {Quantity::ContactArea, "ContactArea", here};
    run(soil, library, coupling);
    CHECK(library.coordinates["SoilMesh"] == std::vector<double>{4, 0, 4, 1, 4, 2});
    CHECK(library.edges["SoilMesh"] == std::vector<int>{10, 11, 11, 12});
    CHECK(soil.accepted.back().x == 4);
    CHECK(library.written["Force"][4].values.size() == 6);
    CHECK(library.written["Force"][4].values[2] == soil.accepted[3].mean);
    CHECK(library.written["ContactArea"][4].values.size() == 3);
}

TEST_CASE("what the configuration says otherwise is told by the dictionary's line")
{
    FakeSoil soil;
    FakeLibrary library;
    SECTION("data")
    {
        library.components["Torque"] = 2;
        CHECK_THROWS_WITH(run(soil, library, rigidWall()),
                          "couplingDict:7: Torque: found vector data 'Torque' in preCICE's configuration, allowed "
                          "scalar in 2D");
    }
    SECTION("mesh")
    {
        library.meshDimensions = 3;
        CHECK_THROWS_WITH(run(soil, library, rigidWall()), Contains("couplingDict:7") && Contains("3 dimensions"));
    }
}

TEST_CASE("a rotation vector is turned into a quaternion")
{
    const auto pose = poseOf({1, 2, 3}, {0.5, 0, 0}, {0, 0, M_PI / 3});
    CHECK(pose[0] == 1.5);
    CHECK(pose[3] == Approx(std::cos(M_PI / 6)));
    CHECK(pose[6] == Approx(std::sin(M_PI / 6)));
    const auto tiny = poseOf({}, {}, {1e-200, 0, 0});
    CHECK(tiny[3] == 1);
    CHECK(tiny[4] == 0.5e-200);
    SurfaceLink link = rigidWall().surfaces[0];
    const auto fields = toParticipant(link, 2, {1, 1, 0}, {{Quantity::Velocity, {3, 4}}, {Quantity::Rotation, {0.2}}});
    REQUIRE(fields.size() == 2);
    CHECK(fields[0].values[6] == Approx(std::sin(0.1)));
    CHECK(fields[1].values == Values{3, 4, 0, 0, 0, 0});
}

TEST_CASE("a signal while the library waits is seen to by another thread, and only then")
{
    std::atomic<int> signal = 0, rescued = 0;
    StopWatch watch([&] { return int(signal); }, [&](int number) { rescued = number; }, 0.1);
    const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(400)); };
    signal = 2;
    wait();
    CHECK(rescued == 0); // the soil is at work
    watch.waiting(true);
    wait();
    CHECK(rescued == 2);
}

// A participant against what it must be: the solver's own steps, balances of momentum and energy across its surfaces,
// bitwise replay.
#include "case/makeStepper.hpp"
#include "support/pushedWall.hpp"

using namespace mpm;
using namespace mpm::tests;
using Catch::Contains;

TEST_CASE("windows take the solver's steps, bitwise")
{
    const TemporaryFolder folder;
    CoupledCase{.velocity = {1, 0.5, 0}}.write(folder.path());
    auto state = output::readState(folder / "0/state.h5");
    stepping::Scene scene;
    scene.materials = {scenes::elastic(1e6, 0.3)};
    auto stepper = cases::makeStepper("uGIMP", state, scene);
    stepping::beginLedger(state, scene.materials);
    for (int n = 0; n < 64; ++n)
        stepper->step(dt);

    Participant p(folder.path());
    p.initialize();
    for (int n = 0; n < 4; ++n)
    {
        const auto done = p.advance(16 * dt);
        REQUIRE(done.substeps == 16);
        p.acceptWindow();
    }
    p.finalize();
    REQUIRE(p.time() == 64 * dt);
    const auto end = output::readState(folder / "0.0625/state.h5");
    REQUIRE(end.time == state.time);
    REQUIRE(end.particles.x == state.particles.x);
    REQUIRE(end.particles.v == state.particles.v);
    REQUIRE(end.particles.stress == state.particles.stress);
}

TEST_CASE("a window ends where it was said, and no substep is tiny")
{
    const TemporaryFolder folder;
    CoupledCase{}.write(folder.path());
    Participant p(folder.path());
    p.initialize();
    for (const double window : {0.01, 0.1 / 3, dt * (5 + 1e-12), dt / 7, dt * 1.0000001})
    {
        const double end = p.time() + window;
        const auto done = p.advance(window);
        REQUIRE(done.time == end);
        REQUIRE(p.time() == end);
        REQUIRE(double(done.substeps) == std::ceil(window / dt * (1 - 1e-9))); // so the two last are above half a step
    }
}

TEST_CASE("impulses on a wall are the soil's momentum, and its work the soil's energy")
{
    const auto kind = GENERATE(SurfaceKind::Rigid, SurfaceKind::Deformable);
    const TemporaryFolder folder;
    CoupledCase{}.write(folder.path());
    auto p = pushed(folder.path(), kind);
    Vector3 impulse{};
    for (int n = 0; n < 30; ++n)
    {
        pushOn(p, 10 * dt);
        const auto sums = p.resultants("wall");
        for (std::size_t a = 0; a < 3; ++a)
            impulse[a] += sums.impulse[a];
        std::vector<double> average(p.valueCount("wall", FieldName::Force));
        p.windowAverage("wall", FieldName::Force, average);
        double total = 0;
        for (std::size_t k = 0; k < average.size(); k += 3)
            total += average[k];
        REQUIRE(total == Approx(sums.impulse[0] / (10 * dt)).epsilon(1e-12).margin(1e-9));
        p.acceptWindow();
    }
    const auto end = p.balance();
    CAPTURE(end.kineticEnergy, end.strainEnergy, end.interfaceWork, end.dissipation, end.residual);
    REQUIRE(end.momentum[0] > 100); // 500 kg at up to 2 m/s
    REQUIRE(end.momentum[0] == Approx(-impulse[0]).epsilon(1e-12));
    REQUIRE(end.momentum[1] == Approx(-impulse[1]).margin(1e-9));
    REQUIRE(std::abs(end.residual) < 1e-10 * end.interfaceWork);
    REQUIRE(p.interfaceWork("wall") == end.interfaceWork);
    REQUIRE(end.motionWork == Approx(end.interfaceWork).epsilon(1e-10)); // summed at nodes of the grid
    // what comes in stays, but for losses
    REQUIRE(end.interfaceWork > end.kineticEnergy + end.strainEnergy);
}

TEST_CASE("a deformable surface moved as a whole does what a rigid one does")
{
    const TemporaryFolder one, other;
    CoupledCase{}.write(one.path());
    CoupledCase{}.write(other.path());
    auto rigid = pushed(one.path()), deformable = pushed(other.path(), SurfaceKind::Deformable);
    for (int n = 0; n < 8; ++n)
    {
        pushOn(rigid, 0.01);
        pushOn(deformable, 0.01);
    }
    const auto a = rigid.resultants("wall"), b = deformable.resultants("wall");
    REQUIRE(a.impulse[0] < -1);
    REQUIRE(b.impulse[0] == Approx(a.impulse[0]).epsilon(1e-8));
    // the rigid one's moments are about a point that has gone 0.08 m along
    REQUIRE(b.momentImpulse[2] - a.momentImpulse[2] ==
            Approx(0.075 * b.impulse[1]).margin(0.01 * std::abs(b.impulse[1])));
    std::vector<double> forces(12);
    deformable.windowAverage("wall", FieldName::Force, forces);
    double moment = 0, along = 0; // about the centroid; friction acts up to half a cell before the face
    for (std::size_t n = 0; n < 4; ++n)
    {
        moment += (n == 1 || n == 2 ? 0.25 : -0.25) * forces[3 * n + 1] - (n >= 2 ? 0.4 : -0.4) * forces[3 * n];
        along += std::abs(forces[3 * n + 1]);
    }
    REQUIRE(std::abs(moment) > 0.01);
    REQUIRE(b.torque[2] == Approx(moment).margin(0.0625 * along + 1e-9));
    REQUIRE(deformable.interfaceWork("wall") == Approx(rigid.interfaceWork("wall")).epsilon(1e-8));
    REQUIRE(a.contactArea == Approx(0.5).margin(0.2)); // the block's side, to a piece of the face
    REQUIRE(b.contactArea == Approx(a.contactArea).epsilon(1e-12));
}

TEST_CASE("forces at the vertices of a bending wall do the work the soil sees")
{
    const TemporaryFolder folder;
    CoupledCase{}.write(folder.path());
    auto p = pushed(folder.path(), SurfaceKind::Deformable);
    pushOn(p, 0.09); // to the block
    double work = 0, force = 0;
    for (int n = 0; n < 50; ++n)
    {
        const double before = p.interfaceWork("wall"), t = p.time() + dt;
        const double push = 0.09 + 2 * (t - 0.09), lean = 0.5 * (t - 0.09);
        p.writeField("wall", FieldName::Displacement,
                     std::vector<double>{push, 0, 0, push, 0, 0, push + lean, lean, 0, push + lean, 0, 0}, dt);
        REQUIRE(p.advance(dt).substeps == 1);
        std::vector<double> forces(12);
        p.readField("wall", FieldName::Force, forces);
        const double velocity[12] = {2, 0, 0, 2, 0, 0, 2.5, 0.5, 0, 2.5, 0, 0};
        double power = 0;
        for (std::size_t k = 0; k < 12; ++k)
            power -= forces[k] * velocity[k];
        REQUIRE(p.interfaceWork("wall") - before == Approx(power * dt).epsilon(1e-9).margin(1e-12));
        work += power * dt;
        force -= p.resultants("wall").force[0];
    }
    REQUIRE(work > 1);
    REQUIRE(force > 0);
    REQUIRE(p.interfaceWork("wall") == Approx(p.balance().motionWork).epsilon(1e-10)); // summed at nodes of the grid
    REQUIRE(std::abs(p.balance().residual) < 1e-10 * work);
}

TEST_CASE("in 3D a box of triangles pushes a block")
{
    const TemporaryFolder folder;
    CoupledCase solid;
    solid.dim = 3;
    solid.write(folder.path());
    SurfaceMesh mesh{3, {}, {}};
    for (int k = 0; k < 8; ++k) // 0.4..0.9 x 0.25..1.25 x 0.25..1.25
        mesh.vertices.push_back({k & 1 ? 0.9 : 0.4, k & 2 ? 1.25 : 0.25, k & 4 ? 1.25 : 0.25});
    mesh.elements = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const auto kind = GENERATE(SurfaceKind::Rigid, SurfaceKind::Deformable);
    Participant p(folder.path());
    p.addCouplingSurface("wall", mesh, kind);
    p.initialize();
    Vector3 impulse{};
    double area = 0;
    for (int n = 1; n <= 8; ++n)
    {
        const double s = 0.02 * n;
        std::vector<double> moved{0.65 + s, 0.75, 0.75, 1, 0, 0, 0}, offset;
        for (int k = 0; k < 8; ++k)
            offset.insert(offset.end(), {s, 0.0, 0.0});
        if (kind == SurfaceKind::Rigid)
            p.writeField("wall", FieldName::RigidPose, moved, 16 * dt);
        else
            p.writeField("wall", FieldName::Displacement, offset, 16 * dt);
        p.advance(16 * dt);
        for (std::size_t a = 0; a < 3; ++a)
            impulse[a] += p.resultants("wall").impulse[a];
        area = std::max(area, p.resultants("wall").contactArea);
    }
    const auto end = p.balance();
    REQUIRE(end.momentum[0] > 1);
    REQUIRE(end.momentum[0] == Approx(-impulse[0]).epsilon(1e-12));
    REQUIRE(std::abs(end.residual) < 1e-10 * end.interfaceWork);
    std::vector<double> traction(24);
    p.readField("wall", FieldName::Traction, traction);
    REQUIRE(traction[3] <= 0);                 // on the face at the block the soil pushes back
    REQUIRE(area == Approx(0.25).margin(0.2)); // 0.5 m x 0.5 m, to a cell at its edges
}

TEST_CASE("a monitor goes with the soil, and loads it with what is written")
{
    const TemporaryFolder folder;
    CoupledCase{.velocity = {1, 0, 0}}.write(folder.path());
    Participant p(folder.path());
    p.addCouplingSurface("side", polygon({{1, 0.5, 0}, {1, 0.75, 0}, {1, 1, 0}}, false), SurfaceKind::Monitor);
    p.initialize();
    std::vector<double> values(9);
    p.advance(0.0625);
    p.readField("side", FieldName::Displacement, values);
    for (std::size_t n = 0; n < 3; ++n)
    {
        REQUIRE(values[3 * n] == Approx(0.0625).epsilon(1e-12));
        REQUIRE(values[3 * n + 1] == Approx(0).margin(1e-13));
    }
    const auto before = p.balance();
    p.writeField("side", FieldName::Force, std::vector<double>{0, 10, 0, 0, 20, 0, 0, 10, 0}, 0);
    p.advance(0.0625);
    const auto after = p.balance();
    REQUIRE(after.momentum[1] - before.momentum[1] == Approx(40 * 0.0625).epsilon(1e-12));
    REQUIRE(after.momentum[0] == Approx(before.momentum[0]).epsilon(1e-12));
    REQUIRE(after.interfaceWork > 0);
    REQUIRE(std::abs(after.residual) < 1e-10 * after.kineticEnergy);
    p.readField("side", FieldName::Velocity, values);
    REQUIRE(values[4] > 0);
}

TEST_CASE("a monitor reads the stress around it")
{
    const TemporaryFolder folder;
    CoupledCase{}.write(folder.path());
    auto state = output::readState(folder / "0/state.h5");
    const double uniform[] = {-3, -5, -2, 1};
    for (std::size_t k = 0; k < 4; ++k)
        for (Index i = 0; i < state.particles.size(); ++i)
            state.particles.stress[k][std::size_t(i)] = uniform[k];
    output::writeState(folder / "0", state);
    Participant p(folder.path());
    p.addCouplingSurface("line", polygon({{1.2, 0.6, 0}, {1.7, 0.8, 0}}, false), SurfaceKind::Monitor);
    p.initialize();
    std::vector<double> stress(12);
    p.readField("line", FieldName::Stress, stress);
    for (std::size_t n = 0; n < 2; ++n)
        for (std::size_t k = 0; k < 6; ++k)
            REQUIRE(stress[6 * n + k] == Approx(k < 4 ? uniform[k] : 0).epsilon(1e-12));
}

TEST_CASE("a window taken again from a snapshot is bitwise the first")
{
    const auto kind = GENERATE(SurfaceKind::Rigid, SurfaceKind::Deformable);
    const TemporaryFolder folder, second;
    CoupledCase{}.write(folder.path());
    CoupledCase{}.write(second.path());
    auto p = pushed(folder.path(), kind);
    pushOn(p, 0.1);
    const auto start = p.saveState();
    const auto bytes = p.serialise(start);
    pushOn(p, 0.1);
    const auto end = everything(p);
    p.restoreState(start);
    pushOn(p, 0.05, 1.5); // another way
    REQUIRE((everything(p) != end));
    p.restoreState(start);
    REQUIRE((everything(p) == bytes));
    pushOn(p, 0.1);
    REQUIRE((everything(p) == end));

    auto q = pushed(second.path(), kind); // in another participant
    q.restoreState(q.deserialise(bytes));
    REQUIRE(q.time() == 0.1);
    pushOn(q, 0.1);
    REQUIRE(q.balance().kineticEnergy == p.balance().kineticEnergy);
    REQUIRE(q.resultants("wall").impulse == p.resultants("wall").impulse);
}

TEST_CASE("results do not depend on the number of threads")
{
    std::vector<std::byte> first;
    for (const int threads : {1, 2, 3})
    {
        const TemporaryFolder folder;
        CoupledCase{}.write(folder.path());
        auto p = pushed(folder.path(), SurfaceKind::Rigid, threads);
        for (int n = 0; n < 3; ++n)
            pushOn(p, 0.1);
        const auto end = everything(p);
        first = first.empty() ? end : first;
        REQUIRE((end == first));
    }
}

TEST_CASE("only accepted windows are written, and the case goes on from the last")
{
    const TemporaryFolder folder, whole;
    CoupledCase{}.write(folder.path());
    CoupledCase{}.write(whole.path());
    {
        auto p = pushed(folder.path());
        pushOn(p, 128 * dt);
        REQUIRE_FALSE(std::filesystem::exists(folder / "postProcessing/history.csv"));
        REQUIRE_FALSE(std::filesystem::exists(folder / "0.125"));
        p.acceptWindow();
        REQUIRE(std::filesystem::exists(folder / "0.125/state.h5"));
        REQUIRE(std::filesystem::exists(folder / "postProcessing/wall/0.125.vtp"));
        REQUIRE(std::filesystem::exists(folder / "postProcessing/wall.pvd"));
        pushOn(p, 10 * dt);
        p.acceptWindow();
        pushOn(p, 100 * dt); // in the middle of which somebody pulls the plug
        p.finalize();
        REQUIRE_FALSE(std::filesystem::exists(folder / ".caseLock"));
    }
    const auto stored = output::readState(folder / "0.134766/state.h5");
    REQUIRE(stored.time == 138 * dt);
    auto again = pushed(folder.path());
    REQUIRE(again.time() == 138 * dt);
    pushOn(again, 100 * dt);
    auto all = pushed(whole.path());
    pushOn(all, 128 * dt);
    pushOn(all, 10 * dt);
    pushOn(all, 100 * dt);
    REQUIRE(again.balance().kineticEnergy == all.balance().kineticEnergy);
    REQUIRE(again.balance().momentum == all.balance().momentum);
    REQUIRE(again.resultants("wall").impulse == all.resultants("wall").impulse);
    REQUIRE(again.interfaceWork("wall") == all.interfaceWork("wall"));
}

TEST_CASE("a window that cannot go on is discarded")
{
    const TemporaryFolder folder;
    CoupledCase{.velocity = {30, 0, 0}}.write(folder.path());
    Participant p(folder.path());
    p.initialize();
    p.advance(0.05);
    const auto before = everything(p);
    const auto done = p.advance(0.2); // out of the grid
    REQUIRE(done.status == Status::discarded);
    REQUIRE(done.time == 0.05);
    REQUIRE_THAT(done.message, Contains("outside the grid"));
    REQUIRE((everything(p) == before));
    REQUIRE(p.advance(0.01).status == Status::reached);
}

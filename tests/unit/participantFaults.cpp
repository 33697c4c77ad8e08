// What a master does wrong: each a named error after which the participant is what it was.
#include "support/pushedWall.hpp"

using namespace mpm;
using namespace mpm::tests;

namespace
{
template <class Call>
Fault faultOf(Call&& call)
{
    try
    {
        call();
    }
    catch (const CouplingError& error)
    {
        return error.fault();
    }
    FAIL("no error");
    return Fault::files;
}
} // namespace

TEST_CASE("what a master does wrong has a name and changes nothing")
{
    const TemporaryFolder folder;
    CoupledCase{}.write(folder.path());
    {
        Participant p(folder.path());
        CHECK(faultOf([&] { p.advance(0.1); }) == Fault::callOrder);
        CHECK(faultOf([&] { p.saveState(); }) == Fault::callOrder);
        auto flipped = box(0.4, 0.25, 0.9, 1.25);
        std::swap(flipped.elements[1][0], flipped.elements[1][1]);
        CHECK(faultOf([&] { p.addCouplingSurface("w", flipped, SurfaceKind::Rigid); }) == Fault::badSurface);
        auto twice = box(0.4, 0.25, 0.9, 1.25);
        twice.elements.push_back(twice.elements[0]);
        CHECK(faultOf([&] { p.addCouplingSurface("w", twice, SurfaceKind::Rigid); }) == Fault::badSurface);
        p.addCouplingSurface("w", box(10, 10, 11, 11), SurfaceKind::Rigid);
        CHECK(faultOf([&] { p.addCouplingSurface("w", box(2.5, 1, 3, 2), SurfaceKind::Rigid); }) == Fault::badSurface);
        CHECK(faultOf([&] { p.initialize(); }) == Fault::badSurface); // outside the grid
        CHECK(p.lifecycle() == Lifecycle::Created);
    }
    {
        Participant p(folder.path());
        p.addCouplingSurface("w", box(0.4, 0.25, 1.1, 1.25), SurfaceKind::Rigid); // in the soil
        p.initialize();
        CHECK(faultOf([&] { p.advance(0.1); }) == Fault::badSurface);
    }
    auto p = pushed(folder.path());
    pushOn(p, 0.05);
    p.writeField("wall", FieldName::RigidPose, pose(0.75, 0.65), 0.1);
    const auto before = everything(p);
    const double nan = std::nan("");
    std::vector<double> seven(7), two(2);
    CHECK(faultOf([&] { p.initialize(); }) == Fault::callOrder);
    CHECK(faultOf([&] { p.writeField("door", FieldName::RigidPose, pose(1, 1)); }) == Fault::unknownSurface);
    CHECK(faultOf([&] { p.writeField("wall", FieldName::Force, seven); }) == Fault::unknownField);
    CHECK(faultOf([&] { p.readField("wall", FieldName::RigidPose, seven); }) == Fault::unknownField);
    CHECK(faultOf([&] { p.writeField("wall", FieldName::RigidPose, two); }) == Fault::wrongSize);
    CHECK(faultOf([&] { p.readField("wall", FieldName::Force, two); }) == Fault::wrongSize);
    CHECK(faultOf([&] { p.writeField("wall", FieldName::RigidPose, pose(nan, 1)); }) == Fault::notFinite);
    CHECK(faultOf([&] { p.writeField("wall", FieldName::RigidPose, std::vector<double>(7, 0.0)); }) == Fault::badValue);
    CHECK(faultOf([&] { p.writeField("wall", FieldName::RigidPose, pose(1, 1), -1); }) == Fault::badValue);
    for (const double window : {0.0, -1.0, 1e-300, nan, 1e300, 1.0 / 0.0})
        CHECK(faultOf([&] { p.advance(window); }) == Fault::badWindow);
    CHECK(faultOf([&] { p.restoreState({}); }) == Fault::badState);
    auto bytes = before;
    bytes.resize(bytes.size() / 2);
    CHECK(faultOf([&] { p.deserialise(bytes); }) == Fault::badState);
    CHECK((everything(p) == before));
    p.writeField("wall", FieldName::RigidPose, pose(3, 0.65), 0.01); // through the block
    const auto said = everything(p);
    CHECK(faultOf([&] { p.advance(0.01); }) == Fault::jump);
    CHECK((everything(p) == said));
    p.finalize();
    CHECK(faultOf([&] { p.advance(0.1); }) == Fault::callOrder);
}

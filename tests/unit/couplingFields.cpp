// The table of fields of coupling surfaces.
#include "coupling/couplingError.hpp"
#include "coupling/field.hpp"

#include <catch2/catch.hpp>

using namespace mpm::coupling;
using Catch::Contains;

TEST_CASE("fields: names, directions and dimensions")
{
    const auto rigid = fieldsOf(SurfaceKind::Rigid, 3), plane = fieldsOf(SurfaceKind::Rigid, 2);
    REQUIRE(rigid.size() == 8);
    for (std::size_t n = 0; n < rigid.size(); ++n)
    {
        CHECK(fieldName(fieldWord(rigid[n].name)) == rigid[n].name);
        CHECK(rigid[n].dimensions[1] - plane[n].dimensions[1] == (rigid[n].extensive ? 1 : 0)); // per metre
    }
    CHECK(rigid[0].components == 7);
    CHECK(unitText(rigid[2]) == "N");
    CHECK(unitText(plane[2]) == "N/m");
    CHECK(unitText(plane[3]) == "N m/m");
    const auto monitor = fieldsOf(SurfaceKind::Monitor, 2);
    REQUIRE(monitor.size() == 5);
    CHECK((monitor[0].direction == Direction::written && monitor[2].direction == Direction::read));
    CHECK((monitor[4].rank == 2 && monitor[4].components == 6 && unitText(monitor[4]) == "Pa"));
    CHECK(fieldsOf(SurfaceKind::Deformable, 2).size() == 5);
    for (const auto kind : {SurfaceKind::Rigid, SurfaceKind::Deformable, SurfaceKind::Monitor})
        CHECK(surfaceKind(kindWord(kind)) == kind);
    CHECK_THROWS_WITH(fieldName("Forces"), Contains("unknownField") && Contains("did you mean Force?"));
    CHECK_THROWS_WITH(surfaceKind("rigid"), Contains("badSurface") && Contains("did you mean Rigid?"));
}

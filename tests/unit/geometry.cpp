// Regions, their share of boxes, and the files they come from.
#include "base/error.hpp"
#include "geometry/bodyGeometry.hpp"
#include "geometry/geometryFile.hpp"
#include "geometry/gmshMesh.hpp"
#include "geometry/region2D.hpp"
#include "geometry/region3D.hpp"
#include "support/shapes.hpp"

#include <catch2/catch.hpp>

using namespace mpm;
using namespace mpm::geometry;
using namespace mpm::test;
using Catch::Matchers::Contains;

namespace
{
/// Sum of the outward normals times area, and of x.n/dim, which is the volume (divergence theorem).
std::pair<Vector3, double> divergence(const std::vector<Boundary>& boundaries, int dim)
{
    Vector3 sum{};
    double volume = 0;
    for (const Boundary& boundary : boundaries)
        for (const BoundaryElement& b : boundary.elements)
        {
            const auto &e = b.edges[0], &f = b.edges[1];
            const Vector3 n = dim == 2 ? Vector3{e[1], -e[0], 0}
                                       : Vector3{(e[1] * f[2] - e[2] * f[1]) / 2, (e[2] * f[0] - e[0] * f[2]) / 2,
                                                 (e[0] * f[1] - e[1] * f[0]) / 2};
            for (std::size_t k = 0; k < 3; ++k)
            {
                const double centre = b.from[k] + (dim == 2 ? e[k] / 2 : (e[k] + f[k]) / 3);
                sum[k] += n[k];
                volume += centre * n[k] / dim;
            }
        }
    return {sum, volume};
}
} // namespace

TEST_CASE("a polygon knows its area, centroid and inside, whichever way its loops run")
{
    const Region2D region("plate", {{{0, 0}, {0, 3}, {4, 3}, {4, 0}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}});
    CHECK(region.volume() == Approx(11).epsilon(1e-15));
    CHECK(region.centroid()[0] == Approx((12 * 2 - 1.5) / 11).epsilon(1e-14));
    CHECK(region.centroid()[1] == Approx(1.5).epsilon(1e-14));
    CHECK(region.islands() == 1);
    CHECK(region.contains({0.5, 0.5, 0}));
    CHECK(region.contains({4, 3, 0}));
    CHECK(region.contains({1, 1.5, 0}));
    CHECK_FALSE(region.contains({1.5, 1.5, 0}));
    CHECK_FALSE(region.contains({std::nextafter(4.0, 5.0), 1, 0}));
    CHECK_FALSE(region.contains({std::nextafter(1.0, 2.0), 1.5, 0}));
}

TEST_CASE("the part of a box inside a polygon has the exact area and centroid")
{
    const Region2D triangle("triangle", {{{0, 0}, {4, 0}, {0, 4}}});
    const BoxPart cut = boxPart(triangle, {1, 2, 0}, {2, 3, 1});
    CHECK(cut.volume == Approx(0.5).epsilon(1e-15));
    CHECK(cut.centroid[0] == Approx(1 + 1.0 / 3).epsilon(1e-15));
    CHECK(cut.centroid[1] == Approx(2 + 1.0 / 3).epsilon(1e-15));
    CHECK(cut.extent[0] == Approx(1));
    CHECK(cut.contact[0] == Approx(1));
    CHECK(cut.contact[1] == Approx(0).margin(1e-15));
    CHECK(cut.contact[2] == Approx(1));
    CHECK(cut.contact[3] == Approx(0).margin(1e-15));
    CHECK_FALSE(cut.whole);

    const BoxPart whole = boxPart(triangle, {0.5, 0.5, 0}, {1, 1, 1});
    CHECK(whole.whole);
    CHECK(whole.volume == 0.25);
    CHECK(boxPart(triangle, {3, 3, 0}, {4, 4, 1}).volume == 0);

    // A box around a tip that pokes in from the right, and around the whole region.
    const BoxPart tip = boxPart(triangle, {3.5, -1, 0}, {5, 1, 1});
    CHECK(tip.volume == Approx(0.125).epsilon(1e-14));
    CHECK(tip.extent[0] == Approx(0.5).epsilon(1e-14));
    CHECK(tip.extent[1] == Approx(0.5).epsilon(1e-14));
    CHECK(boxPart(triangle, {-1, -1, 0}, {5, 5, 1}).volume == Approx(8).epsilon(1e-15));
}

TEST_CASE("polygons that are not simple are refused with name and place")
{
    using Loops = std::vector<Region2D::Loop>;
    const auto refused = [](const Loops& loops, const std::string& place) {
        REQUIRE_THROWS_WITH(Region2D("soil", loops), Contains("'soil'") && Contains(place));
    };
    refused({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}, "(1 1)");                                 // bow tie
    refused({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{3, 1}, {5, 1}, {5, 2}, {3, 2}}}, "(4 "); // hole across the edge
    refused({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{0, 1}, {1, 1}, {1, 2}, {0, 2}}}, "(0 "); // hole along the edge
    refused({{{0, 0}, {1, 0}}}, "2 corners");
    refused({{{0, 0}, {1, 0}, {1, 0}, {0, 1}}}, "(1 0)");
    refused({{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}}}, "(1 1)"); // a corner passed twice
    refused({{{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}}, "(1 0)");         // a corner on an edge
}

TEST_CASE("loops may meet at a corner")
{
    const Region2D two("two", {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}});
    CHECK(two.volume() == Approx(2));
    CHECK(two.islands() == 2);
    const Region2D hole("hole", {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{0, 0}, {1, 0.5}, {0.5, 1}}});
    CHECK(hole.volume() == Approx(4 - 0.375));
}

TEST_CASE("segments are chained into simple loops that do not cross")
{
    const std::vector<Vector3> points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}};
    const std::vector<Simplex> segments = {{0, 1, -1}, {3, 2, -1}, {2, 4, -1}, {1, 2, -1},
                                           {5, 4, -1}, {3, 0, -1}, {6, 5, -1}, {2, 6, -1}};
    const auto loops = chainLoops(points, segments, "two");
    REQUIRE(loops.size() == 2);
    CHECK(loops[0].size() == 4);
    CHECK(loops[1].size() == 4);
    auto open = segments;
    open.erase(open.begin() + 4);
    REQUIRE_THROWS_WITH(chainLoops(points, open, "two"), Contains("open") && Contains("(2 1)"));
}

TEST_CASE("overlapping regions are measured")
{
    const Region2D a("a", {{{0, 0}, {2, 0}, {2, 2}, {0, 2}}});
    const Region2D b("b", {{{2, 0}, {3, 0}, {3, 2}, {2, 2}}});
    const Region2D c("c", {{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, {{1.25, 1.25}, {1.75, 1.25}, {1.75, 1.75}, {1.25, 1.75}}});
    Vector3 place{};
    CHECK(overlap(a, b, place) == 0);
    CHECK(overlap(a, c, place) == Approx(0.75).epsilon(1e-14));
}

TEST_CASE("a 3D surface is turned outward, with its cavities")
{
    Surface3 cube = boxSurface({0, 0, 0}, {2, 3, 4});
    std::swap(cube.triangles[3][0], cube.triangles[3][1]); // facing any way
    cube.add(boxSurface({0.5, 0.5, 0.5}, {1, 1, 1}));
    const Region3D region("block", cube.points, cube.triangles);
    CHECK(region.volume() == Approx(24 - 0.125).epsilon(1e-14));
    CHECK(region.contains({0.1, 0.1, 0.1}));
    CHECK_FALSE(region.contains({0.7, 0.7, 0.7}));
    CHECK(region.contains({2, 3, 4}));
    CHECK_FALSE(region.contains({2.0000001, 1, 1}));
    const BoxPart part = boxPart(region, {0, 0, 0}, {1, 1, 1});
    CHECK(part.volume == Approx(0.875).epsilon(1e-14));
    CHECK(part.centroid[0] == Approx((0.5 - 0.125 * 0.75) / 0.875).epsilon(1e-14));
    CHECK(part.contact[1] == Approx(0.75));
    CHECK(boxPart(region, {-0.25, 0, 0}, {0.25, 0.25, 0.25}).contact[0] == Approx(0).margin(1e-15));
}

TEST_CASE("surfaces that are open or cut themselves are refused with name and place")
{
    Surface3 open = boxSurface({0, 0, 0}, {1, 1, 1});
    open.triangles.pop_back();
    REQUIRE_THROWS_WITH(Region3D("shell", open.points, open.triangles),
                        Contains("'shell'") && Contains("open") && Contains("at ("));
    Surface3 cutting = boxSurface({0, 0, 0}, {1, 1, 1});
    cutting.add(boxSurface({0.5, 0.5, 0.5}, {2, 2, 2}));
    REQUIRE_THROWS_WITH(Region3D("pair", cutting.points, cutting.triangles),
                        Contains("'pair'") && Contains("cuts or touches itself") && Contains("at ("));
    Surface3 pierced = boxSurface({0, 0, 0}, {8, 8, 1}); // from above by a needle at (2 6 .), whose tip is inside
    const int n = int(pierced.points.size());
    for (const auto& p : {Vector3{2, 6, 0.5}, Vector3{1.9, 5.9, 3}, Vector3{2.1, 5.9, 3}, Vector3{2, 6.1, 3}})
        pierced.points.push_back(p);
    for (const auto& t : {std::array{0, 2, 1}, std::array{0, 3, 2}, std::array{0, 1, 3}, std::array{1, 2, 3}})
        pierced.triangles.push_back({n + t[0], n + t[1], n + t[2]});
    REQUIRE_THROWS_WITH(Region3D("needle", pierced.points, pierced.triangles),
                        (Contains("at (1.9") || Contains("at (2")) && (Contains(" 6") || Contains(" 5.9")) &&
                            Contains(" 1)"));
}

TEST_CASE("a .geo file gives regions and boundaries that face outward")
{
    const auto file = writeText("twoLayers.geo", R"(
        SetFactory("Built-in"); lc = 0.7;
        Point(1) = {0, 0, 0, lc}; Point(2) = {4, 0, 0, lc}; Point(3) = {4, 3, 0, lc}; Point(4) = {0, 3.1, 0, lc};
        Point(5) = {4, 8, 0, lc}; Point(6) = {0, 8, 0, lc};
        Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
        Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
        Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {-7, -6, -5, 3};
        Plane Surface(1) = {1}; Plane Surface(2) = {2};
        Physical Surface("rock") = {1}; Physical Surface("soil") = {2};
        Physical Curve("base") = {1}; Physical Curve("sides") = {-2, 4, 5, -7}; Physical Curve("top") = {6};
        Physical Curve("interface") = {3};
    )");
    const BodyGeometry body = readGeometry(file, 2);
    REQUIRE(body.regions.size() == 2);
    CHECK(body.regions[0]->name() == "rock");
    CHECK(body.regions[0]->volume() == Approx(12.2).epsilon(1e-14));
    CHECK(body.regions[1]->volume() == Approx(32 - 12.2).epsilon(1e-14));
    CHECK(body.regions[0]->vertices().size() == 4);
    REQUIRE(body.boundaries.size() == 4);
    CHECK(body.boundaries[0].name == "base");
    REQUIRE(body.boundaries[0].elements.size() == 1);
    CHECK(body.boundaries[0].elements[0].from == Vector3{0, 0, 0});
    CHECK(body.boundaries[0].elements[0].edges[0] == Vector3{4, 0, 0}); // normal (0, -4)
    std::vector<Boundary> outer(body.boundaries.begin(), body.boundaries.end() - 1);
    const auto [sum, volume] = divergence(outer, 2);
    CHECK(std::abs(sum[0]) + std::abs(sum[1]) < 1e-13);
    CHECK(volume == Approx(32).epsilon(1e-14));
    // The interface faces out of the region named first.
    CHECK(body.boundaries[3].elements[0].edges[0][0] == -4);
}

TEST_CASE("a .msh file, old or new, gives the same as its .geo file")
{
    const auto file = writeText("plate.geo", plateWithHole);
    const BodyGeometry body = readGeometry(file, 2);
    for (const double version : {2.2, 4.1})
    {
        const BodyGeometry mesh = readGeometry(meshOf(file, 2, version), 2);
        REQUIRE(mesh.regions.size() == 1);
        CHECK(mesh.regions[0]->name() == "plate");
        CHECK(mesh.regions[0]->volume() == Approx(4 - 0.25).epsilon(1e-13));
        REQUIRE(mesh.boundaries.size() == body.boundaries.size());
        for (std::size_t b = 0; b < body.boundaries.size(); ++b)
        {
            CHECK(mesh.boundaries[b].name == body.boundaries[b].name);
            CHECK(mesh.boundaries[b].area() == Approx(body.boundaries[b].area()).epsilon(1e-13));
        }
        const auto [sum, volume] = divergence(mesh.boundaries, 2);
        CHECK(std::abs(sum[0]) + std::abs(sum[1]) < 1e-13);
        CHECK(volume == Approx(3.75).epsilon(1e-13));
    }
}

TEST_CASE("curved edges are chords, fine enough by themselves")
{
    const auto file = writeText("disc.geo", "SetFactory(\"OpenCASCADE\"); Disk(1) = {0, 0, 0, 1};");
    const BodyGeometry body = readGeometry(file, 2);
    CHECK(body.regions[0]->name() == "disc");
    CHECK(body.regions[0]->volume() == Approx(M_PI).epsilon(5e-4));
    REQUIRE(body.notes.size() == 1);
    CHECK_THAT(body.notes[0], Contains("named after the file"));
}

TEST_CASE("3D: .geo, .step, .stl and .msh of the same solid")
{
    const auto geo = writeText("solid.geo", R"(
        SetFactory("OpenCASCADE");
        Box(1) = {0, 0, 0, 1, 2, 3}; Box(2) = {1, 0, 0, 1, 1, 1};
        BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
        Physical Volume("tall") = {1}; Physical Volume("small") = {2};
        Physical Surface("all") = CombinedBoundary{ Volume{1, 2}; };
        Mesh.MeshSizeMax = 0.6;
    )");
    const BodyGeometry body = readGeometry(geo, 3);
    REQUIRE(body.regions.size() == 2);
    CHECK(body.regions[0]->name() == "tall");
    CHECK(body.regions[0]->volume() == Approx(6).epsilon(1e-12));
    CHECK(body.regions[1]->volume() == Approx(1).epsilon(1e-12));
    REQUIRE(body.boundaries.size() == 1);
    const auto [sum, volume] = divergence(body.boundaries, 3);
    CHECK(std::abs(sum[0]) + std::abs(sum[1]) + std::abs(sum[2]) < 1e-12);
    CHECK(volume == Approx(7).epsilon(1e-12));

    for (const double version : {2.2, 4.1})
    {
        const BodyGeometry mesh = readGeometry(meshOf(geo, 3, version), 3);
        REQUIRE(mesh.regions.size() == 2);
        CHECK(mesh.regions[0]->volume() == Approx(6).epsilon(1e-12));
        const auto [meshSum, meshVolume] = divergence(mesh.boundaries, 3);
        CHECK(meshVolume == Approx(7).epsilon(1e-12));
    }

    const auto step =
        stepOf("SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 2, 3}; Sphere(2) = {5, 0, 0, 1};", "cad.step");
    const BodyGeometry cad = readGeometry(step, 3);
    REQUIRE(cad.regions.size() == 1);
    CHECK(cad.regions[0]->name() == "cad");
    CHECK(cad.regions[0]->volume() == Approx(6 + 4 * M_PI / 3).epsilon(1e-3));
    CHECK(readGeometry(step, 3, 0.5).regions[0]->volume() == Approx(cad.regions[0]->volume() / 8).epsilon(1e-12));

    const BodyGeometry stl = readGeometry(writeStl("block.stl", boxSurface({0, 0, 0}, {1, 2, 3})), 3);
    CHECK(stl.regions[0]->name() == "block");
    CHECK(stl.regions[0]->volume() == Approx(6).epsilon(1e-6)); // STL holds single precision texts
}

TEST_CASE("meshes of quadrangles and hexahedra")
{
    const auto file = writeText("blocks.geo", R"(
        SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 2, 1}; Transfinite Surface{1}; Recombine Surface{1};
        body[] = Extrude {0, 0, 1.5} { Surface{1}; Layers{3}; Recombine; };
        Physical Volume("block") = {body[1]}; Physical Surface("foot") = {1};
        Mesh.MeshSizeMax = 0.5;
    )");
    const BodyGeometry body = readGeometry(meshOf(file, 3, 4.1), 3);
    CHECK(body.regions[0]->volume() == Approx(3).epsilon(1e-13));
    const auto [normal, volume] = divergence(body.boundaries, 3);
    CHECK(normal[2] == Approx(-2).epsilon(1e-13)); // the foot faces down
    CHECK(std::abs(normal[0]) + std::abs(normal[1]) < 1e-14);
}

TEST_CASE("coordinates of a STEP file are taken as written, whatever its unit")
{
    const auto mm = stepOf("SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 2, 3};", "units.step");
    CHECK(stepUnit(mm) == "MILLI METRE");
    CHECK_THAT(readGeometry(mm, 3).notes[0], Contains("MILLI METRE"));
    std::ifstream in(mm);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t at; (at = text.find(".MILLI.,.METRE.")) != std::string::npos;)
        text.replace(at, 7, 1, '$');
    const auto m = writeText("metres.step", text);
    CHECK(stepUnit(m) == "METRE");
    CHECK(readGeometry(m, 3).regions[0]->volume() == Approx(6).epsilon(1e-9));
    CHECK(stepUnit(writeText("inch.step", "#1=(CONVERSION_BASED_UNIT('DEGREE',#2)NAMED_UNIT(#3)PLANE_ANGLE_UNIT());\n"
                                          "#4=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                                          "#5=(CONVERSION_BASED_UNIT('INCH',#6)LENGTH_UNIT()NAMED_UNIT(#7));")) ==
          "INCH");
}

TEST_CASE("bad files are refused with their name and what to do")
{
    const auto refused = [](const std::filesystem::path& file, int dim, const std::string& what) {
        REQUIRE_THROWS_MATCHES(readGeometry(file, dim), InputError,
                               Catch::Matchers::Predicate<InputError>([&](const InputError& e) {
                                   INFO(e.what());
                                   CHECK_THAT(e.what(), Contains(file.filename().string()) && Contains(what));
                                   return true;
                               }));
    };
    refused("missing.geo", 2, "cannot be read");
    refused(writeText("body.dxf", "0"), 2, ".geo, .step, .stp, .stl or .msh");
    refused(writeText("syntax.geo", "Point(1) = {0, 0, 0};\nfoo bar;\n"), 2, "syntax.geo:2: gmsh: ");
    refused(writeText("empty.geo", "Point(1) = {0, 0, 0};\n"), 2, "asks for 2");
    refused(writeText("flat.geo", plateWithHole), 3, "dimension 2, but gridDict asks for 3");
    refused(writeText("tilted.geo", R"(SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 1, 1};
        Rotate{ {1, 0, 0}, {0, 0, 0}, 0.1 }{ Surface{1}; })"),
            2, "leaves its plane");
    const std::string square = R"(
        Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 2, 0}; Point(4) = {0, 2, 0};
        Point(5) = {5, 0, 0}; Point(6) = {6, 0, 0}; Point(7) = {6, 1, 0};
        Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5}; Curve Loop(2) = {5, 6, 7};
    )";
    refused(writeText("bowTie.geo", square + R"(Line(1) = {1, 3}; Line(2) = {3, 2}; Line(3) = {2, 4}; Line(4) = {4, 1};
        Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1}; Physical Surface("soil") = {1};)"),
            2, "'soil': its boundary crosses or touches itself at (1 1)");
    refused(writeText("farHole.geo", square + R"(Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
        Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1, 2}; Physical Surface("soil") = {1};)"),
            2, "'soil': a surface has a loop at (");
    refused(writeText("overlap.geo",
                      R"(SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 2, 2}; Rectangle(2) = {1, 1, 0, 2, 2};
        Physical Surface("soil") = {1}; Physical Surface("rock") = {2};)"),
            2, "'soil' and 'rock' overlap in 1 m2");
    const auto cut = writeText("lineEnd.geo", square);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 6);
    refused(cut, 2, "last line");
    Surface3 open = boxSurface({0, 0, 0}, {1, 1, 1});
    open.triangles.pop_back();
    refused(writeStl("openBox.stl", open), 3, "'openBox': its surface is open");
}

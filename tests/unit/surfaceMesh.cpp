// Coupling surfaces: what is refused by number, areas and closest points, files written and read back.
#include "coupling/surfaceMesh.hpp"
#include "case/readSurface.hpp"
#include "coupling/closestPoint.hpp"
#include "coupling/couplingError.hpp"
#include "coupling/exportSurface.hpp"
#include "coupling/readSurfaceMesh.hpp"
#include "support/fileContents.hpp"
#include "support/surfaces.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <random>

using namespace mpm;
using namespace mpm::coupling;
using namespace mpm::tests;
using Catch::Contains;
using Catch::Detail::Approx;

namespace
{
template <class Change>
SurfaceMesh changed(SurfaceMesh mesh, Change change)
{
    change(mesh);
    return mesh;
}

void refused(const SurfaceMesh& mesh, bool closed, const std::string& what)
{
    INFO(what);
    CHECK_THROWS_WITH(check(mesh, closed, "blade"), Contains("badSurface: surface blade") && Contains(what));
}

SurfaceMesh inward(SurfaceMesh mesh)
{
    for (auto& e : mesh.elements)
        std::swap(e[0], e[1]);
    return mesh;
}

bool same(const SurfaceMesh& a, const SurfaceMesh& b)
{
    return a.dim == b.dim && a.vertices == b.vertices && a.elements == b.elements;
}
} // namespace

TEST_CASE("good surfaces pass, closed and open")
{
    for (const auto& mesh : {circle(7), cube(), sphere(2)})
    {
        CHECK_NOTHROW(check(mesh, true, "blade"));
        CHECK_NOTHROW(check(mesh, false, "blade"));
    }
    CHECK_NOTHROW(check(plate(3, 2), false, "top"));
    CHECK_NOTHROW(check(inward(plate(3, 2)), false, "top"));
    CHECK_NOTHROW(check(polygon({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}}, false), false, "top"));
}

TEST_CASE("surfaces that are none are refused by vertex and element")
{
    refused({2, {}, {}}, false, "no vertices");
    refused({2, {{0, 0, 0}, {1, 0, 0}}, {}}, false, "no segments");
    refused(changed(cube(), [](auto& m) { m.dim = 4; }), true, "dimension 4");
    refused(changed(cube(), [](auto& m) { m.elements[3][2] = 8; }), true, "triangle 3 of vertex 8, allowed are 0 to 7");
    refused(changed(cube(), [](auto& m) { m.elements[3][2] = -1; }), true, "triangle 3 of vertex -1");
    refused(changed(circle(5), [](auto& m) { m.elements[4][1] = 5; }), true, "segment 4 of vertex 5");
    refused(changed(circle(5), [](auto& m) { m.elements[4][2] = 0; }), true, "segment 4 with a third vertex 0");
    refused(changed(cube(), [](auto& m) { m.vertices[6][1] = NAN; }), true, "vertex 6");
    refused(changed(circle(5), [](auto& m) { m.vertices[2][2] = 0.1; }), true, "vertex 2 at z = 0.1");
    refused(changed(cube(), [](auto& m) { m.elements[5][2] = m.elements[5][0]; }), true, "triangle 5 of no size");
    refused({3, {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}}, false, "triangle 0 of no size"); // on a line
    refused(changed(circle(5), [](auto& m) { m.vertices[1] = m.vertices[2]; }), true, "segment 1 of no size");
    refused(changed(cube(), [](auto& m) { m.elements.push_back({2, 1, 3}); }), true, "triangles 1 and 12 of the same");
    refused(changed(circle(5),
                    [](auto& m) {
                        m.elements.push_back({1, 0, -1});
                    }),
            true, "segments 0 and 5 of the same");
    for (const bool closed : {true, false})
    {
        refused(changed(cube(), [](auto& m) { std::swap(m.elements[4][0], m.elements[4][1]); }), closed,
                "face against each other");
        refused(changed(circle(5), [](auto& m) { std::swap(m.elements[2][0], m.elements[2][1]); }), closed,
                "segments 1 and 2 that both end at vertex 2");
    }
    refused(changed(plate(1, 1),
                    [](auto& m) {
                        m.vertices.push_back({0.5, 0.5, 1});
                        m.elements.push_back({3, 0, 4});
                    }),
            false, "3 triangles (0, 1, 2) at the edge from vertex 0");
    refused(changed(cube(), [](auto& m) { m.elements.pop_back(); }), true, "open edge of triangle");
    refused(polygon({{0, 0, 0}, {1, 0, 0}, {2, 1, 0}}, false), true, "open end of segment 0 at vertex 0");
    refused(changed(cube(),
                    [](auto& m) {
                        m.vertices.push_back({5, 5, 5});
                    }),
            true, "vertex 8 (5 5 5) that belongs to no");
    refused(inward(cube()), true, "faces inward");
    refused(inward(circle(5)), true, "faces inward");
    refused(polygon({{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}, {-1, 0, 0}}, true), true, "cuts itself");
    // two triangles name a corner anew: the seam is said, not the hole it makes
    const auto seam = changed(cube(), [](auto& m) {
        m.vertices.push_back(m.vertices[7]);
        m.elements[3][1] = m.elements[7][2] = 8;
    });
    refused(seam, true, "vertex 8 (1 1 1) at the place of vertex 7");
    refused(seam, true, "merge them");
    CHECK(same(merged(seam), cube()));
}

TEST_CASE("vertices at one place are found wherever they are")
{
    auto mesh = sphere(3);
    const std::size_t count = mesh.vertices.size();
    for (std::size_t n = 0; n < count; n += 7)
        mesh.vertices.push_back(nodal::plus(mesh.vertices[n], {5e-10, 0, -5e-10}));
    const auto first = firstAtPlace(mesh);
    for (std::size_t n = 0; n < first.size(); ++n)
        CHECK(first[n] == Index(n < count ? n : 7 * (n - count)));
}

TEST_CASE("areas, normals and volume: those of the polyhedron")
{
    const auto areas = vertexAreas(cube());
    double sum = 0;
    for (const double a : areas)
        sum += a;
    CHECK(sum == Approx(6).epsilon(1e-15));
    CHECK(enclosedVolume(cube()) == Approx(1).epsilon(1e-15));
    CHECK(elementNormals(cube())[0] == Vector3{0, 0, -1});
    CHECK(elementNormals(plate(2, 2))[3] == Vector3{0, 0, 1});
    const auto square = polygon({{0, 0, 0}, {0, 2, 0}, {2, 2, 0}, {2, 0, 0}}, true); // clockwise: turned
    CHECK(enclosedVolume(square) == 4);
    for (std::size_t n = 0; n < 4; ++n)
    {
        CHECK(vertexAreas(square)[n] == 2);
        CHECK(elementAreas(square)[n] == 2);
        const auto& e = square.elements[n];
        const Vector3 middle =
            nodal::times(0.5, nodal::plus(square.vertices[std::size_t(e[0])], square.vertices[std::size_t(e[1])]));
        CHECK(nodal::dot(elementNormals(square)[n], nodal::minus(middle, {1, 1, 0})) == Approx(1)); // outward
    }
    CHECK(enclosedVolume(sphere(5)) == Approx(4 * M_PI / 3).epsilon(2e-3));
}

TEST_CASE("the closest point is the closest of a fine grid of points, with weights that make it")
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-1.5, 2.5);
    for (const auto& mesh :
         {changed(cube(), [](auto& m) { m.elements.resize(5); }), circle(6),
          SurfaceMesh{3, {{0, 0, 0}, {2, 0, 0}, {-0.6, 0.2, 0.1}}, {{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}}})
    {
        const ClosestPoint closest(mesh);
        for (int n = 0; n < 200; ++n)
        {
            const Vector3 x{place(random), place(random), mesh.dim == 3 ? place(random) : 0};
            const auto foot = closest(x);
            double best = 1e9;
            for (const auto& e : mesh.elements)
                for (int i = 0; i <= 40; ++i)
                    for (int j = 0; j <= (mesh.dim == 3 ? 40 - i : 0); ++j)
                    {
                        const Vector3 w{1 - (i + j) / 40.0, i / 40.0, j / 40.0};
                        Vector3 at{};
                        for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
                            at = nodal::plus(at, nodal::times(w[k], mesh.vertices[std::size_t(e[k])]));
                        best = std::min(best, nodal::length(nodal::minus(at, x)));
                    }
            CHECK(foot.distance <= best + 1e-14);
            CHECK(foot.distance >= best - 0.05);
            CHECK(foot.weights[0] + foot.weights[1] + foot.weights[2] == Approx(1).epsilon(1e-15));
            Vector3 made{};
            for (std::size_t k = 0; k < std::size_t(mesh.dim); ++k)
            {
                CHECK(foot.weights[k] >= 0);
                made = nodal::plus(
                    made, nodal::times(foot.weights[k],
                                       mesh.vertices[std::size_t(mesh.elements[std::size_t(foot.element)][k])]));
            }
            CHECK(nodal::length(nodal::minus(made, foot.point)) < 1e-14);
            CHECK(nodal::length(nodal::minus(foot.point, x)) == Approx(foot.distance).margin(1e-14));
        }
    }
}

TEST_CASE("files come back as they went: meshes bit by bit, STL to single precision")
{
    const TemporaryFolder folder;
    for (const auto& mesh : {circle(11, 0.3), sphere(2, 0.5)})
    {
        exportSurface(folder / "a.msh", "the blade", mesh);
        CHECK(same(readSurfaceMesh(folder / "a.msh", mesh.dim, true), mesh));
        CHECK(cases::readSurface(folder / "a.msh", mesh.dim).volume() == Approx(enclosedVolume(mesh)).epsilon(1e-14));
        CHECK_THAT(contents(folder / "a.msh"), Contains("\"the blade\""));
        CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1); // no temporary is left
    }
    const auto ball = sphere(2, 0.5);
    exportSurface(folder / "a.STL", "solid", ball);
    const auto found = readSurfaceMesh(folder / "a.STL", 3, true, 2);
    CHECK(found.vertices.size() == ball.vertices.size());
    CHECK(enclosedVolume(found) == Approx(8 * enclosedVolume(ball)).epsilon(1e-6));
    exportSurface(folder / "top.msh", "top", plate(3, 2));
    CHECK(same(readSurfaceMesh(folder / "top.msh", 3, false), plate(3, 2)));
    CHECK_THROWS_WITH(readSurfaceMesh(folder / "top.msh", 3, true), Contains("top.msh") && Contains("open edge"));
    exportSurface(folder / "in.msh", "in", inward(cube()));
    CHECK(same(readSurfaceMesh(folder / "in.msh", 3, true), cube())); // turned outward
}

TEST_CASE("VTK files hold places, elements and fields")
{
    const TemporaryFolder folder;
    const SurfaceMesh line = polygon({{0, 0, 0}, {1.1, 0, 0}, {2, 1, 0}}, false);
    exportSurface(folder / "a.vtp", "line", line,
                  {{"Force <N>", 3, {1, 2, 3, 4, 5, 6, 7, 8, 0.1}}, {"area", 1, {1, 2, 3}}});
    const std::string text = contents(folder / "a.vtp");
    CHECK_THAT(text,
               Contains("NumberOfPoints=\"3\"") && Contains("NumberOfLines=\"2\"") && Contains("NumberOfPolys=\"0\""));
    CHECK_THAT(text, Contains("Name=\"Force &lt;N&gt;\" NumberOfComponents=\"3\"") &&
                         Contains("1 2 3\n4 5 6\n7 8 0.10000000000000001\n"));
    CHECK_THAT(text,
               Contains("0 0 0\n1.1000000000000001 0 0\n2 1 0\n") && Contains("0 1\n1 2\n") && Contains("2\n4\n"));
    exportSurface(folder / "b.vtp", "cube", cube());
    CHECK_THAT(contents(folder / "b.vtp"), Contains("NumberOfPolys=\"12\"") && Contains("3 7 5\n") && Contains("36\n"));
}

TEST_CASE("files that cannot be written are said, and leave nothing")
{
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(exportSurface(folder / "a.obj", "x", cube()), Contains("files: ") && Contains("'.obj'"));
    CHECK_THROWS_WITH(exportSurface(folder / "a.stl", "x", circle(5)), Contains("in 2D"));
    CHECK_THROWS_WITH(exportSurface(folder / "none" / "a.stl", "x", cube()), Contains("files: ") && Contains("a.stl"));
    CHECK_THROWS_WITH(exportSurface(folder / "a.vtp", "x", cube(), {{"area", 1, {1, 2}}}), Contains("wrongSize"));
    CHECK(std::filesystem::is_empty(folder.path()));
}

// Values from mesh to mesh: constants, sums and work are kept, linear fields on planes, order 2 on curved surfaces.
#include "coupling/mapping.hpp"
#include "coupling/couplingError.hpp"
#include "support/surfaces.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace mpm;
using namespace mpm::coupling;
using namespace mpm::tests;
using Catch::Contains;
using Catch::Detail::Approx;

namespace
{
struct Pair
{
    const char* name;
    SurfaceMesh from, to;
};

std::vector<Pair> pairs()
{
    return {{"circles", circle(23), circle(37, 0.1)},
            {"spheres", sphere(2), sphere(3, 0.7)},
            {"plates", plate(5, 7), plate(8, 3)}};
}

const auto methods = {MappingMethod::nearestNeighbour, MappingMethod::nearestProjection};

std::vector<double> randomValues(std::size_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    std::vector<double> out(count);
    for (double& x : out)
        x = value(random);
    return out;
}

template <class Function>
std::vector<double> valuesOf(const SurfaceMesh& mesh, Function f)
{
    std::vector<double> out;
    for (const auto& x : mesh.vertices)
        out.push_back(f(x));
    return out;
}

/// The error of mapping f, root of the mean square.
template <class Function>
double errorOf(const SurfaceMesh& from, const SurfaceMesh& to, MappingMethod method, Function f)
{
    const auto exact = valuesOf(to, f);
    std::vector<double> found(exact.size());
    Mapping(from, to, method).consistent(valuesOf(from, f), 1, found);
    double sum = 0;
    for (std::size_t n = 0; n < exact.size(); ++n)
        sum += (found[n] - exact[n]) * (found[n] - exact[n]);
    return std::sqrt(sum / double(exact.size()));
}

double smooth(const Vector3& x)
{
    return std::sin(2 * x[0] + 0.3) * std::cos(x[1]) + x[2] * x[2] * x[0];
}
} // namespace

TEST_CASE("rows add up to one; the conservative mapping is the exact transpose")
{
    for (const auto& [name, from, to] : pairs())
        for (const auto method : methods)
        {
            INFO(name);
            const Mapping mapping(from, to, method);
            const std::size_t columns = from.vertices.size(), rows = to.vertices.size();
            std::vector<double> ones(columns, 1), found(rows);
            mapping.consistent(ones, 1, found);
            for (const double x : found)
                CHECK(x == Approx(1).epsilon(4e-16));
            // column by column against row by row
            std::vector<std::vector<double>> W;
            for (std::size_t j = 0; j < columns; ++j)
            {
                std::vector<double> unit(columns), column(rows);
                unit[j] = 1;
                mapping.consistent(unit, 1, column);
                W.push_back(column);
            }
            bool equal = true;
            for (std::size_t i = 0; i < rows; ++i)
            {
                std::vector<double> unit(rows), row(columns);
                unit[i] = 1;
                mapping.conservative(unit, 1, row);
                for (std::size_t j = 0; j < columns; ++j)
                    equal = equal && row[j] == W[j][i];
            }
            CHECK(equal);
        }
}

TEST_CASE("sums of forces and work are kept to round-off, three components at a time")
{
    for (const auto& [name, from, to] : pairs())
        for (const auto method : methods)
        {
            INFO(name);
            const Mapping mapping(from, to, method);
            const auto force = randomValues(3 * to.vertices.size(), 1), u = randomValues(3 * from.vertices.size(), 2);
            std::vector<double> mapped(u.size()), there(force.size());
            mapping.conservative(force, 3, mapped);
            mapping.consistent(u, 3, there);
            std::array<double, 3> before{}, after{};
            double workHere = 0, workThere = 0;
            for (std::size_t n = 0; n < force.size(); ++n)
            {
                before[n % 3] += force[n];
                workThere += force[n] * there[n];
            }
            for (std::size_t n = 0; n < u.size(); ++n)
            {
                after[n % 3] += mapped[n];
                workHere += mapped[n] * u[n];
            }
            for (std::size_t c = 0; c < 3; ++c)
                CHECK(after[c] == Approx(before[c]).margin(1e-12));
            CHECK(workHere == Approx(workThere).margin(1e-12));
        }
}

TEST_CASE("projection keeps linear fields on planes that lie on each other, and the force's moment with them")
{
    const auto linear = [](const Vector3& x) { return 3 + 2 * x[0] - 5 * x[1]; };
    CHECK(errorOf(plate(5, 7), plate(8, 3), MappingMethod::nearestProjection, linear) < 1e-14);
    CHECK(errorOf(plate(5, 7), plate(8, 3), MappingMethod::nearestNeighbour, linear) > 0.1);
    const auto line = polygon({{0, 0, 0}, {0.3, 0.6, 0}, {1, 2, 0}}, false),
               finer = polygon({{0.1, 0.2, 0}, {0.5, 1, 0}, {0.7, 1.4, 0}}, false);
    CHECK(errorOf(line, finer, MappingMethod::nearestProjection, linear) < 1e-14);
    CHECK(Mapping(line, finer, MappingMethod::nearestProjection).largestDistance() < 1e-15);
    auto above = plate(8, 3);
    for (auto& x : above.vertices)
        x[2] = 0.25;
    CHECK(errorOf(plate(5, 7), above, MappingMethod::nearestProjection, linear) < 1e-14);
    CHECK(Mapping(plate(5, 7), above, MappingMethod::nearestProjection).largestDistance() == Approx(0.25));
}

TEST_CASE("on curved surfaces projection is of order 2, the nearest vertex of order 1")
{
    const auto order = [](MappingMethod method, const auto& mesh) {
        return std::log2(errorOf(mesh(0), mesh(1), method, smooth) / errorOf(mesh(2), mesh(3), method, smooth)) / 2;
    };
    // the fine meshes four times as fine, turned against each other
    const auto circles = [](int n) { return circle((n < 2 ? 40 : 160) + 7 * (n % 2), 0.037 * (n % 2)); };
    const auto spheres = [](int n) { return sphere(n < 2 ? 4 : 6, 0.9 * (n % 2)); };
    CHECK(order(MappingMethod::nearestProjection, circles) == Approx(2).margin(0.1));
    CHECK(order(MappingMethod::nearestProjection, spheres) == Approx(2).margin(0.1));
    CHECK(order(MappingMethod::nearestNeighbour, circles) == Approx(1).margin(0.1));
    CHECK(order(MappingMethod::nearestNeighbour, spheres) == Approx(1).margin(0.1));
}

TEST_CASE("the tree finds what a search of all finds, the first of several as near")
{
    const auto from = plate(9, 9), to = plate(18, 18); // ties at the middles
    const auto numbers = valuesOf(from, [&, n = 0.0](const Vector3&) mutable { return n++; });
    std::vector<double> found(to.vertices.size());
    Mapping(from, to, MappingMethod::nearestNeighbour).consistent(numbers, 1, found);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        double best = 1e9;
        std::size_t first = 0;
        for (std::size_t j = 0; j < from.vertices.size(); ++j)
        {
            const Vector3 d = nodal::minus(from.vertices[j], to.vertices[i]);
            if (nodal::dot(d, d) < best)
            {
                best = nodal::dot(d, d);
                first = j;
            }
        }
        CHECK(found[i] == double(first));
    }
}

TEST_CASE("a hundred thousand vertices are not compared each with each")
{
    const auto from = sphere(7), to = sphere(7, 0.4); // 65538 vertices
    CHECK(errorOf(from, to, MappingMethod::nearestProjection, smooth) < 1e-3);
    CHECK(errorOf(from, to, MappingMethod::nearestNeighbour, smooth) < 0.05);
}

TEST_CASE("what cannot be mapped is refused by name")
{
    const auto mesh = circle(5);
    const SurfaceMesh none{2, {}, {}}, points{2, mesh.vertices, {}};
    const auto projection = MappingMethod::nearestProjection, nearest = MappingMethod::nearestNeighbour;
    CHECK_THROWS_WITH(Mapping(none, mesh, nearest), Contains("badSurface") && Contains("from: found no vertices"));
    CHECK_THROWS_WITH(Mapping(mesh, none, nearest), Contains("to: found no vertices"));
    CHECK_THROWS_WITH(Mapping(points, mesh, projection), Contains("no elements"));
    CHECK_NOTHROW(Mapping(points, mesh, nearest));
    CHECK_NOTHROW(Mapping(mesh, points, projection));
    CHECK_THROWS_WITH(Mapping(mesh, cube(), nearest), Contains("dimensions"));
    auto wrong = mesh;
    wrong.elements[3][1] = 5;
    CHECK_THROWS_WITH(Mapping(wrong, mesh, projection), Contains("element 3 of vertex 5"));
    wrong = mesh;
    wrong.vertices[2][0] = NAN;
    CHECK_THROWS_WITH(Mapping(mesh, wrong, nearest), Contains("vertex 2"));
    wrong = mesh;
    wrong.vertices[1] = wrong.vertices[2];
    CHECK_THROWS_WITH(Mapping(wrong, mesh, projection), Contains("element 1 of no size"));
    std::vector<double> five(5), six(6);
    const Mapping mapping(mesh, mesh, nearest);
    CHECK_THROWS_WITH(mapping.consistent(six, 1, five), Contains("wrongSize") && Contains("found 6"));
    CHECK_THROWS_WITH(mapping.consistent(five, 2, five), Contains("allowed are 10"));
    CHECK_THROWS_WITH(mapping.conservative(five, 1, six), Contains("to map to"));
}

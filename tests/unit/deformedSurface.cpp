// Surfaces of deformed material: closed, of the particles' volume, and refused by name where there is none.
#include "geometry/deformedSurface.hpp"
#include "base/error.hpp"
#include "coupling/exportSurface.hpp"
#include "geometry/bodyGeometry.hpp"
#include "geometry/particleDomains.hpp"
#include "geometry/region2D.hpp"
#include "geometry/region3D.hpp"
#include "geometry/surfaceMove.hpp"
#include "support/temporaryFolder.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <functional>

using namespace mpm;
using geometry::ParticleDomain;

namespace
{
constexpr double h = 0.1; ///< of a cell; particles are half as wide

/// Particles at the lattice points `inside` of n boxes an axis from the origin, moved by F and then by `shift`.
std::vector<ParticleDomain> lattice(int dim, int n, const std::function<bool(const Vector3&)>& inside,
                                    const std::array<double, 9>& F = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                                    const Vector3& shift = {})
{
    std::vector<ParticleDomain> made;
    const double d = h / 2, J = F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                                F[2] * (F[3] * F[7] - F[4] * F[6]);
    for (int k = 0; k < (dim == 3 ? n : 1); ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
            {
                const Vector3 X{(i + 0.5) * d, (j + 0.5) * d, dim == 3 ? (k + 0.5) * d : 0};
                if (!inside(X))
                    continue;
                ParticleDomain& p = made.emplace_back();
                p.volume = J * std::pow(d, dim);
                for (std::size_t r = 0; r < std::size_t(dim); ++r)
                {
                    p.centre[r] = shift[r];
                    for (std::size_t c = 0; c < std::size_t(dim); ++c)
                    {
                        p.centre[r] += F[3 * r + c] * X[c];
                        p.edges[c][r] = F[3 * r + c] * d;
                    }
                }
            }
    return made;
}

bool everywhere(const Vector3&)
{
    return true;
}

geometry::SurfaceOptions options(double alpha = 0.5, bool match = false)
{
    geometry::SurfaceOptions how;
    how.alpha = alpha * h;
    how.offset = 0.0125 * h;
    how.cell = h;
    how.matchVolume = match;
    return how;
}

/// What extractSurface promises: a body any geometry check accepts, of the volume it says.
void requireBody(const geometry::DeformedSurface& s)
{
    if (s.dim == 3)
    {
        const geometry::Region3D region("it", s.points, s.elements);
        CHECK(region.volume() == Approx(s.volume).epsilon(1e-12));
        CHECK(region.triangles() == s.elements); // outward already
    }
    long double volume = 0;
    for (const auto& e : s.elements)
    {
        const auto &a = s.points[std::size_t(e[0])], &b = s.points[std::size_t(e[1])];
        if (s.dim == 2)
            volume += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    if (s.dim == 2)
        CHECK(double(volume) == Approx(s.volume).epsilon(1e-12)); // outward, holes included
}

constexpr std::array<double, 9> sheared = {1.1, 0.8, 0, 0.2, 1, 0, 0, 0, 1}; // det 0.94
constexpr std::array<double, 9> sheared3D = {1.1, 0.4, 0.1, 0.2, 1, -0.3, 0, 0.1, 0.9};
} // namespace

TEST_CASE("The surface around a block is the block, sheared as it may be: nothing is offset in 2D")
{
    for (const auto& F : {std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1}, sheared})
    {
        const auto s = geometry::deformedSurface(lattice(2, 12, everywhere, F), 2, options());
        const double exact = 0.36 * (F[0] * F[4] - F[1] * F[3]);
        CHECK(s.volume == Approx(exact).epsilon(1e-12));
        CHECK(s.particleVolume == Approx(exact).epsilon(1e-12));
        CHECK(s.area == Approx(2 * 0.6 * (std::hypot(F[0], F[3]) + std::hypot(F[1], F[4]))).epsilon(1e-12));
        CHECK(s.pieces == 1);
        requireBody(s);
    }
}

TEST_CASE("In 3D the wrap's offset is taken back: a block is found to 0.2 % with offset 0.0125 cells")
{
    for (const auto& F : {std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1}, sheared3D})
    {
        const auto domains = lattice(3, 6, everywhere, F);
        const auto s = geometry::deformedSurface(domains, 3, options());
        CHECK(s.volume == Approx(s.particleVolume).epsilon(2e-3));
        CHECK(s.volume == Approx(s.outlineVolume).epsilon(2e-4)); // some points are held back
        requireBody(s);
        // not taken back, the layer of thickness 0.0125 h around a block of side 3 h would hold 2.5 %
        const geometry::Wrap raw = geometry::alphaWrap3D(domains, 0.5 * h, 0.0125 * h);
        for (std::size_t i = 0; i < raw.points.size(); ++i)
            CHECK(std::abs(std::hypot(raw.outward[i][0], raw.outward[i][1], raw.outward[i][2]) - 1) < 1e-12);
    }
}

TEST_CASE("matchVolume: the enclosed volume is the particles' to round-off, whatever the outline's")
{
    // a disc and a ball of squares and cubes: hollows between corners are closed, which is too much
    const auto ball = [](const Vector3& x) { return std::hypot(x[0] - 0.3, x[1] - 0.3, x[2] ? x[2] - 0.3 : 0) < 0.3; };
    for (const int dim : {2, 3})
    {
        const auto s = geometry::deformedSurface(lattice(dim, 12, ball), dim, options(dim == 2 ? 0.5 : 0.25, true));
        CHECK(s.outlineVolume > 1.01 * s.particleVolume);
        CHECK(s.volume == Approx(s.particleVolume).epsilon(1e-9));
        CHECK(s.movedIn > 0);
        CHECK(s.movedIn < 0.25 * h);
        requireBody(s);
    }
}

TEST_CASE("Holes wider than two alpha stay, and the boundary runs around them the other way")
{
    const auto frame = [](const Vector3& x) { return std::abs(x[0] - 0.3) > 0.1 || std::abs(x[1] - 0.3) > 0.1; };
    const auto s = geometry::deformedSurface(lattice(2, 12, frame), 2, options());
    // a disc of radius h/2 leaves out the last half cell of the hole's corners
    CHECK(s.volume == Approx(0.36 - 0.04 + 4 * 0.05 * 0.05 / 2).epsilon(1e-12));
    CHECK(s.area == Approx(4 * 0.6 + 4 * 0.1 + 4 * std::hypot(0.05, 0.05)).epsilon(1e-12));
    requireBody(s);

    auto wide = options(1.5); // does not fit into the hole
    CHECK(geometry::deformedSurface(lattice(2, 12, frame), 2, wide).volume == Approx(0.36).epsilon(1e-12));
    wide.volumeTolerance = 0.1;
    CHECK_THROWS_WITH(geometry::deformedSurface(lattice(2, 12, frame), 2, wide),
                      Catch::Contains("+12.5 % off") && Catch::Contains("a smaller alpha"));
}

TEST_CASE("Through a file and gmsh the surface is the same body: a hole is a curve of its own")
{
    const auto frame = [](const Vector3& x) { return std::abs(x[0] - 0.3) > 0.1 || std::abs(x[1] - 0.3) > 0.1; };
    const tests::TemporaryFolder folder;
    for (const int dim : {2, 3})
    {
        const auto s = geometry::deformedSurface(
            lattice(dim, dim == 2 ? 12 : 4, dim == 2 ? std::function<bool(const Vector3&)>(frame) : everywhere), dim,
            options());
        coupling::SurfaceMesh mesh{dim, s.points, {}};
        for (const auto& e : s.elements)
            mesh.elements.push_back({e[0], e[1], e[2]});
        coupling::exportSurface(folder / "surface.msh", "sand", mesh);
        std::ofstream(folder / "body.geo")
            << "Merge \"surface.msh\";\n"
            << (dim == 2 ? "Curve Loop(1) = {1};\nCurve Loop(2) = {2};\nPlane Surface(1) = {1, 2};\nPhysical "
                           "Surface(\"sand\") = {1};\n"
                         : "Surface Loop(1) = {1};\nVolume(1) = {1};\nPhysical Volume(\"sand\") = {1};\n");
        const auto body = geometry::readGeometry(folder / "body.geo", dim);
        REQUIRE(body.regions.size() == 1);
        CHECK(body.regions[0]->volume() == Approx(s.volume).epsilon(1e-12));
    }
}

TEST_CASE("Two pieces are an error that says where, or the larger one, or both")
{
    for (const int dim : {2, 3})
    {
        auto domains = lattice(dim, 6, everywhere);
        const auto second = lattice(dim, 4, everywhere, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {0.5, 0, 0});
        domains.insert(domains.end(), second.begin(), second.end());
        CHECK_THROWS_WITH(geometry::deformedSurface(domains, dim, options()),
                          Catch::Contains("in 2 pieces") && Catch::Contains("pieces largest") &&
                              Catch::Contains("larger than 0.5 cells"));
        auto how = options();
        how.pieces = geometry::Pieces::largest;
        const auto large = geometry::deformedSurface(domains, dim, how);
        CHECK(large.particleVolume == Approx(std::pow(0.3, dim)).epsilon(1e-12));
        CHECK(large.volume == Approx(large.particleVolume).epsilon(2e-3));
        CHECK(large.pieces == 2);
        requireBody(large);
        how.pieces = geometry::Pieces::all;
        const auto both = geometry::deformedSurface(domains, dim, how);
        CHECK(both.volume == Approx(std::pow(0.3, dim) + std::pow(0.2, dim)).epsilon(3e-3));
        requireBody(both);
        CHECK(geometry::deformedSurface(domains, dim,
                                        [] {
                                            auto bridged = options(1.5);
                                            bridged.volumeTolerance = 2;
                                            return bridged;
                                        }())
                  .pieces == 1); // the gap of two cells is closed
    }
}

TEST_CASE("Particles too sparse for alpha are named, and so is what is no domain")
{
    auto sparse = lattice(2, 8, everywhere);
    for (ParticleDomain& d : sparse)
        for (std::size_t k = 0; k < 2; ++k)
            d.centre[k] *= 4;
    CHECK_THROWS_WITH(geometry::deformedSurface(sparse, 2, options()),
                      Catch::Contains("64 particles fall into 64 pieces") &&
                          Catch::Contains("too sparse for alpha 0.5 cells"));
    sparse[3].edges[1][0] = std::nan("");
    CHECK_THROWS_WITH(geometry::deformedSurface(sparse, 2, options()), Catch::Contains("is not finite"));
    CHECK_THROWS_WITH(geometry::deformedSurface({}, 3, options()), Catch::Contains("no particles"));
}

TEST_CASE("A surface that cuts itself is noticed, and points that are held back keep their places")
{
    // two tetrahedra, the second moved by `way`: apart they cut nothing, into each other they do
    const auto pair = [](double way) {
        std::vector<Vector3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int i = 0; i < 4; ++i)
            points.push_back(
                {points[std::size_t(i)][0] + way, points[std::size_t(i)][1] + 0.1, points[std::size_t(i)][2] + 0.1});
        return points;
    };
    const std::vector<geometry::Simplex> tetrahedra = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2},
                                                       {4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {4, 7, 6}};
    CHECK(geometry::enclosedVolume(pair(2), tetrahedra) == Approx(1.0 / 3));
    CHECK(geometry::cuttingElements(pair(2), tetrahedra, 3).empty());
    CHECK(!geometry::cuttingElements(pair(0.3), tetrahedra, 3).empty());
    CHECK_THROWS_WITH(geometry::Region3D("it", pair(0.3), tetrahedra), Catch::Contains("cuts or touches itself"));

    const std::vector<geometry::Simplex> loop = {{0, 1, -1}, {1, 2, -1}, {2, 3, -1}, {3, 0, -1}};
    const std::vector<Vector3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
        bow{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    CHECK(geometry::cuttingElements(square, loop, 2).empty());
    CHECK(geometry::cuttingElements(bow, loop, 2) == std::vector<std::size_t>{3, 1});

    geometry::Wrap wrap;
    wrap.points = square;
    wrap.outward = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    wrap.elements = loop;
    geometry::SurfaceMove move(wrap);
    CHECK(move.wayTo(0.64, 0.5) == Approx(0.1));
    move.holdBack({0}, false); // half as far: the lower side
    CHECK(move.by(0.2)[0][1] == Approx(0.1));
    CHECK(move.by(0.2)[2][1] == Approx(0.8));
    for (int i = 0; i < 3; ++i)
        move.holdBack({0}, false);
    CHECK(move.by(0.2)[0] == square[0]);
    CHECK(move.heldBack() == 2);
    move.holdBack({0}, true);
    CHECK(move.heldBack() == 4);
}

TEST_CASE("Domains of stored particles are the images of their boxes under F")
{
    state::Particles p(2);
    p.resize(2);
    for (int i = 0; i < 2; ++i)
    {
        p.x[0][i] = i, p.x[1][i] = 2;
        p.length0[0][i] = 0.5, p.length0[1][i] = 0.25;
        p.F[0][i] = 1, p.F[1][i] = 2, p.F[2][i] = 0.5, p.F[3][i] = 3;
        p.volume[i] = 0.25;
        p.material[i] = i;
    }
    const auto one = geometry::particleDomains(p, 1);
    REQUIRE(one.size() == 1);
    CHECK(one[0].centre == Vector3{1, 2, 0});
    CHECK(one[0].edges[0] == Vector3{0.5, 0.25, 0});
    CHECK(one[0].edges[1] == Vector3{0.5, 0.75, 0});
    CHECK(one[0].volume == 0.25);
    CHECK(geometry::particleDomains(p).size() == 2);
}

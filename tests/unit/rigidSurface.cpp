// Surfaces of rigid bodies: distances against closed forms, files of all kinds, and what is refused.
#include "case/readSurface.hpp"
#include "nodal/vectors.hpp"

#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <random>

using namespace mpm;
using Catch::Contains;
using Catch::Detail::Approx;
using nodal::RigidSurface;

namespace
{
const Location here{"test", 1};

/// A box from low to high: 12 triangles that face outward.
std::pair<std::vector<Vector3>, std::vector<RigidSurface::Element>> box(const Vector3& low, const Vector3& high)
{
    std::vector<Vector3> p;
    for (int n = 0; n < 8; ++n)
        p.push_back({n & 1 ? high[0] : low[0], n & 2 ? high[1] : low[1], n & 4 ? high[2] : low[2]});
    return {p, RigidSurface::boxTriangles()};
}

double boxDistance(const Vector3& low, const Vector3& high, const Vector3& x)
{
    double outside = 0, inside = -1e9;
    for (std::size_t a = 0; a < 3; ++a)
    {
        const double d = std::max(low[a] - x[a], x[a] - high[a]);
        outside += std::max(d, 0.0) * std::max(d, 0.0);
        inside = std::max(inside, d);
    }
    return inside > 0 ? std::sqrt(outside) : inside;
}
} // namespace

TEST_CASE("distances from a box, inside and out, with the way out as normal")
{
    const Vector3 low{-1, 0, 2}, high{1, 3, 4};
    const auto [points, elements] = box(low, high);
    const RigidSurface surface(3, points, elements, here);
    CHECK(surface.volume() == Approx(12).epsilon(1e-14));
    CHECK(surface.centroid()[1] == Approx(1.5).epsilon(1e-14));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-4, 8);
    for (int n = 0; n < 2000; ++n)
    {
        const Vector3 x{place(random), place(random), place(random)};
        const auto near = surface.nearest(x);
        CHECK(near.distance == Approx(boxDistance(low, high, x)).epsilon(1e-12));
        const auto out = nodal::plus(near.point, nodal::times(near.distance, near.normal));
        CHECK(nodal::length(nodal::minus(out, x)) < 1e-12);
    }
    CHECK(surface.nearest({1, 1, 3}).normal[0] == Approx(1)); // on a face
}

TEST_CASE("a concave polygon, whichever way round: the sign is that of a count of crossings")
{
    std::vector<Vector3> L = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
    for (int turn = 0; turn < 2; ++turn)
    {
        const auto surface = RigidSurface::polygon(L, here);
        CHECK(surface.volume() == Approx(6).epsilon(1e-14));
        std::mt19937 random(3);
        std::uniform_real_distribution<double> place(-1, 5);
        for (int n = 0; n < 2000; ++n)
        {
            const Vector3 x{place(random), place(random), 0};
            const bool inside =
                (x[0] > 0 && x[0] < 3 && x[1] > 0 && x[1] < 1) || (x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 4);
            CHECK((surface.nearest(x).distance < 0) == inside);
        }
        CHECK(surface.nearest({0.9, 0.9, 0}).distance == Approx(-std::sqrt(0.02)).epsilon(1e-12)); // beside a corner
        std::reverse(L.begin(), L.end());
    }
}

TEST_CASE("a sphere of many triangles: the tree finds what a search of all finds")
{
    std::vector<Vector3> points;
    std::vector<RigidSurface::Element> elements;
    const int rings = 24, around = 48;
    for (int r = 0; r <= rings; ++r)
        for (int k = 0; k < around; ++k)
        {
            const double th = M_PI * r / rings, ph = 2 * M_PI * k / around;
            points.push_back({std::sin(th) * std::cos(ph), std::sin(th) * std::sin(ph), std::cos(th)});
        }
    const auto at = [&](int r, int k) { return Index(r * around + k % around); };
    for (int r = 0; r < rings; ++r)
        for (int k = 0; k < around; ++k)
        {
            if (r < rings - 1)
                elements.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
            if (r > 0)
                elements.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
        }
    const RigidSurface sphere(3, points, elements, here);
    CHECK(sphere.volume() == Approx(4 * M_PI / 3).epsilon(0.02));
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-2, 2);
    for (int n = 0; n < 500; ++n)
    {
        const Vector3 x{place(random), place(random), place(random)};
        CHECK(sphere.nearest(x).distance == Approx(nodal::length(x) - 1).margin(0.01));
    }
}

TEST_CASE("surfaces that are none are refused by place")
{
    const auto [points, elements] = box({0, 0, 0}, {1, 1, 1});
    auto open = elements;
    open.pop_back();
    CHECK_THROWS_WITH(RigidSurface(3, points, open, here), Contains("test:1") && Contains("open surface"));
    auto flipped = elements;
    std::swap(flipped[4][0], flipped[4][1]);
    CHECK_THROWS_WITH(RigidSurface(3, points, flipped, here), Contains("other way"));
    auto insideOut = elements;
    for (auto& e : insideOut)
        std::swap(e[0], e[1]);
    CHECK(RigidSurface(3, points, insideOut, here).nearest({0.5, 0.5, 0.4}).distance == Approx(-0.4)); // turned
    auto both = box({0, 0, 0}, {1, 1, 1});
    const auto other = box({0.5, 0.3, 0.2}, {1.7, 1.5, 1.4});
    for (const auto& e : other.second)
        both.second.push_back({e[0] + 8, e[1] + 8, e[2] + 8});
    both.first.insert(both.first.end(), other.first.begin(), other.first.end());
    CHECK_THROWS_WITH(RigidSurface(3, both.first, both.second, here), Contains("cuts itself"));
    CHECK_THROWS_WITH(RigidSurface::polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 2, 0}}, here),
                      Contains("cuts itself"));
    CHECK_THROWS_WITH(RigidSurface::polygon({{0, 0, 0}, {1, 1, 0}}, here), Contains("2 points"));
    CHECK_THROWS_WITH(RigidSurface::polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, here), Contains("no size"));
}

TEST_CASE("files: STL of both kinds, meshes of both formats")
{
    const auto folder = std::filesystem::temp_directory_path() / "mpmRigidSurface";
    std::filesystem::create_directories(folder);
    const auto [points, elements] = box({0, 0, 0}, {1, 2, 3});
    std::string ascii = "solid box\n", binary(80, ' ');
    const std::uint32_t count = 12;
    binary.append(reinterpret_cast<const char*>(&count), 4);
    for (const auto& e : elements)
    {
        ascii += "facet normal 0 0 0\nouter loop\n";
        binary.append(12, '\0');
        for (const Index n : e)
        {
            const auto& p = points[std::size_t(n)];
            ascii += "vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
            for (const double x : p)
            {
                const float single = float(x);
                binary.append(reinterpret_cast<const char*>(&single), 4);
            }
        }
        ascii += "endloop\nendfacet\n";
        binary.append(2, '\0');
    }
    const auto write = [&](const std::string& name, const std::string& text) {
        std::ofstream(folder / name, std::ios::binary) << text;
        return folder / name;
    };
    for (const auto& file : {write("a.stl", ascii + "endsolid\n"), write("b.STL", binary)})
    {
        const auto surface = cases::readSurface(file, 3, 0.5);
        CHECK(surface.volume() == Approx(0.75).epsilon(1e-12));
        CHECK(surface.points().size() == 8);
    }
    // a square of two curves, one of them written backwards
    const std::string two =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
        "$Elements\n5\n1 15 2 0 1 1\n2 1 2 0 1 1 2\n3 1 2 0 1 2 3\n4 1 2 0 2 4 3\n5 1 2 0 2 1 4\n$EndElements\n";
    CHECK(cases::readSurface(write("a.msh", two), 2).volume() == Approx(1).epsilon(1e-14));
    const std::string four =
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n1 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
        "$EndNodes\n$Elements\n1 4 1 4\n1 1 1 4\n1 1 2\n2 3 2\n3 3 4\n4 1 4\n$EndElements\n";
    CHECK(cases::readSurface(write("b.msh", four), 2).volume() == Approx(1).epsilon(1e-14));

    CHECK_THROWS_WITH(cases::readSurface(write("a.geo", "Point(1)"), 2), Contains("gmsh -1 a.geo"));
    CHECK_THROWS_WITH(cases::readSurface(write("c.stl", ascii), 2), Contains(".msh"));
    CHECK_THROWS_WITH(cases::readSurface(write("d.stl", "solid x\nvertex 0 0 zero\n"), 3),
                      Contains("d.stl:2") && Contains("'zero'"));
    CHECK_THROWS_WITH(cases::readSurface(write("e.stl", "solid x\nendsolid\n"), 3), Contains("no triangles"));
    CHECK_THROWS_WITH(cases::readSurface(write("c.msh", two.substr(0, 150)), 2), Contains("end of the file"));
    std::filesystem::remove_all(folder);
}

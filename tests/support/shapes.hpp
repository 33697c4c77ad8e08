#pragma once
// Bodies, and the files that describe them, for tests of geometry and seeding.
#include "geometry/simplex.hpp"
#include "state/gridBox.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmsh.h>
#include <iomanip>

namespace mpm::test
{
inline state::GridBox gridBox(int dim, const Vector3& origin, double h, std::array<Index, 3> cells)
{
    state::GridBox grid;
    grid.dim = dim;
    grid.origin = origin;
    grid.h = h;
    grid.cells = cells;
    return grid;
}

struct Surface3
{
    std::vector<Vector3> points;
    std::vector<geometry::Simplex> triangles;

    void add(const Surface3& other)
    {
        const int base = int(points.size());
        points.insert(points.end(), other.points.begin(), other.points.end());
        for (const auto& t : other.triangles)
            triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
};

inline Surface3 boxSurface(const Vector3& low, const Vector3& high)
{
    Surface3 s;
    for (int k = 0; k < 8; ++k)
        s.points.push_back({k & 1 ? high[0] : low[0], k & 2 ? high[1] : low[1], k & 4 ? high[2] : low[2]});
    s.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return s;
}

inline Surface3 tetrahedron(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
    return {{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// An octahedron whose triangles are cut in four `levels` times, its points pushed onto the sphere.
inline Surface3 sphereSurface(const Vector3& centre, double radius, int levels)
{
    Surface3 s;
    s.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    s.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < levels; ++level)
    {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [at, isNew] = middles.emplace(std::minmax(a, b), int(s.points.size()));
            if (isNew)
            {
                Vector3 m;
                double norm = 0;
                for (std::size_t k = 0; k < 3; ++k)
                    m[k] = s.points[std::size_t(a)][k] + s.points[std::size_t(b)][k], norm += m[k] * m[k];
                for (double& x : m)
                    x /= std::sqrt(norm);
                s.points.push_back(m);
            }
            return at->second;
        };
        std::vector<geometry::Simplex> finer;
        for (const auto& t : s.triangles)
        {
            const int ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
            finer.insert(finer.end(), {{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}});
        }
        s.triangles = finer;
    }
    for (Vector3& p : s.points)
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = centre[k] + radius * p[k];
    return s;
}

/// Volume by the divergence theorem; triangles must face outward.
inline double volumeOf(const Surface3& s)
{
    double sum = 0;
    for (const auto& t : s.triangles)
    {
        const Vector3 &a = s.points[std::size_t(t[0])], &b = s.points[std::size_t(t[1])],
                      &c = s.points[std::size_t(t[2])];
        sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                a[2] * (b[0] * c[1] - b[1] * c[0])) /
               6;
    }
    return sum;
}

/// A folder for this test program's files.
inline std::filesystem::path scratch()
{
    const auto folder = std::filesystem::path(MPM_BUILD_DIR) / "tests" / "geometryFiles";
    std::filesystem::create_directories(folder);
    return folder;
}

inline std::filesystem::path writeText(const std::string& name, const std::string& text)
{
    const auto file = scratch() / name;
    std::ofstream(file) << text << '\n';
    return file;
}

inline std::filesystem::path writeStl(const std::string& name, const Surface3& s)
{
    const auto file = scratch() / name;
    std::ofstream out(file);
    out << std::setprecision(17) << "solid body\n";
    for (const auto& t : s.triangles)
    {
        out << "facet normal 0 0 0\nouter loop\n";
        for (const int i : t)
            out << "vertex " << s.points[std::size_t(i)][0] << ' ' << s.points[std::size_t(i)][1] << ' '
                << s.points[std::size_t(i)][2] << '\n';
        out << "endloop\nendfacet\n";
    }
    out << "endsolid body\n";
    return file;
}

/// gmsh's own mesh of a .geo file, in the given version of the format.
inline std::filesystem::path meshOf(const std::filesystem::path& geo, int dim, double version)
{
    const auto file = scratch() / (geo.stem().string() + (version < 3 ? "22.msh" : "41.msh"));
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::open(geo.string());
    gmsh::model::mesh::generate(dim);
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::write(file.string());
    gmsh::finalize();
    return file;
}

/// A CAD file of what a .geo script draws.
inline std::filesystem::path stepOf(const std::string& script, const std::string& name)
{
    const auto file = scratch() / name;
    const auto geo = writeText(name + ".geo", script);
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::open(geo.string());
    gmsh::write(file.string());
    gmsh::finalize();
    return file;
}

inline const char* plateWithHole = R"(
    SetFactory("OpenCASCADE");
    Rectangle(1) = {0, 0, 0, 2, 2}; Rectangle(2) = {0.5, 0.5, 0, 0.5, 0.5};
    BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
    Physical Surface("plate") = {3};
    outer[] = Curve In BoundingBox {-0.1, -0.1, -0.1, 2.1, 0.1, 0.1};
    all[] = Boundary{ Surface{3}; };
    rest[] = all[]; rest[] -= outer[];
    Physical Curve("base") = outer[]; Physical Curve("others") = rest[];
    Mesh.MeshSizeMax = 0.3;
)";
} // namespace mpm::test

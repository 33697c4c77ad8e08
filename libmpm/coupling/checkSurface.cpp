#include "coupling/couplingError.hpp"
#include "coupling/surfaceMesh.hpp"
#include "nodal/rigidSurface.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace mpm::coupling
{
using nodal::cross;
using nodal::length;
using nodal::minus;

namespace
{
/// The checks of one surface, in an order in which each may rely on those before it.
class Checks
{
  public:
    Checks(const SurfaceMesh& mesh, bool closed, const std::string& name)
        : mesh_(mesh), closed_(closed), name_(name), corners_(std::size_t(mesh.dim))
    {}

    void all() const
    {
        if (mesh_.dim != 2 && mesh_.dim != 3)
            fail(fmt::format("found dimension {}, allowed are 2 and 3", mesh_.dim));
        vertices();
        indices();
        sizes();
        twice();
        if (closed_)
            places();
        mesh_.dim == 2 ? joints() : edges();
        belong();
        if (closed_)
            whole();
    }

  private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw CouplingError(Fault::badSurface, fmt::format("surface {}: {}", name_, what));
    }
    const char* word() const { return mesh_.dim == 2 ? "segment" : "triangle"; }
    const Vector3& vertex(Index n) const { return mesh_.vertices[std::size_t(n)]; }
    /// "vertex 3 (0.5 1)"
    std::string at(Index n) const
    {
        const auto& x = vertex(n);
        return mesh_.dim == 2 ? fmt::format("vertex {} ({:g} {:g})", n, x[0], x[1])
                              : fmt::format("vertex {} ({:g} {:g} {:g})", n, x[0], x[1], x[2]);
    }

    void vertices() const
    {
        if (mesh_.vertices.empty())
            fail("found no vertices");
        for (std::size_t n = 0; n < mesh_.vertices.size(); ++n)
        {
            const auto& x = mesh_.vertices[n];
            if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
                fail(fmt::format("found vertex {} at ({:g} {:g} {:g}), allowed are finite coordinates", n, x[0], x[1],
                                 x[2]));
            if (mesh_.dim == 2 && x[2] != 0)
                fail(fmt::format("found vertex {} at z = {:g}, allowed is 0 in 2D", n, x[2]));
        }
    }

    void indices() const
    {
        const auto count = Index(mesh_.vertices.size());
        if (mesh_.elements.empty())
            fail(fmt::format("found no {}s", word()));
        for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
        {
            for (std::size_t k = 0; k < corners_; ++k)
                if (const Index n = mesh_.elements[e][k]; n < 0 || n >= count)
                    fail(fmt::format("found {} {} of vertex {}, allowed are 0 to {}", word(), e, n, count - 1));
            if (mesh_.dim == 2 && mesh_.elements[e][2] != -1)
                fail(fmt::format("found segment {} with a third vertex {}, allowed is -1 (none) in 2D", e,
                                 mesh_.elements[e][2]));
        }
    }

    void sizes() const
    {
        for (std::size_t n = 0; n < mesh_.elements.size(); ++n)
        {
            const auto& e = mesh_.elements[n];
            const Vector3 a = minus(vertex(e[1]), vertex(e[0]));
            bool none = !(length(a) > 0);
            if (mesh_.dim == 3)
            {
                const Vector3 b = minus(vertex(e[2]), vertex(e[0])), c = minus(vertex(e[2]), vertex(e[1]));
                const double longest = std::max({length(a), length(b), length(c)});
                none = !(length(cross(a, b)) > 1e-12 * longest * longest);
            }
            if (none)
                fail(fmt::format("found {} {} of no size at {}", word(), n, at(e[0])));
        }
    }

    void twice() const
    {
        std::vector<std::pair<std::array<Index, 3>, std::size_t>> keys;
        for (std::size_t n = 0; n < mesh_.elements.size(); ++n)
        {
            auto key = mesh_.elements[n];
            std::sort(key.begin(), key.end());
            keys.emplace_back(key, n);
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t n = 0; n + 1 < keys.size(); ++n)
            if (keys[n].first == keys[n + 1].first)
                fail(fmt::format("found {}s {} and {} of the same vertices, allowed is one of them", word(),
                                 keys[n].second, keys[n + 1].second));
    }

    void places() const
    {
        const auto first = firstAtPlace(mesh_);
        for (std::size_t n = 0; n < first.size(); ++n)
            if (first[n] != Index(n))
                fail(fmt::format("found {} at the place of vertex {}; a closed surface has one vertex there: merge "
                                 "them and let its {}s name the one",
                                 at(Index(n)), first[n], word()));
    }

    /// 2D: one segment comes, one goes.
    void joints() const
    {
        std::vector<Index> from(mesh_.vertices.size(), -1), to = from;
        const auto join = [&](std::vector<Index>& ends, Index n, std::size_t e, const char* verb) {
            auto& other = ends[std::size_t(n)];
            if (other >= 0)
                fail(fmt::format("found segments {} and {} that both {} at {}, allowed is a line that does not branch, "
                                 "whose segments all face to the same side",
                                 other, e, verb, at(n)));
            other = Index(e);
        };
        for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
        {
            join(from, mesh_.elements[e][0], e, "begin");
            join(to, mesh_.elements[e][1], e, "end");
        }
        for (std::size_t n = 0; closed_ && n < from.size(); ++n)
            if ((from[n] < 0) != (to[n] < 0))
                fail(fmt::format("found an open end of segment {} at {}, allowed is a closed polygon",
                                 std::max(from[n], to[n]), at(Index(n))));
    }

    struct Edge
    {
        Index low, high;
        std::size_t element;
        bool up; ///< the element goes from low to high
    };

    /// 3D: two triangles, that go along their edge in opposite directions.
    void edges() const
    {
        std::vector<Edge> all;
        all.reserve(3 * mesh_.elements.size());
        for (std::size_t n = 0; n < mesh_.elements.size(); ++n)
            for (std::size_t k = 0; k < 3; ++k)
            {
                const Index a = mesh_.elements[n][k], b = mesh_.elements[n][(k + 1) % 3];
                all.push_back({std::min(a, b), std::max(a, b), n, a < b});
            }
        std::sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) {
            return std::tie(a.low, a.high, a.element) < std::tie(b.low, b.high, b.element);
        });
        for (std::size_t n = 0; n < all.size();)
        {
            std::size_t next = n + 1;
            while (next < all.size() && all[next].low == all[n].low && all[next].high == all[n].high)
                ++next;
            const auto where = [&] { return fmt::format("from {} to {}", at(all[n].low), at(all[n].high)); };
            if (next - n > 2)
                fail(fmt::format("found {} triangles ({}, {}, {}{}) at the edge {}, allowed are two", next - n,
                                 all[n].element, all[n + 1].element, all[n + 2].element, next - n > 3 ? ", ..." : "",
                                 where()));
            if (next - n == 2 && all[n].up == all[n + 1].up)
                fail(fmt::format("found triangles {} and {} that face against each other at the edge {}, allowed are "
                                 "triangles that all face outward",
                                 all[n].element, all[n + 1].element, where()));
            if (next - n == 1 && closed_)
                fail(fmt::format("found an open edge of triangle {} {}, allowed is a closed surface", all[n].element,
                                 where()));
            n = next;
        }
    }

    void belong() const
    {
        std::vector<bool> used(mesh_.vertices.size());
        for (const auto& e : mesh_.elements)
            for (std::size_t k = 0; k < corners_; ++k)
                used[std::size_t(e[k])] = true;
        if (const auto none = std::find(used.begin(), used.end(), false); none != used.end())
            fail(fmt::format("found {} that belongs to no {}", at(none - used.begin()), word()));
    }

    void whole() const
    {
        if (const double volume = enclosedVolume(mesh_); !(volume > 0))
            fail(fmt::format("found {} {:g}, so it faces inward; swap the first two vertices of every {}",
                             mesh_.dim == 2 ? "an area of" : "a volume of", volume, word()));
        auto elements = mesh_.elements;
        if (mesh_.dim == 2)
            for (auto& e : elements)
                e[2] = 0;
        try
        {
            nodal::RigidSurface(mesh_.dim, mesh_.vertices, std::move(elements), {name_}); // cuts
        }
        catch (const InputError& e)
        {
            throw CouplingError(Fault::badSurface, std::string("surface ") + e.what());
        }
    }

    const SurfaceMesh& mesh_;
    bool closed_;
    const std::string& name_;
    std::size_t corners_;
};
} // namespace

void check(const SurfaceMesh& mesh, bool closed, const std::string& name)
{
    Checks(mesh, closed, name).all();
}
} // namespace mpm::coupling

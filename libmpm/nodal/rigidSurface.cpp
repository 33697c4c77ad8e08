#include "nodal/rigidSurface.hpp"

#include "nodal/vectors.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <unordered_map>

namespace mpm::nodal
{
namespace
{
std::string place(const Vector3& x, int dim)
{
    return dim == 2 ? fmt::format("({:g} {:g})", x[0], x[1]) : fmt::format("({:g} {:g} {:g})", x[0], x[1], x[2]);
}

double boxDistance2(const Vector3& low, const Vector3& high, const Vector3& x)
{
    double sum = 0;
    for (std::size_t a = 0; a < 3; ++a)
    {
        const double d = std::max({low[a] - x[a], 0.0, x[a] - high[a]});
        sum += d * d;
    }
    return sum;
}
} // namespace

RigidSurface::RigidSurface(int dim, std::vector<Vector3> points, std::vector<Element> elements, const Location& where)
    : dim_(dim), points_(std::move(points)), elements_(std::move(elements))
{
    if (elements_.size() < (dim == 2 ? 3u : 4u))
        throw InputError(where, fmt::format("found a surface of {} {}, allowed are {} or more", elements_.size(),
                                            dim == 2 ? "segments" : "triangles", dim == 2 ? 3 : 4));
    low_ = high_ = points_.front();
    for (const auto& p : points_)
        for (std::size_t a = 0; a < 3; ++a)
        {
            if (!std::isfinite(p[a]))
                throw InputError(where, "found a point that is not finite");
            low_[a] = std::min(low_[a], p[a]);
            high_[a] = std::max(high_[a], p[a]);
        }
    weld();
    orient(where);
    makeNormals();
    order_.resize(elements_.size());
    for (std::size_t e = 0; e < order_.size(); ++e)
        order_[e] = Index(e);
    makeBox(0, Index(order_.size()));
    refuseCuts(where);
}

RigidSurface RigidSurface::polygon(const std::vector<Vector3>& corners, const Location& where)
{
    std::vector<Element> elements;
    for (std::size_t k = 0; k < corners.size(); ++k)
        elements.push_back({Index(k), Index((k + 1) % corners.size()), 0});
    if (corners.size() < 3)
        throw InputError(where, fmt::format("found a polygon of {} points, allowed are 3 or more", corners.size()));
    return RigidSurface(2, corners, std::move(elements), where);
}

const std::vector<RigidSurface::Element>& RigidSurface::boxTriangles()
{
    static const std::vector<Element> triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return triangles;
}

/// Points of one place become one: those in the same or a neighbouring box of a fine lattice.
void RigidSurface::weld()
{
    const double tolerance = 1e-9 * length(minus(high_, low_));
    std::unordered_map<std::size_t, std::vector<Index>> cells;
    const auto key = [](Index i, Index j, Index k) {
        return std::size_t(i) * 73856093u ^ std::size_t(j) * 19349663u ^ std::size_t(k) * 83492791u;
    };
    std::vector<Vector3> kept;
    std::vector<Index> name(points_.size());
    for (std::size_t n = 0; n < points_.size(); ++n)
    {
        Index cell[3];
        for (std::size_t a = 0; a < 3; ++a)
            cell[a] = Index(std::floor((points_[n][a] - low_[a]) / (4 * tolerance)));
        Index same = -1;
        for (Index i = cell[0] - 1; i <= cell[0] + 1 && same < 0; ++i)
            for (Index j = cell[1] - 1; j <= cell[1] + 1 && same < 0; ++j)
                for (Index k = cell[2] - 1; k <= cell[2] + 1 && same < 0; ++k)
                    if (const auto found = cells.find(key(i, j, k)); found != cells.end())
                        for (const Index other : found->second)
                            if (length(minus(kept[std::size_t(other)], points_[n])) <= tolerance)
                                same = other;
        if (same < 0)
        {
            same = Index(kept.size());
            kept.push_back(points_[n]);
            cells[key(cell[0], cell[1], cell[2])].push_back(same);
        }
        name[n] = same;
    }
    points_ = std::move(kept);
    for (auto& e : elements_)
        for (auto& n : e)
            n = name[std::size_t(n)];
}

void RigidSurface::orient(const Location& where)
{
    for (const auto& e : elements_)
        if (e[0] == e[1] || (dim_ == 3 && (e[1] == e[2] || e[2] == e[0])))
            throw InputError(where, fmt::format("found {} of no size at {}", dim_ == 2 ? "a segment" : "a triangle",
                                                place(points_[std::size_t(e[0])], dim_)));
    dim_ == 2 ? closed2D(where) : closed3D(where);
    measure();
    if (volume_ < 0)
    {
        for (auto& e : elements_)
            std::swap(e[0], e[1]);
        measure();
    }
    if (!(volume_ > 1e-12 * std::pow(length(minus(high_, low_)), dim_)))
        throw InputError(where, "found a surface that holds no volume");
}

void RigidSurface::closed2D(const Location& where) const
{
    std::vector<int> from(points_.size()), to(points_.size());
    for (const auto& e : elements_)
    {
        ++from[std::size_t(e[0])];
        ++to[std::size_t(e[1])];
    }
    for (std::size_t n = 0; n < points_.size(); ++n)
        if (from[n] != 1 || to[n] != 1)
            throw InputError(where,
                             fmt::format("found {} at {}, allowed is a closed polygon that does not touch itself",
                                         from[n] + to[n] < 2   ? "an open end"
                                         : from[n] + to[n] > 2 ? "more than two segments"
                                                               : "segments that face against each other",
                                         place(points_[n], 2)));
}

void RigidSurface::closed3D(const Location& where) const
{
    std::map<std::pair<Index, Index>, int> directed;
    for (const auto& e : elements_)
        for (std::size_t k = 0; k < 3; ++k)
            ++directed[{e[k], e[(k + 1) % 3]}];
    const auto fail = [&](const std::pair<Index, Index>& edge, const std::string& what) {
        throw InputError(where, fmt::format("found {} at the edge from {} to {}, allowed is a closed surface of "
                                            "triangles that all face outward",
                                            what, place(points_[std::size_t(edge.first)], 3),
                                            place(points_[std::size_t(edge.second)], 3)));
    };
    for (const auto& [edge, count] : directed)
    {
        const auto back = directed.find({edge.second, edge.first});
        const int other = back == directed.end() ? 0 : back->second;
        if (count + other > 2)
            fail(edge, fmt::format("{} triangles", count + other));
        if (count == 2)
            fail(edge, "a triangle that faces the other way than its neighbour");
        if (other == 0)
            fail(edge, "an open surface");
    }
}

/// Volume and centroid by the divergence theorem.
void RigidSurface::measure()
{
    volume_ = 0;
    Vector3 moment{};
    const Vector3 origin = points_.front();
    for (const auto& e : elements_)
    {
        const Vector3 a = minus(points_[std::size_t(e[0])], origin), b = minus(points_[std::size_t(e[1])], origin);
        const Vector3 c = dim_ == 3 ? minus(points_[std::size_t(e[2])], origin) : Vector3{};
        const double part = dim_ == 2 ? 0.5 * (a[0] * b[1] - a[1] * b[0]) : dot(a, cross(b, c)) / 6;
        volume_ += part;
        moment = plus(moment, times(part / (dim_ == 2 ? 3 : 4), plus(plus(a, b), c)));
    }
    centroid_ = volume_ != 0 ? plus(origin, times(1 / volume_, moment)) : origin;
}

void RigidSurface::makeNormals()
{
    normals_.resize(elements_.size());
    cornerNormals_.assign(points_.size(), {});
    std::map<std::pair<Index, Index>, Vector3> edges;
    for (std::size_t n = 0; n < elements_.size(); ++n)
    {
        const auto& e = elements_[n];
        const Vector3 &a = points_[std::size_t(e[0])], &b = points_[std::size_t(e[1])];
        if (dim_ == 2)
        {
            const Vector3 d = minus(b, a);
            normals_[n] = times(1 / length(d), {d[1], -d[0], 0});
            for (const Index corner : {e[0], e[1]})
                cornerNormals_[std::size_t(corner)] = plus(cornerNormals_[std::size_t(corner)], normals_[n]);
            continue;
        }
        const Vector3 area = cross(minus(b, a), minus(points_[std::size_t(e[2])], a));
        normals_[n] = length(area) > 0 ? times(1 / length(area), area) : Vector3{};
        for (std::size_t k = 0; k < 3; ++k)
        {
            const Vector3 &p = points_[std::size_t(e[k])], to = minus(points_[std::size_t(e[(k + 1) % 3])], p),
                          from = minus(points_[std::size_t(e[(k + 2) % 3])], p);
            const double angle = std::atan2(length(cross(to, from)), dot(to, from));
            auto& corner = cornerNormals_[std::size_t(e[k])];
            corner = plus(corner, times(angle, normals_[n]));
            auto& edge = edges[std::minmax(e[k], e[(k + 1) % 3])];
            edge = plus(edge, normals_[n]);
        }
    }
    if (dim_ == 3)
        for (const auto& e : elements_)
        {
            edgeNormals_.emplace_back();
            for (std::size_t k = 0; k < 3; ++k)
                edgeNormals_.back()[k] = edges[std::minmax(e[k], e[(k + 1) % 3])];
        }
}

Vector3 RigidSurface::centre(Index e) const
{
    const auto& n = elements_[std::size_t(e)];
    Vector3 sum{};
    for (std::size_t k = 0; k < std::size_t(dim_); ++k)
        sum = plus(sum, points_[std::size_t(n[k])]);
    return times(1.0 / dim_, sum);
}

/// The box around its elements.
void RigidSurface::fitLeaf(Box& box) const
{
    constexpr double ever = std::numeric_limits<double>::infinity();
    box.low = {ever, ever, ever};
    box.high = {-ever, -ever, -ever};
    for (Index n = box.first; n < box.first + box.count; ++n)
        for (std::size_t k = 0; k < std::size_t(dim_); ++k)
            for (std::size_t a = 0; a < 3; ++a)
            {
                const double x = points_[std::size_t(elements_[std::size_t(order_[std::size_t(n)])][k])][a];
                box.low[a] = std::min(box.low[a], x);
                box.high[a] = std::max(box.high[a], x);
            }
}

bool RigidSurface::deform(const std::vector<Vector3>& points)
{
    points_ = points;
    measure();
    if (!(volume_ > 0) || !std::isfinite(volume_))
        return false;
    edgeNormals_.clear();
    makeNormals();
    for (auto box = boxes_.rbegin(); box != boxes_.rend(); ++box) // children stand behind their parents
        if (box->left < 0)
            fitLeaf(*box);
        else
            for (std::size_t a = 0; a < 3; ++a)
            {
                const Box &l = boxes_[std::size_t(box->left)], &r = boxes_[std::size_t(box->right)];
                box->low[a] = std::min(l.low[a], r.low[a]);
                box->high[a] = std::max(l.high[a], r.high[a]);
            }
    low_ = boxes_.front().low;
    high_ = boxes_.front().high;
    return true;
}

Index RigidSurface::makeBox(Index first, Index count)
{
    Box box{{}, {}, first, count};
    fitLeaf(box);
    const Index me = Index(boxes_.size());
    boxes_.push_back(box);
    if (count <= 4)
        return me;
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a)
        if (box.high[a] - box.low[a] > box.high[axis] - box.low[axis])
            axis = a;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](Index e, Index f) {
        const double x = centre(e)[axis], y = centre(f)[axis];
        return x < y || (x == y && e < f);
    });
    const Index left = makeBox(first, count / 2), right = makeBox(first + count / 2, count - count / 2);
    boxes_[std::size_t(me)].left = left;
    boxes_[std::size_t(me)].right = right;
    return me;
}

RigidSurface::Foot RigidSurface::foot(Index e, const Vector3& x) const
{
    const auto& n = elements_[std::size_t(e)];
    const Vector3 &a = points_[std::size_t(n[0])], &b = points_[std::size_t(n[1])];
    const Vector3 ab = minus(b, a), ax = minus(x, a);
    if (dim_ == 2)
    {
        const double t = dot(ab, ax) / dot(ab, ab);
        if (t <= 0)
            return {a, 4, {1, 0, 0}};
        return t >= 1 ? Foot{b, 5, {0, 1, 0}} : Foot{plus(a, times(t, ab)), 0, {1 - t, t, 0}};
    }
    const Vector3& c = points_[std::size_t(n[2])];
    const Vector3 ac = minus(c, a), bx = minus(x, b), cx = minus(x, c);
    const double d1 = dot(ab, ax), d2 = dot(ac, ax), d3 = dot(ab, bx), d4 = dot(ac, bx), d5 = dot(ab, cx),
                 d6 = dot(ac, cx);
    if (d1 <= 0 && d2 <= 0)
        return {a, 4, {1, 0, 0}};
    if (d3 >= 0 && d4 <= d3)
        return {b, 5, {0, 1, 0}};
    if (d6 >= 0 && d5 <= d6)
        return {c, 6, {0, 0, 1}};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const auto on = [&](int feature, double wb, double wc) {
        return Foot{plus(a, plus(times(wb, ab), times(wc, ac))), feature, {1 - wb - wc, wb, wc}};
    };
    if (vc <= 0 && d1 >= 0 && d3 <= 0)
        return on(1, d1 / (d1 - d3), 0);
    if (vb <= 0 && d2 >= 0 && d6 <= 0)
        return on(3, 0, d2 / (d2 - d6));
    if (const double bc = (d4 - d3) / (d4 - d3 + d5 - d6); va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
        return on(2, 1 - bc, bc);
    const double all = 1 / (va + vb + vc);
    return on(0, vb * all, vc * all);
}

double RigidSurface::depth(double h) const
{
    double most = 0;
    for (Index e = 0; e < Index(elements_.size()); ++e)
    {
        const Vector3 inside = minus(centre(e), times(0.5 * h, nearest(centre(e)).normal));
        most = std::max(most, -nearest(inside).distance);
    }
    return most;
}

RigidSurface::Nearest RigidSurface::nearest(const Vector3& x) const
{
    double best = std::numeric_limits<double>::infinity();
    Index element = 0;
    Foot found;
    std::array<Index, 64> stack{};
    std::size_t depth = 1; // box 0
    while (depth > 0)
    {
        const Box& box = boxes_[std::size_t(stack[--depth])];
        if (!(boxDistance2(box.low, box.high, x) < best))
            continue;
        if (box.left < 0)
            for (Index n = box.first; n < box.first + box.count; ++n)
            {
                const Index e = order_[std::size_t(n)];
                const Foot f = foot(e, x);
                const Vector3 d = minus(x, f.point);
                if (const double square = dot(d, d); square < best)
                {
                    best = square;
                    element = e;
                    found = f;
                }
            }
        else
        {
            const Box &l = boxes_[std::size_t(box.left)], &r = boxes_[std::size_t(box.right)];
            const bool leftFirst = boxDistance2(l.low, l.high, x) <= boxDistance2(r.low, r.high, x);
            stack[depth++] = leftFirst ? box.right : box.left;
            stack[depth++] = leftFirst ? box.left : box.right;
        }
    }
    const auto e = std::size_t(element);
    Vector3 normal = normals_[e];
    if (found.feature >= 4)
        normal = cornerNormals_[std::size_t(elements_[e][std::size_t(found.feature - 4)])];
    else if (found.feature >= 1)
        normal = edgeNormals_[e][std::size_t(found.feature - 1)];
    normal = times(1 / length(normal), normal);
    const Vector3 d = minus(x, found.point);
    const double distance = std::sqrt(best);
    Nearest out{dot(d, normal) < 0 ? -distance : distance, found.point, normal, element, found.weights};
    if (distance > 1e-6 * length(minus(high_, low_)))
        out.normal = times(1 / out.distance, d);
    return out;
}
} // namespace mpm::nodal

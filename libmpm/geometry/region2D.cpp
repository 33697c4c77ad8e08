#include "geometry/region2D.hpp"

#include "base/error.hpp"
#include "geometry/rowIntegral.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Polygon_set_2.h>

#include <algorithm>
#include <fmt/format.h>

namespace mpm::geometry
{
namespace
{
using Predicates = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Predicates::Point_2;

Point point(const Vector3& p)
{
    return {p[0], p[1]};
}

/// Where two segments of the boundary meet improperly; empty if they do not.
std::optional<Vector3> meeting(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
    using Segment = Exact::Segment_2;
    const auto exact = [](const Vector3& p) { return Exact::Point_2(p[0], p[1]); };
    const auto common = CGAL::intersection(Segment(exact(a), exact(b)), Segment(exact(c), exact(d)));
    if (!common)
        return std::nullopt;
    const auto rounded = [](const Exact::Point_2& p) {
        return Vector3{CGAL::to_double(p.x()), CGAL::to_double(p.y()), 0};
    };
    if (const auto* p = boost::get<Exact::Point_2>(&*common))
    {
        const bool endOfFirst = *p == exact(a) || *p == exact(b);
        const bool endOfSecond = *p == exact(c) || *p == exact(d);
        return endOfFirst && endOfSecond ? std::nullopt : std::optional(rounded(*p));
    }
    const auto& shared = boost::get<Segment>(*common);
    return rounded(CGAL::midpoint(shared.source(), shared.target()));
}
} // namespace

Region2D::Region2D(std::string name, std::vector<Loop> loops) : Region(std::move(name), 2), loops_(std::move(loops))
{
    checkLoops();
    orient();
    measure();
}

void Region2D::checkLoops() const
{
    if (loops_.empty())
        throw InputError(fmt::format("region '{}' has no boundary", name_));
    for (const Loop& loop : loops_)
    {
        if (loop.size() < 3)
            throw InputError(fmt::format("region '{}': a boundary loop at {} has {} corners; at least 3 are needed",
                                         name_, loop.empty() ? "" : placeText(loop[0], 2), loop.size()));
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (point(loop[i]) == point(loop[(i + 1) % loop.size()]))
                throw InputError(fmt::format("region '{}': an edge of no length at {}", name_, placeText(loop[i], 2)));
    }
}

/// Throws at edges that cross, and returns the edges (loop, edge in it) that meet another loop at a corner.
std::vector<std::pair<std::size_t, std::size_t>> Region2D::checkCrossings() const
{
    struct Item
    {
        std::size_t loop, edge;
    };
    std::vector<Item> items;
    for (std::size_t l = 0; l < loops_.size(); ++l)
        for (std::size_t e = 0; e < loops_[l].size(); ++e)
            items.push_back({l, e});
    const auto from = [&](const Item& i) -> const Vector3& { return loops_[i.loop][i.edge]; };
    const auto to = [&](const Item& i) -> const Vector3& {
        return loops_[i.loop][(i.edge + 1) % loops_[i.loop].size()];
    };

    using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 2, const Item*>;
    std::vector<Box> boxes;
    for (const Item& i : items)
        boxes.emplace_back(point(from(i)).bbox() + point(to(i)).bbox(), &i);
    std::vector<std::pair<std::size_t, std::size_t>> touching;
    std::optional<Vector3> crossing;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& p, const Box& q) {
        const Item &a = *p.info(), &b = *q.info();
        if (crossing)
            return;
        crossing = meeting(from(a), to(a), from(b), to(b));
        const auto same = [](const Vector3& u, const Vector3& v) { return u[0] == v[0] && u[1] == v[1]; };
        const bool share = same(from(a), from(b)) || same(from(a), to(b)) || same(to(a), from(b)) || same(to(a), to(b));
        if (crossing || !share)
            return;
        if (a.loop != b.loop)
        {
            touching.emplace_back(a.loop, a.edge);
            touching.emplace_back(b.loop, b.edge);
        }
        else if (const std::size_t gap = (a.edge + loops_[a.loop].size() - b.edge) % loops_[a.loop].size();
                 gap != 1 && gap != loops_[a.loop].size() - 1)
            crossing = same(from(a), from(b)) || same(from(a), to(b)) ? from(a) : to(a);
    });
    if (crossing)
        throw InputError(
            fmt::format("region '{}': its boundary crosses or touches itself at {}; the curves must form simple "
                        "closed loops, holes strictly inside",
                        name_, placeText(*crossing, 2)));
    return touching;
}

/// Number of other loops around p.
std::size_t Region2D::depthOf(const Vector3& p, std::size_t loop, bool& onOther) const
{
    std::size_t depth = 0;
    onOther = false;
    for (std::size_t l = 0; l < loops_.size(); ++l)
    {
        if (l == loop)
            continue;
        std::vector<Point> corners;
        for (const Vector3& c : loops_[l])
            corners.push_back(point(c));
        const auto side = CGAL::bounded_side_2(corners.begin(), corners.end(), point(p), Predicates());
        onOther = onOther || side == CGAL::ON_BOUNDARY;
        depth += side == CGAL::ON_BOUNDED_SIDE;
    }
    return depth;
}

void Region2D::orient()
{
    const auto touching = checkCrossings();
    const auto middle = [&](std::size_t l, std::size_t e) {
        const Vector3 &p = loops_[l][e], &q = loops_[l][(e + 1) % loops_[l].size()];
        return Vector3{0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0};
    };
    std::vector<std::size_t> depth(loops_.size());
    for (std::size_t l = 0; l < loops_.size(); ++l)
    {
        bool onOther = true;
        for (std::size_t e = 0; e < loops_[l].size() && onOther; ++e)
            depth[l] = depthOf(loops_[l][e], l, onOther);
        if (onOther)
            depth[l] = depthOf(middle(l, 0), l, onOther);
    }
    for (const auto& [l, e] : touching)
        if (bool onOther = false; depthOf(middle(l, e), l, onOther) != depth[l])
            throw InputError(fmt::format("region '{}': two of its boundary loops cross at the corner {}", name_,
                                         placeText(loops_[l][e], 2)));
    reversed_.resize(loops_.size());
    double largestArea = 0;
    for (std::size_t l = 0; l < loops_.size(); ++l)
    {
        std::vector<Point> corners;
        for (const Vector3& c : loops_[l])
            corners.push_back(point(c));
        island_.push_back(depth[l] % 2 == 0);
        const double area =
            std::abs(CGAL::to_double(CGAL::polygon_area_2(corners.begin(), corners.end(), Predicates())));
        if (area > largestArea)
            largestArea = area, largest_ = l;
        const bool counterClockwise =
            CGAL::orientation_2(corners.begin(), corners.end(), Predicates()) == CGAL::COUNTERCLOCKWISE;
        reversed_[l] = island_[l] != counterClockwise;
        if (reversed_[l])
            std::reverse(loops_[l].begin(), loops_[l].end());
    }
}

void Region2D::measure()
{
    for (const Loop& loop : loops_)
        for (std::size_t i = 0; i < loop.size(); ++i)
        {
            vertices_.push_back({loop[i][0], loop[i][1], 0});
            edges_.push_back({loop[i], loop[(i + 1) % loop.size()]});
        }
    std::stable_sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.low() < b.low(); });
    lower_ = upper_ = vertices_[0];
    for (const Vector3& v : vertices_)
        for (std::size_t k = 0; k < 2; ++k)
        {
            lower_[k] = std::min(lower_[k], v[k]);
            upper_[k] = std::max(upper_[k], v[k]);
        }
    long double area = 0, mx = 0, my = 0; // relative to the lower corner, against cancellation
    for (const Edge& e : edges_)
    {
        const long double xa = e.from[0] - lower_[0], ya = e.from[1] - lower_[1];
        const long double xb = e.to[0] - lower_[0], yb = e.to[1] - lower_[1];
        const long double cross = xa * yb - xb * ya;
        area += cross / 2;
        mx += cross * (xa + xb) / 6;
        my += cross * (ya + yb) / 6;
    }
    volume_ = double(area);
    centroid_ = {lower_[0] + double(mx / area), lower_[1] + double(my / area), 0};
}

/// Counts the edges to the right of p; exact, with p on an edge counted as inside.
bool Region2D::inside(const Vector3& p, const std::vector<const Edge*>& edges)
{
    bool odd = false;
    for (const Edge* e : edges)
    {
        const Vector3& low = e->from[1] <= e->to[1] ? e->from : e->to;
        const Vector3& high = e->from[1] <= e->to[1] ? e->to : e->from;
        if (p[1] < low[1] || p[1] > high[1])
            continue;
        if (low[1] == high[1])
        {
            if (std::min(low[0], high[0]) <= p[0] && p[0] <= std::max(low[0], high[0]))
                return true;
            continue;
        }
        const auto side = CGAL::orientation(point(low), point(high), point(p));
        if (side == CGAL::COLLINEAR)
            return true;
        odd ^= side == CGAL::LEFT_TURN && p[1] < high[1];
    }
    return odd;
}

bool Region2D::contains(const Vector3& p) const
{
    std::vector<const Edge*> all;
    for (const Edge& e : edges_)
        all.push_back(&e);
    return inside(p, all);
}

void Region2D::forEachRow(const BoxTiling& tiling, const Row& visit) const
{
    RowIntegral integral(2);
    std::vector<const Edge*> active;
    std::vector<BoxPart> parts;
    std::vector<double> xPlanes;
    const std::vector<double> yPlanes = tiling.yPlanes(0);
    std::size_t next = 0;
    for (std::size_t j = 0; j + 1 < yPlanes.size(); ++j)
    {
        const double y0 = yPlanes[j], y1 = yPlanes[j + 1];
        std::erase_if(active, [&](const Edge* e) { return e->high() <= y0; });
        for (; next < edges_.size() && edges_[next].low() < y1; ++next)
            if (edges_[next].high() > y0)
                active.push_back(&edges_[next]);
        if (active.empty())
            continue;
        tiling.xPlanes(Index(j), 0, xPlanes);
        integral.start(xPlanes, {y0, y1, 0, 1});
        for (const Edge* e : active)
        {
            const bool up = e->from[1] < e->to[1];
            const Vector3& low = up ? e->from : e->to;
            const Vector3& high = up ? e->to : e->from;
            if (low[1] == high[1] && (low[1] <= y0 || low[1] >= y1))
                continue;
            const auto at = [&](double y) {
                return Vector3{low[0] + (high[0] - low[0]) * ((y - low[1]) / (high[1] - low[1])), y, 0};
            };
            const Vector3 a = low[1] < y0 ? at(y0) : low, b = high[1] > y1 ? at(y1) : high;
            up ? integral.addSegment(a, b) : integral.addSegment(b, a);
        }
        Vector3 bad{};
        if (!integral.finish([&](const Vector3& p) { return inside(p, active); }, parts, bad))
            throw InputError(
                fmt::format("region '{}': its boundary does not enclose an area at {}", name_, placeText(bad, 2)));
        if (!parts.empty())
            visit(Index(j), 0, parts);
    }
}

namespace
{
CGAL::Polygon_set_2<Exact> exactSet(const Region2D& region)
{
    using Polygon = CGAL::Polygon_2<Exact>;
    CGAL::Polygon_set_2<Exact> islands, holes;
    for (std::size_t l = 0; l < region.loops(); ++l)
    {
        Polygon polygon;
        for (const Vector3& c : region.loop(l))
            polygon.push_back({c[0], c[1]});
        if (polygon.is_counterclockwise_oriented())
            islands.symmetric_difference(polygon);
        else
        {
            polygon.reverse_orientation();
            holes.symmetric_difference(polygon);
        }
    }
    islands.symmetric_difference(holes);
    return islands;
}
} // namespace

double overlap(const Region2D& a, const Region2D& b, Vector3& place)
{
    for (std::size_t k = 0; k < 2; ++k)
        if (a.lower()[k] >= b.upper()[k] || b.lower()[k] >= a.upper()[k])
            return 0;
    auto common = exactSet(a);
    common.intersection(exactSet(b));
    std::vector<CGAL::Polygon_with_holes_2<Exact>> parts;
    common.polygons_with_holes(std::back_inserter(parts));
    double area = 0, largest = 0;
    for (const auto& part : parts)
    {
        double own = CGAL::to_double(part.outer_boundary().area());
        for (const auto& hole : part.holes())
            own += CGAL::to_double(hole.area());
        area += own;
        if (own <= largest)
            continue;
        largest = own;
        const auto& corner = *part.outer_boundary().vertices_begin();
        place = {CGAL::to_double(corner.x()), CGAL::to_double(corner.y()), 0};
    }
    return area;
}
} // namespace mpm::geometry

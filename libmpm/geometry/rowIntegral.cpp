#include "geometry/rowIntegral.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm::geometry
{
namespace
{
/// Round-off of a part, in units of the box: below it a box counts as empty, above 1 minus it as whole.
constexpr double dust = 1e-14;
constexpr double wholeTolerance2D = 1e-13;
constexpr double wholeTolerance3D = 1e-12;
/// Deviation from 0 or 1 that shows that the surface does not bound a volume.
constexpr double closedTolerance = 1e-9;
} // namespace

void clipPolygon(const std::vector<Vector3>& polygon, int axis, double plane, bool keepBelow, std::vector<Vector3>& out)
{
    out.clear();
    const auto a = std::size_t(axis);
    const auto kept = [&](const Vector3& p) { return keepBelow ? p[a] <= plane : p[a] >= plane; };
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vector3& p = polygon[i];
        const Vector3& q = polygon[(i + 1) % polygon.size()];
        if (kept(p))
            out.push_back(p);
        if (kept(p) == kept(q) || p[a] == plane || q[a] == plane)
            continue;
        // From the lower end whichever way the edge runs, so that neighbours cut it at the same point.
        const Vector3& low = p[a] < q[a] ? p : q;
        const Vector3& high = p[a] < q[a] ? q : p;
        const double t = (plane - low[a]) / (high[a] - low[a]);
        Vector3 cut;
        for (std::size_t k = 0; k < 3; ++k)
            cut[k] = low[k] + t * (high[k] - low[k]);
        cut[a] = plane;
        out.push_back(cut);
    }
}

void RowIntegral::Sums::addBeyond(const Sums& own)
{
    area += own.area;
    ay += own.ay;
    az += own.az;
    for (std::size_t f = 0; f < 4; ++f)
        beyond[f] += own.beyond[f];
}

void RowIntegral::start(const std::vector<double>& xPlanes, const RowRange& range)
{
    planes_ = &xPlanes;
    range_ = range;
    for (Index i = first_; i <= last_; ++i)
        sums_[std::size_t(i)] = Sums{};
    sums_.resize(xPlanes.size()); // the last one: beyond the row
    first_ = Index(sums_.size());
    last_ = -1;
}

Index RowIntegral::boxOf(double x) const
{
    const auto& planes = *planes_;
    const Index k = Index(std::upper_bound(planes.begin(), planes.end(), x) - planes.begin()) - 1;
    return std::clamp<Index>(k, -1, Index(planes.size()) - 1);
}

RowIntegral::Sums& RowIntegral::touch(Index box)
{
    Sums& sums = sums_[std::size_t(box)];
    if (!sums.touched)
    {
        constexpr double inf = std::numeric_limits<double>::infinity();
        sums.touched = true;
        sums.lower = {inf, inf, inf};
        sums.upper = {-inf, -inf, -inf};
        first_ = std::min(first_, box);
        last_ = std::max(last_, box);
    }
    return sums;
}

void RowIntegral::addSegment(const Vector3& a, const Vector3& b)
{
    const auto& planes = *planes_;
    const bool forward = a[0] <= b[0];
    Vector3 low = forward ? a : b;
    const Vector3 high = forward ? b : a;
    const auto add = [&](Index box, const Vector3& p, const Vector3& q) {
        forward ? addToBox(box, p, q) : addToBox(box, q, p);
    };
    Index box = boxOf(low[0]);
    for (; box + 1 < Index(planes.size()) && high[0] > planes[std::size_t(box + 1)]; ++box)
    {
        const double plane = planes[std::size_t(box + 1)];
        const double t = (plane - low[0]) / (high[0] - low[0]);
        const Vector3 cut{plane, low[1] + t * (high[1] - low[1]), 0};
        add(box, low, cut);
        low = cut;
    }
    add(box, low, high);
}

void RowIntegral::addToBox(Index box, const Vector3& a, const Vector3& b)
{
    if (box < 0)
        return; // at smaller x than the row: encloses none of its boxes
    Sums& s = touch(box);
    const double x0 = (*planes_)[std::size_t(box)];
    const double xa = a[0] - x0, xb = b[0] - x0;
    const double ya = a[1] - range_.y0, yb = b[1] - range_.y0, dy = b[1] - a[1];
    s.area += dy;
    s.ay += 0.5 * dy * (ya + yb);
    s.volume += 0.5 * dy * (xa + xb);
    s.mx += dy / 6 * (xa * xa + xa * xb + xb * xb);
    s.my += dy / 6 * (2 * xa * ya + xa * yb + xb * ya + 2 * xb * yb);
    const auto end = [&](const Vector3& p, double x, double sign) {
        if (p[1] == range_.y0)
            s.contact[0] -= sign * x, s.beyond[0] -= sign;
        else if (p[1] == range_.y1)
            s.contact[1] += sign * x, s.beyond[1] += sign;
        for (std::size_t k = 0; k < 2; ++k)
        {
            s.lower[k] = std::min(s.lower[k], p[k]);
            s.upper[k] = std::max(s.upper[k], p[k]);
        }
    };
    end(a, xa, -1);
    end(b, xb, +1);
}

void RowIntegral::addPolygon(const std::vector<Vector3>& polygon)
{
    const auto& planes = *planes_;
    double low = polygon[0][0], high = low;
    for (const Vector3& p : polygon)
        low = std::min(low, p[0]), high = std::max(high, p[0]);
    rest_ = polygon;
    Index box = boxOf(low);
    for (; box + 1 < Index(planes.size()) && high > planes[std::size_t(box + 1)]; ++box)
    {
        const double plane = planes[std::size_t(box + 1)];
        clipPolygon(rest_, 0, plane, true, piece_);
        clipPolygon(rest_, 0, plane, false, next_);
        addToBox(box, piece_);
        std::swap(rest_, next_);
    }
    addToBox(box, rest_);
}

void RowIntegral::addToBox(Index box, const std::vector<Vector3>& polygon)
{
    if (box < 0 || polygon.size() < 3)
        return;
    Sums& s = touch(box);
    const double x0 = (*planes_)[std::size_t(box)];
    const auto local = [&](const Vector3& p) { return Vector3{p[0] - x0, p[1] - range_.y0, p[2] - range_.z0}; };
    const Vector3 origin = local(polygon[0]);
    bool flat[4] = {true, true, true, true};
    const double face[4] = {range_.y0, range_.y1, range_.z0, range_.z1};
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        if (i >= 2)
            addFan(s, origin, local(polygon[i - 1]), local(polygon[i]));
        for (std::size_t f = 0; f < 4; ++f)
            flat[f] = flat[f] && polygon[i][f < 2 ? 1 : 2] == face[f];
        for (std::size_t k = 0; k < 3; ++k)
        {
            s.lower[k] = std::min(s.lower[k], polygon[i][k]);
            s.upper[k] = std::max(s.upper[k], polygon[i][k]);
        }
    }
    // Edges on a face of the row bound the section there (Green: area = closed integral of x dz around +y).
    const double sign[4] = {-1, 1, 1, -1};
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vector3& p = polygon[i];
        const Vector3& q = polygon[(i + 1) % polygon.size()];
        for (std::size_t f = 0; f < 4; ++f)
        {
            const std::size_t across = f < 2 ? 1 : 2, along = f < 2 ? 2 : 1;
            if (flat[f] || p[across] != face[f] || q[across] != face[f])
                continue;
            const double d = sign[f] * (q[along] - p[along]);
            s.beyond[f] += d;
            s.contact[f] += 0.5 * d * (local(p)[0] + local(q)[0]);
        }
    }
}

void RowIntegral::addFan(Sums& s, const Vector3& a, const Vector3& b, const Vector3& c) const
{
    const double area = 0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])); // its x component
    const double x = a[0] + b[0] + c[0], y = a[1] + b[1] + c[1], z = a[2] + b[2] + c[2];
    s.area += area;
    s.ay += area * y / 3;
    s.az += area * z / 3;
    s.volume += area * x / 3;
    s.mx += area / 24 * (a[0] * a[0] + b[0] * b[0] + c[0] * c[0] + x * x);
    s.my += area / 12 * (a[0] * a[1] + b[0] * b[1] + c[0] * c[1] + x * y);
    s.mz += area / 12 * (a[0] * a[2] + b[0] * b[2] + c[0] * c[2] + x * z);
}

BoxPart RowIntegral::cutPart(Index box, const Sums& own, const Sums& above) const
{
    const double x0 = (*planes_)[std::size_t(box)], x1 = (*planes_)[std::size_t(box + 1)], h = x1 - x0;
    const Vector3 low{x0, range_.y0, range_.z0}, high{x1, range_.y1, range_.z1};
    BoxPart part;
    part.box = box;
    part.volume = own.volume + h * above.area;
    const Vector3 moment{own.mx + 0.5 * h * h * above.area, own.my + h * above.ay, own.mz + h * above.az};
    part.contact[0] = own.area + above.area;
    part.contact[1] = above.area;
    for (std::size_t f = 0; f < 4; ++f)
        part.contact[f + 2] = own.contact[f] + h * above.beyond[f];
    // A part reaches a face of its box if the section there is not empty, else as far as its own pieces do.
    Vector3 from = own.lower, to = own.upper;
    for (std::size_t k = 0; k < std::size_t(dim_); ++k)
    {
        const double face = (k == 0 ? 1 : h) * (k == 1 ? 1 : high[1] - low[1]) * (k == 2 ? 1 : high[2] - low[2]);
        if (part.contact[2 * k] > 1e-12 * face)
            from[k] = low[k];
        if (part.contact[2 * k + 1] > 1e-12 * face)
            to[k] = high[k];
        part.extent[k] = to[k] - from[k];
        part.centroid[k] = std::clamp(low[k] + moment[k] / part.volume, from[k], std::max(from[k], to[k]));
    }
    return part;
}

BoxPart RowIntegral::wholePart(Index box) const
{
    const double x0 = (*planes_)[std::size_t(box)], x1 = (*planes_)[std::size_t(box + 1)], length = x1 - x0;
    const double width = range_.y1 - range_.y0, depth = range_.z1 - range_.z0;
    BoxPart part;
    part.box = box;
    part.whole = true;
    part.volume = part.boxVolume = length * width * depth;
    part.centroid = {0.5 * (x0 + x1), 0.5 * (range_.y0 + range_.y1), dim_ == 3 ? 0.5 * (range_.z0 + range_.z1) : 0};
    part.extent = {length, width, depth};
    part.contact = {width * depth, width * depth, length * depth, length * depth, length * width, length * width};
    return part;
}

bool RowIntegral::finish(const std::function<bool(const Vector3&)>& inside, std::vector<BoxPart>& parts, Vector3& bad)
{
    parts.clear();
    const Index boxes = Index(planes_->size()) - 1;
    const double section = (range_.y1 - range_.y0) * (range_.z1 - range_.z0);
    const double roundOff = dim_ == 2 ? wholeTolerance2D : wholeTolerance3D;
    Sums above;
    if (last_ == boxes)
        above.addBeyond(sums_[std::size_t(boxes)]);
    bool runInside = false, runKnown = false;
    // From the far end: boxes behind the last piece see nothing of the surface, and are empty.
    for (Index box = std::min(last_, boxes - 1); box >= 0; --box)
    {
        const BoxPart whole = wholePart(box);
        const Sums& own = sums_[std::size_t(box)];
        bad = whole.centroid;
        if (own.touched)
        {
            BoxPart part = cutPart(box, own, above);
            part.boxVolume = whole.boxVolume;
            const double filled = part.volume / whole.boxVolume;
            if (filled > 1 + closedTolerance || filled < -closedTolerance)
                return false;
            if (std::abs(filled - 1) <= roundOff)
                parts.push_back(whole);
            else if (filled > dust)
                parts.push_back(part);
            above.addBeyond(own);
            runKnown = false;
            continue;
        }
        if (box < first_ && std::abs(above.area) <= closedTolerance * section)
            break;
        if (!runKnown)
            runInside = inside(whole.centroid);
        runKnown = true;
        if (std::abs(above.area - (runInside ? section : 0)) > closedTolerance * section)
            return false;
        if (runInside)
            parts.push_back(whole);
    }
    std::reverse(parts.begin(), parts.end());
    return true;
}
} // namespace mpm::geometry

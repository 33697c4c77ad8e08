// Does a surface cut itself? Pairs of elements whose boxes overlap and that share no corner are looked at.
#include "nodal/rigidSurface.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::nodal
{
namespace
{
/// Twice the area of (a, b, c).
double turn(const Vector3& a, const Vector3& b, const Vector3& c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

bool segmentsCut(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
    return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0 &&
           (turn(a, b, c) != 0 || turn(a, b, d) != 0 || turn(c, d, a) != 0);
}

/// Does the segment from p to q pass through the inside of the triangle (Moeller & Trumbore 1997)?
bool piercesTriangle(const Vector3& p, const Vector3& q, const Vector3& a, const Vector3& b, const Vector3& c)
{
    const Vector3 d = minus(q, p), ab = minus(b, a), ac = minus(c, a), h = cross(d, ac);
    const double det = dot(ab, h);
    if (std::abs(det) <= 1e-14 * length(d) * length(ab) * length(ac))
        return false;
    const Vector3 s = minus(p, a), g = cross(s, ab);
    const double u = dot(s, h) / det, v = dot(d, g) / det, t = dot(ac, g) / det;
    return u >= 0 && v >= 0 && u + v <= 1 && t >= 0 && t <= 1;
}
} // namespace

bool RigidSurface::cut(Index e, Index f) const
{
    const auto &m = elements_[std::size_t(e)], &n = elements_[std::size_t(f)];
    const auto corners = std::size_t(dim_);
    for (std::size_t i = 0; i < corners; ++i)
        for (std::size_t j = 0; j < corners; ++j)
            if (m[i] == n[j])
                return false;
    const auto p = [&](const Element& element, std::size_t k) { return points_[std::size_t(element[k % 3])]; };
    if (dim_ == 2)
        return segmentsCut(p(m, 0), p(m, 1), p(n, 0), p(n, 1));
    for (std::size_t k = 0; k < 3; ++k)
        if (piercesTriangle(p(m, k), p(m, k + 1), p(n, 0), p(n, 1), p(n, 2)) ||
            piercesTriangle(p(n, k), p(n, k + 1), p(m, 0), p(m, 1), p(m, 2)))
            return true;
    return false;
}

void RigidSurface::refuseCuts(const Location& where) const
{
    for (Index e = 0; e < Index(elements_.size()); ++e)
    {
        Vector3 low = points_[std::size_t(elements_[std::size_t(e)][0])], high = low;
        for (std::size_t k = 1; k < std::size_t(dim_); ++k)
            for (std::size_t a = 0; a < 3; ++a)
            {
                const double x = points_[std::size_t(elements_[std::size_t(e)][k])][a];
                low[a] = std::min(low[a], x);
                high[a] = std::max(high[a], x);
            }
        std::vector<Index> stack{0};
        while (!stack.empty())
        {
            const Box& box = boxes_[std::size_t(stack.back())];
            stack.pop_back();
            bool apart = false;
            for (std::size_t a = 0; a < 3; ++a)
                apart = apart || box.low[a] > high[a] || box.high[a] < low[a];
            if (apart)
                continue;
            if (box.left >= 0)
            {
                stack.push_back(box.left);
                stack.push_back(box.right);
                continue;
            }
            for (Index n = box.first; n < box.first + box.count; ++n)
                if (const Index f = order_[std::size_t(n)]; f > e && cut(e, f))
                {
                    const Vector3 x = centre(e);
                    throw InputError(where, fmt::format("found a surface that cuts itself, near ({:g} {:g} {:g})", x[0],
                                                        x[1], x[2]));
                }
        }
    }
}
} // namespace mpm::nodal

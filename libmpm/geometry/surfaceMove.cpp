#include "geometry/surfaceMove.hpp"

#include "geometry/region3D.hpp"

#include <algorithm>
#include <cmath>

namespace mpm::geometry
{
namespace
{
using Points = std::vector<Vector3>;

Vector3 difference(const Vector3& a, const Vector3& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vector3 cross(const Vector3& a, const Vector3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector3& a, const Vector3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void hold(const Simplex& s, std::vector<bool>& held)
{
    for (const int v : s)
        if (v >= 0)
            held[std::size_t(v)] = true;
}

/// Do two segments without a common end meet? In floating point: the check of the body is exact.
bool meet(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
    const auto side = [](const Vector3& p, const Vector3& q, const Vector3& r) {
        return cross(difference(q, p), difference(r, p))[2];
    };
    for (std::size_t k = 0; k < 2; ++k)
        if (std::max(a[k], b[k]) < std::min(c[k], d[k]) || std::max(c[k], d[k]) < std::min(a[k], b[k]))
            return false;
    return side(a, b, c) * side(a, b, d) <= 0 && side(c, d, a) * side(c, d, b) <= 0;
}

} // namespace

double enclosedVolume(const Points& p, const Simplex& s, const Vector3& origin)
{
    const Vector3 a = difference(p[std::size_t(s[0])], origin), b = difference(p[std::size_t(s[1])], origin);
    return s[2] < 0 ? 0.5 * cross(a, b)[2] : dot(a, cross(b, difference(p[std::size_t(s[2])], origin))) / 6;
}

double enclosedVolume(const Points& p, const std::vector<Simplex>& elements)
{
    long double sum = 0;
    for (const Simplex& s : elements)
        sum += enclosedVolume(p, s, p[0]);
    return double(sum);
}

double surfaceArea(const Points& p, const std::vector<Simplex>& elements)
{
    double sum = 0;
    for (const Simplex& s : elements)
    {
        const Vector3 e = difference(p[std::size_t(s[1])], p[std::size_t(s[0])]);
        const Vector3 n = s[2] < 0 ? e : cross(e, difference(p[std::size_t(s[2])], p[std::size_t(s[0])]));
        sum += std::sqrt(dot(n, n)) * (s[2] < 0 ? 1 : 0.5);
    }
    return sum;
}

Points SurfaceMove::by(double way) const
{
    Points moved = wrap_.points;
    for (std::size_t i = 0; i < moved.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            moved[i][k] -= way * share_[i] * wrap_.outward[i][k];
    return moved;
}

double SurfaceMove::wayTo(double volume, double furthest) const
{
    double least = -furthest, most = furthest;
    for (int i = 0; i < 60; ++i)
    {
        const double middle = 0.5 * (least + most);
        (enclosedVolume(by(middle), wrap_.elements) > volume ? least : most) = middle;
    }
    return 0.5 * (least + most);
}

void SurfaceMove::holdBack(const std::vector<std::size_t>& elements, bool neighbours)
{
    std::vector<bool> held(share_.size(), false);
    for (const std::size_t e : elements)
        hold(wrap_.elements[e], held);
    const auto first = held;
    for (const Simplex& s : wrap_.elements)
        if (neighbours && std::any_of(s.begin(), s.end(), [&](int v) { return v >= 0 && first[std::size_t(v)]; }))
            hold(s, held);
    for (std::size_t i = 0; i < share_.size(); ++i)
        if (held[i])
            share_[i] = share_[i] > 0.2 ? 0.5 * share_[i] : 0;
}

std::size_t SurfaceMove::heldBack() const
{
    return std::size_t(std::count_if(share_.begin(), share_.end(), [](double s) { return s < 1; }));
}

std::vector<std::size_t> cuttingElements(const Points& points, const std::vector<Simplex>& elements, int dim)
{
    if (dim == 3)
        return cuttingTriangles(points, elements);
    std::vector<std::size_t> found;
    const auto at = [&](int v) -> const Vector3& { return points[std::size_t(v)]; };
    for (std::size_t i = 0; i < elements.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
        {
            const Simplex &s = elements[i], &t = elements[j];
            if (s[0] != t[1] && s[1] != t[0] && meet(at(s[0]), at(s[1]), at(t[0]), at(t[1])))
                found.insert(found.end(), {i, j});
        }
    return found;
}

} // namespace mpm::geometry

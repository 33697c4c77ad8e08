#include "nodal/hullDistance.hpp"

#include <cmath>
#include <limits>

namespace mpm::nodal
{
namespace
{
double dot(const Vector3& a, const Vector3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector3 minus(const Vector3& a, const Vector3& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct Simplex
{
    int n = 0;
    Vector3 point[4]{};
};

/// Solves the m x m system A x = b by elimination with pivots; false where it is singular.
bool solve(double (&A)[3][3], double (&b)[3], int m)
{
    for (int c = 0; c < m; ++c)
    {
        int pivot = c;
        for (int r = c + 1; r < m; ++r)
            if (std::abs(A[r][c]) > std::abs(A[pivot][c]))
                pivot = r;
        if (!(std::abs(A[pivot][c]) > 0))
            return false;
        for (int k = 0; k < m; ++k)
            std::swap(A[c][k], A[pivot][k]);
        std::swap(b[c], b[pivot]);
        for (int r = c + 1; r < m; ++r)
        {
            const double f = A[r][c] / A[c][c];
            for (int k = c; k < m; ++k)
                A[r][k] -= f * A[c][k];
            b[r] -= f * b[c];
        }
    }
    for (int c = m - 1; c >= 0; --c)
    {
        for (int k = c + 1; k < m; ++k)
            b[c] -= A[c][k] * b[k];
        b[c] /= A[c][c];
    }
    return true;
}

/// The point of the subset's affine hull closest to the origin, if it lies inside the subset's own hull.
bool closestOf(const Simplex& s, const int (&pick)[4], int n, Vector3& v)
{
    const Vector3& base = s.point[pick[0]];
    Vector3 edge[3]{};
    double A[3][3]{}, x[3]{};
    for (int r = 1; r < n; ++r)
        edge[r - 1] = minus(s.point[pick[r]], base);
    for (int r = 0; r < n - 1; ++r)
    {
        for (int c = 0; c < n - 1; ++c)
            A[r][c] = dot(edge[r], edge[c]);
        x[r] = -dot(edge[r], base);
    }
    if (!solve(A, x, n - 1))
        return false;
    double rest = 1;
    v = base;
    for (int r = 0; r < n - 1; ++r)
    {
        if (!(x[r] >= 0))
            return false;
        rest -= x[r];
        for (int k = 0; k < 3; ++k)
            v[k] += x[r] * edge[r][k];
    }
    return rest >= 0;
}

/// Reduces the simplex to the face whose point is closest to the origin, and returns that point.
Vector3 reduce(Simplex& s)
{
    Vector3 best{};
    double least = std::numeric_limits<double>::infinity();
    unsigned chosen = 0;
    for (unsigned mask = 1; mask < 1u << s.n; ++mask)
    {
        int pick[4]{}, n = 0;
        for (int k = 0; k < s.n; ++k)
            if (mask >> k & 1)
                pick[n++] = k;
        Vector3 v{};
        if (!closestOf(s, pick, n, v) || !(dot(v, v) < least))
            continue;
        least = dot(v, v);
        best = v;
        chosen = mask;
    }
    Simplex kept;
    for (int k = 0; k < s.n; ++k)
        if (chosen >> k & 1)
            kept.point[kept.n++] = s.point[k];
    s = kept;
    return best;
}

/// The point of a cloud farthest along `sign` v.
const Vector3& farthest(const std::vector<Vector3>& cloud, const Vector3& v, double sign)
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < cloud.size(); ++i)
        if (sign * dot(v, cloud[i]) > sign * dot(v, cloud[best]))
            best = i;
    return cloud[best];
}

Vector3 mean(const std::vector<Vector3>& cloud)
{
    Vector3 sum{};
    for (const auto& x : cloud)
        for (int k = 0; k < 3; ++k)
            sum[k] += x[k] / double(cloud.size());
    return sum;
}
} // namespace

std::optional<Vector3> separatingNormal(const std::vector<Vector3>& a, const std::vector<Vector3>& b, double least)
{
    if (a.empty() || b.empty())
        return std::nullopt;
    constexpr int mostSteps = 64;
    Simplex simplex;
    Vector3 v = minus(mean(a), mean(b));
    for (int step = 0; step < mostSteps; ++step)
    {
        const Vector3 w = minus(farthest(a, v, -1), farthest(b, v, 1));
        bool known = false;
        for (int k = 0; k < simplex.n; ++k)
            known = known || simplex.point[k] == w;
        if (known || (step > 0 && dot(v, v) - dot(v, w) <= 1e-15 * dot(v, v)))
            break;
        simplex.point[simplex.n++] = w;
        v = reduce(simplex);
        if (simplex.n == 4 || !(dot(v, v) > least * least))
            return std::nullopt;
    }
    const double length = std::sqrt(dot(v, v));
    if (!(length > least))
        return std::nullopt;
    return Vector3{-v[0] / length, -v[1] / length, -v[2] / length};
}
} // namespace mpm::nodal

// How much of a surface the soil touches.
#include "coupling/surface.hpp"
#include "nodal/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace mpm::coupling
{
using namespace mpm::nodal;

namespace
{
/// The piece of its element that a foot point lies on: pieces are no shorter than h, so that each can be met.
struct Piece
{
    Index element = 0, i = 0, j = 0;
    bool upper = false;
    auto operator<=>(const Piece&) const = default;
};

Index piecesAlong(const RigidSurface& surface, Index element, double h)
{
    const auto& e = surface.elements()[std::size_t(element)];
    double longest = 0;
    for (std::size_t k = 0; k < std::size_t(surface.dim()); ++k)
    {
        const auto &a = surface.points()[std::size_t(e[k])],
                   &b = surface.points()[std::size_t(e[(k + 1) % std::size_t(surface.dim())])];
        longest = std::max(longest, length(minus(b, a)));
    }
    return std::max(Index(1), Index(std::floor(longest / h * (1 + 1e-12))));
}

Piece pieceAt(Index element, const std::array<double, 3>& weights, Index n, int dim)
{
    const auto along = [n](double w) { return std::clamp(Index(std::floor(w * double(n))), Index(0), n - 1); };
    Piece out{element, along(weights[1]), dim == 3 ? along(weights[2]) : 0, false};
    if (dim == 3)
    {
        out.i = std::min(out.i, n - 1 - out.j);
        out.upper = weights[1] * double(n) - double(out.i) + weights[2] * double(n) - double(out.j) > 1 &&
                    out.i + out.j < n - 1;
    }
    return out;
}
} // namespace

void Surface::findArea(const std::vector<SurfaceImpulse>& impulses, double h)
{
    std::fill(now_.area.begin(), now_.area.end(), 0.0);
    const RigidSurface& surface = rigid_ ? rigid_->surface() : deformable_->surface();
    std::map<Piece, Vector3> pressed;
    for (const auto& given : impulses)
    {
        auto& sum = pressed[pieceAt(given.element, given.weights, piecesAlong(surface, given.element, h), mesh_.dim)];
        sum = plus(sum, given.impulse);
    }
    double most = 0;
    for (const auto& [piece, impulse] : pressed)
        most = std::max(most, length(impulse));
    for (const auto& [piece, impulse] : pressed)
    {
        if (!(length(impulse) > 0.1 * most))
            continue;
        const auto& e = surface.elements()[std::size_t(piece.element)];
        const auto point = [&](std::size_t k) { return surface.points()[std::size_t(e[k])]; };
        const double n = double(piecesAlong(surface, piece.element, h));
        std::array<double, 3> w{};
        double area = 0;
        if (mesh_.dim == 2)
        {
            area = length(minus(point(1), point(0))) / n;
            w[1] = (double(piece.i) + 0.5) / n;
        }
        else
        {
            area = 0.5 * length(cross(minus(point(1), point(0)), minus(point(2), point(0)))) / (n * n);
            const double middle = piece.upper ? 2.0 / 3 : 1.0 / 3;
            w[1] = (double(piece.i) + middle) / n;
            w[2] = (double(piece.j) + middle) / n;
        }
        w[0] = 1 - w[1] - w[2];
        for (std::size_t k = 0; k < std::size_t(mesh_.dim); ++k)
            now_.area[std::size_t(e[k])] += w[k] * area;
    }
}
} // namespace mpm::coupling

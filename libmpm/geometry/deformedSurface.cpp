#include "geometry/deformedSurface.hpp"

#include "base/error.hpp"
#include "geometry/region2D.hpp"
#include "geometry/region3D.hpp"
#include "geometry/surfaceMove.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace mpm::geometry
{
namespace
{
using Points = std::vector<Vector3>;

/// Checks it as a body is checked; the loops of a wrap follow one another, each element begins where the last ended.
std::unique_ptr<Region> checked(const Points& points, const std::vector<Simplex>& elements, int dim)
{
    if (dim == 3)
        return std::make_unique<Region3D>("the material", points, elements);
    std::vector<Region2D::Loop> loops;
    for (std::size_t i = 0; i < elements.size(); ++i)
    {
        if (i == 0 || elements[i - 1][1] != elements[i][0])
            loops.emplace_back();
        loops.back().push_back(points[std::size_t(elements[i][0])]);
    }
    return std::make_unique<Region2D>("the material", loops);
}

const char* unitOf(int dim)
{
    return dim == 2 ? "m2" : "m3";
}

void requireFinite(const std::vector<ParticleDomain>& domains, int dim)
{
    for (const ParticleDomain& d : domains)
        for (std::size_t k = 0; k < std::size_t(dim); ++k)
            for (std::size_t e = 0; e < std::size_t(dim); ++e)
                if (!std::isfinite(d.centre[k]) || !std::isfinite(d.edges[e][k]))
                    throw InputError(
                        fmt::format("the domain of the particle at {} is not finite", placeText(d.centre, dim)));
}

/// Volume of each piece.
std::vector<double> pieceVolumes(const Wrap& wrap)
{
    std::vector<double> volumes(std::size_t(wrap.pieces), 0.0);
    for (std::size_t i = 0; i < wrap.elements.size(); ++i)
        volumes[std::size_t(wrap.piece[i])] += enclosedVolume(wrap.points, wrap.elements[i], wrap.points[0]);
    return volumes;
}

/// Leaves the elements of one piece, and their points.
void keepPiece(Wrap& wrap, int piece)
{
    Wrap kept;
    std::vector<int> number(wrap.points.size(), -1);
    for (std::size_t i = 0; i < wrap.elements.size(); ++i)
    {
        if (wrap.piece[i] != piece)
            continue;
        Simplex s = wrap.elements[i];
        for (int& v : s)
        {
            if (v < 0)
                continue;
            int& n = number[std::size_t(v)];
            if (n < 0)
            {
                n = int(kept.points.size());
                kept.points.push_back(wrap.points[std::size_t(v)]);
                kept.outward.push_back(wrap.outward[std::size_t(v)]);
            }
            v = n;
        }
        kept.elements.push_back(s);
        kept.piece.push_back(0);
    }
    kept.pieces = 1;
    wrap = std::move(kept);
}

/// Refuses what is not in one piece, or takes the largest.
void choosePieces(Wrap& wrap, const std::vector<ParticleDomain>& domains, int dim, const SurfaceOptions& how,
                  DeformedSurface& made)
{
    made.pieces = wrap.pieces;
    const double alpha = how.alpha / how.cell;
    if (wrap.pieces > 1 && 8 * std::size_t(wrap.pieces) > domains.size())
        throw InputError(fmt::format(
            "its {} particles fall into {} pieces: they are too sparse for alpha {:.4g} cells, which closes "
            "gaps up to {:.4g} m; allowed: a larger alpha, or more particlesPerCell and splitting in the run",
            domains.size(), wrap.pieces, alpha, 2 * how.alpha));
    if (wrap.pieces < 2)
        return;
    const std::vector<double> volumes = pieceVolumes(wrap);
    std::vector<int> order(volumes.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return volumes[std::size_t(a)] > volumes[std::size_t(b)]; });
    const double sum = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    made.largestShare = volumes[std::size_t(order[0])] / sum;
    const auto next = std::find(wrap.piece.begin(), wrap.piece.end(), order[1]) - wrap.piece.begin();
    const std::string found =
        fmt::format("in {} pieces, the largest with {:.4g} % of the volume, the next ({:.3g} {}) at {}", wrap.pieces,
                    100 * made.largestShare, volumes[std::size_t(order[1])], unitOf(dim),
                    placeText(wrap.points[std::size_t(wrap.elements[std::size_t(next)][0])], dim));
    if (how.pieces == Pieces::one)
        throw InputError(
            fmt::format("found the material {}; allowed: one piece, or `pieces largest;` or `pieces all;`, or an alpha "
                        "larger than {:.4g} cells, which closes wider gaps",
                        found, alpha));
    made.notes.push_back("the material is " + found + (how.pieces == Pieces::all ? "" : "; the others are left out"));
    if (how.pieces == Pieces::largest)
        keepPiece(wrap, order[0]);
}

/// Volume of the particles the surface is of: those inside, where pieces were left out.
double volumeInside(const std::vector<ParticleDomain>& domains, const Region* region)
{
    double sum = 0;
    for (const ParticleDomain& d : domains)
        if (!region || region->contains(d.centre))
            sum += d.volume;
    return sum;
}

void requireVolume(const DeformedSurface& made, const SurfaceOptions& how)
{
    const double off = made.outlineVolume / made.particleVolume - 1;
    if (std::abs(off) <= how.volumeTolerance)
        return;
    throw InputError(fmt::format(
        "its outline holds {:.6g} {}, {:+.3g} % off the {:.6g} {} of its particles; volumeTolerance allows {:.3g} %: "
        "{}",
        made.outlineVolume, unitOf(made.dim), 100 * off, made.particleVolume, unitOf(made.dim),
        100 * how.volumeTolerance,
        off > 0
            ? fmt::format(
                  "alpha {:.4g} cells closes hollows that are none; allowed: a smaller alpha or offset, or a larger "
                  "volumeTolerance",
                  how.alpha / how.cell)
            : std::string("domains overlap, as those of particles that sheared far do; allowed: splitting in the run, "
                          "or a larger "
                          "volumeTolerance")));
}
} // namespace

DeformedSurface deformedSurface(const std::vector<ParticleDomain>& domains, int dim, const SurfaceOptions& how)
{
    if (domains.empty())
        throw InputError("found no particles to draw a surface around");
    requireFinite(domains, dim);
    DeformedSurface made;
    made.dim = dim;
    Wrap wrap = dim == 2 ? alphaWrap2D(domains, how.alpha) : alphaWrap3D(domains, how.alpha, how.offset);
    if (wrap.elements.empty())
        throw InputError(
            fmt::format("its particles are too sparse for alpha {:.4g} cells: no surface; allowed: a larger alpha",
                        how.alpha / how.cell));
    choosePieces(wrap, domains, dim, how, made);

    // A hair outside the domains, where the ways in of neighbours have not met yet.
    const double back = dim == 3 ? 0.98 * how.offset : 0;
    SurfaceMove move(wrap);
    made.outlineVolume = enclosedVolume(move.by(back), wrap.elements);
    const bool whole = made.pieces == 1 || how.pieces == Pieces::all;
    made.particleVolume = volumeInside(domains, whole ? nullptr : checked(wrap.points, wrap.elements, dim).get());
    requireVolume(made, how);

    double way = 0, furthest = how.offset + how.alpha;
    for (int round = 0; round < 40; ++round)
    {
        way = how.matchVolume ? move.wayTo(made.particleVolume, furthest) : back;
        if (round == 0)
            furthest = std::min(furthest, 3 * std::abs(way)); // more is not asked of the points that may still move
        made.points = move.by(way);
        const auto cuts = cuttingElements(made.points, wrap.elements, dim);
        if (cuts.empty())
            break;
        move.holdBack(cuts, round >= 12);
    }
    if (const std::size_t held = move.heldBack(); 4 * held > wrap.points.size())
        made.notes.push_back(
            fmt::format("{} of {} points were held back, or the surface would cut itself", held, wrap.points.size()));
    std::unique_ptr<Region> region;
    try
    {
        region = checked(made.points, wrap.elements, dim);
    }
    catch (const InputError& error)
    {
        throw InputError(fmt::format("{} (alpha {:.4g}, offset {:.4g} cells); allowed: another alpha or offset",
                                     error.what(), how.alpha / how.cell, how.offset / how.cell));
    }
    if (how.matchVolume && std::abs(region->volume() / made.particleVolume - 1) > 1e-6)
        made.notes.push_back(
            "the volume could not be matched without the surface cutting itself; a smaller alpha closes less");
    made.elements = wrap.elements;
    made.volume = region->volume();
    made.movedIn = way - back;
    made.area = surfaceArea(made.points, made.elements);
    return made;
}
} // namespace mpm::geometry

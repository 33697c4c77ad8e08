#pragma once
/// The closed surface of deformed material: from particles back to geometry.
///
/// 1. The outline of the particles' domains (alphaWrap.hpp): gaps and hollows narrower than two alpha are closed.
/// 2. In 3D the outline lies `offset` outside the domains: its points go back to them, along the way they came.
/// 3. matchVolume: domains of sheared particles overlap and gape, and hollows between their corners are closed, so the
///    outline holds a few per cent more than the particles do. All points move in by the one length with which the
///    volumes agree. Points where the surface would cut itself are held back, and the others go a little further.
///
/// The result is checked as any geometry is (region2D.hpp, region3D.hpp): closed, no self-intersections.
///
/// Errors (InputError; alpha and lengths are told in cells): a domain that is not finite; particles too sparse for
/// alpha (nearly every one is a piece of its own); several pieces where one is asked for; a volume that is off by more
/// than volumeTolerance before it is matched; a surface that cuts itself. Each says what to change.
/// Verified in tests/unit/deformedSurface.cpp.
#include "geometry/alphaWrap.hpp"

namespace mpm::geometry
{
enum class Pieces
{
    one,     ///< several are an error
    largest, ///< the others are left out
    all
};

struct SurfaceOptions
{
    double alpha = 0, offset = 0; ///< [m]; offset in 3D only
    double cell = 1;              ///< [m] for messages
    Pieces pieces = Pieces::one;
    bool matchVolume = true;
    double volumeTolerance = 0.15; ///< of the particles' volume
};

struct DeformedSurface
{
    int dim = 2;
    std::vector<Vector3> points;   ///< [m]
    std::vector<Simplex> elements; ///< facing outward: (e_y, -e_x), cross(e1, e2)
    double volume = 0;             ///< enclosed [m^3], m^2 in 2D
    double particleVolume = 0;     ///< of the particles inside
    double outlineVolume = 0;      ///< before it was matched
    double movedIn = 0;            ///< to match it [m]
    double area = 0;               ///< of the surface, in 2D its length
    int pieces = 0;                ///< found; of the largest is `largestShare`
    double largestShare = 1;
    std::vector<std::string> notes;
};

/// edges of the domains: columns of F times initial lengths (state/particles.hpp).
DeformedSurface deformedSurface(const std::vector<ParticleDomain>& domains, int dim, const SurfaceOptions& options);
} // namespace mpm::geometry

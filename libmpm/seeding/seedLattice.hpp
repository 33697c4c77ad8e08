#pragma once
/// Seeds: the parts of lattice boxes inside a region, each a particle at the part's centroid with the part's volume.
///
/// Slivers, parts below sliverFraction of their box, are merged into the neighbour they share most surface with:
/// volumes add, the centroid is the volume-weighted one. A neighbour must be no sliver itself or at least
/// 1/sliverFraction times as large; a sliver without one stays as it is (a plate thinner than that keeps its seeds).
/// Nothing is dropped beyond round-off, so the seeds have the region's volume and first moments: in 2D the mass is
/// exact to 1e-12, in 3D that of the triangle surface.
///
/// The centroid of a part that a notch cuts may lie in the notch: kept there, because moving it would move the mass.
///
/// Edge lengths: extents of the part's bounding box scaled by one factor so that their product is the part's volume; a
/// merged sliver lengthens its neighbour across their common face.
#include "seeding/boxLattice.hpp"

namespace mpm::seeding
{
struct Seed
{
    Vector3 centre{};  ///< [m]
    Vector3 length{};  ///< edges [m]; their product is the volume
    double volume = 0; ///< [m^3], m^2 in 2D
};

struct RegionSeeds
{
    std::vector<Seed> seeds; ///< layer by layer, row by row, along x
    Index merged = 0;        ///< slivers merged into neighbours
};

inline constexpr double defaultSliverFraction = 0.1;

/// The lattice must have been fitted to the region. visit, if given, sees every part: (row, layer, parts).
RegionSeeds seedRegion(const geometry::Region& region, const BoxLattice& lattice,
                       double sliverFraction = defaultSliverFraction, const geometry::Region::Row& visit = {});
} // namespace mpm::seeding

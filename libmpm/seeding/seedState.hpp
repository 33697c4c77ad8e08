#pragma once
/// From geometry to particles: the state a run starts from.
///
///     // system/seedParticlesDict
///     geometry         "geometry/column.geo"; // default: the only file in geometry/
///     scale            1;                     // its coordinates times this are metres
///     meshingTime      300;                   // [s] gmsh may take over the geometry, then it is ended; at most 86400
///     particlesPerCell 2;                     // along each axis; default 2
///     arrangement      lattice;               // lattice (default) | jittered
///     jitter           0.2;                   // [-] of a box side, in [0, 0.5); only with jittered
///     randomSeed       1;                     // only with jittered
///     regions                                 // default: each region is of the material of its own name
///     {
///         soil { material soil; }
///     }
///
/// Particles are numbered from 0 in this order: regions as in the file, then the lattice layer by layer, row by row,
/// along x. F = I, volume = volume0, mass = density times volume. Every boundary of the geometry becomes a surface
/// patch. Errors (InputError): a region without material or seeds, outside the grid, a name in `regions` that is no
/// region, regions that overlap (in 3D as far as the lattice sees it: a box more than full), a seed above surfaceLevel.
#include "geometry/bodyGeometry.hpp"
#include "seeding/boxLattice.hpp"
#include "seeding/seedMaterials.hpp"
#include "state/state.hpp"

#include <map>

namespace mpm::seeding
{
struct SeedOptions
{
    std::string geometry;   ///< as written; empty: not given
    Location geometryWhere; ///< of that word
    double scale = 1;
    double meshingTime = 300; ///< [s]
    LatticeOptions lattice;
    std::map<std::string, std::string> materialOf; ///< region -> material, where given
    Location where;                                ///< of the dictionary, or of `regions` in it
};

SeedOptions readSeedOptions(const dictionary::Dictionary& seedParticlesDict);

/// What was seeded, for the banner.
struct SeededRegion
{
    std::string name, material;
    double volume = 0; ///< of the region [m^3], m^2 in 2D
    double mass = 0;   ///< of its particles [kg], per metre in 2D
    Index particles = 0;
    Index merged = 0; ///< slivers merged into neighbours
};

struct Seeding
{
    state::State state;
    std::vector<SeededRegion> regions;
};

Seeding seedState(const geometry::BodyGeometry& body, const state::GridBox& grid,
                  const std::vector<SeedMaterial>& materials, const SeedOptions& options);
} // namespace mpm::seeding

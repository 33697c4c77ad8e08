#pragma once
/// What a pass over the particles of a tile sums up (stepping/explicitStepper.hpp).
#include "base/types.hpp"

namespace mpm::stepping
{
/// Sums over one tile; added in the order of the tiles.
struct TileSums
{
    double kinetic = 0, plasticWork = 0, apexVolume = 0, bodyForceWork = 0, bodyForceEnd = 0;
    double strainWorkBefore = 0; ///< sum V sigma : D dt with stress and volume before the update
    double strainWork = 0;       ///< the same with stress and volume after it
    double strainEnergy = 0, finiteStrainWork = 0;
    double relaxationLoss = 0, averagingLoss = 0, viscosityLoss = 0, gapWork = 0, bulkViscosityLoss = 0;
    Vector3 momentum{};
    double fastest = 0; ///< max v.v
    double smallestJacobian = 1, largestJacobian = 1, maxYield = 0;
    Index apexReturns = 0, cappedDomains = 0;
    Index badParticle = -1; ///< index of a particle that cannot go on
    bool stray = false;     ///< a particle has left its tile's window, or the grid
    bool longEdges = false; ///< a particle may have to be split; where the next step looks
};
} // namespace mpm::stepping

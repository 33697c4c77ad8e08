#pragma once
/// Adaptive splitting of stretched particles (Andersen & Andersen 2009; METHOD, Splitting). Edge k of a particle is
/// F l0_k; a particle is split when an edge is longer than threshold times the seeding spacing.
///     fourWay     all edges are halved (4 children in 2D, 8 in 3D)
///     stretched   only edges over the threshold are halved
/// Children copy F, v and sigma and halve l0, m and V along split edges; centres at x_p +- F l0_k/4. If a child's
/// domain would cross a wall, all offsets of that particle shrink by one common factor, so mass, momentum and centre
/// stay exact; below 0.1 the split is put off and counted.
///
///     splitting                    // mpmSchemes; absent: no splitting
///     {
///         threshold      2.55;     // [-] > 1, times the seeding spacing
///         mode           fourWay;
///         interval       20;       // steps between checks
///         maxParticles   10000000; // cap on count
///         maxGeneration  6;        // cap on size: halvings of one particle
///     }
///
/// Verified in tests/unit/splitting.cpp: mass, momentum, centre, energy; caps; walls.
#include "state/state.hpp"

namespace mpm::splitting
{
enum class Mode
{
    fourWay,
    stretched
};

struct Rule
{
    double threshold = 2.55;
    Mode mode = Mode::fourWay;
    Index interval = 20;
    Index maxParticles = 10000000;
    int maxGeneration = 6;
};

/// A plane children must not cross: side -1 is a floor (soil above), +1 a ceiling.
struct Barrier
{
    int axis = 1;
    int side = -1;
    double position = 0;
};

/// Particles first .. end - 1 in memory.
struct Range
{
    Index first = 0, end = 0;
};

struct Outcome
{
    Index split = 0;  ///< particles that were split
    Index added = 0;  ///< particles more than before
    Index putOff = 0; ///< put off at a wall
    Index capped = 0; ///< refused by a cap
};

/// Splits once where the rule asks for it (children are looked at again the next time), in the order of the particles.
/// Books splits and their losses in the state's ledger. The new particles stand at the end, in memory and by their sort
/// key, until the next sort.
/// where: particles among which all those with long edges are, in memory; null: look at all of them.
Outcome splitParticles(state::State& state, const Rule& rule, const std::vector<Barrier>& barriers,
                       const std::vector<Range>* where = nullptr);
} // namespace mpm::splitting

#pragma once
/// What effects cost, measured: copies of a state are stepped with and without each of them, in rounds that take turns,
/// and the medians of rounds are compared. Every batch of steps begins at the same state, so that rounds do the same
/// work. Nothing is written, and the state itself stays as it is.
///
///     share   used: (t_with - t_without)/t_with: of a step of the scene as it is
///             off:  (t_neutral - t_base)/t_base: what a step would get dearer by naming it, before it acts
///     ns      t_with - t_without per particle and step
///     bytes   columns a particle has more, in the state and in the stepper
///
/// t: processor time of all threads. A batch is a sort interval; of large states a part is stepped (firstParticles), in
/// batches of some steps between sorts, so that it takes a few seconds whatever the size. Half the range the middle
/// half of rounds lies in is told as the spread; what is below it is noise.
///
/// An effect a scene cannot have, or cannot be stepped without, says why in place of a price.
/// Verified in tests/effects/prices.cpp.
#include "case/effectCatalogue.hpp"

#include <optional>

namespace mpm::cases
{
struct EffectPrice
{
    const Effect* effect = nullptr;
    bool used = false;
    double share = 0, spread = 0; ///< [-]
    double nanoseconds = 0;       ///< per particle and step
    double bytes = 0;             ///< per particle
    int rounds = 0;
    std::string fault = {}; ///< why there is no price; empty: there is one
};

struct EffectPrices
{
    std::vector<EffectPrice> list; ///< in the order of the catalogue
    Index particles = 0, all = 0;  ///< that were stepped; of the state
    Index batch = 0;               ///< steps between two looks at the clock
    double nanoseconds = 0;        ///< of the scene as it is, per particle and step
    double seconds = 0;            ///< on the wall, of all of this
};

/// How much is measured.
struct PriceLimits
{
    double seconds = 4;      ///< about, on the wall
    bool offToo = true;      ///< also effects that the scene does not use
    Index particles = 50000; ///< at most, of a state
    int rounds = 15;         ///< at most; at least fewestRounds
    int fewestRounds = 5;
};

/// Prices at a state, in steps of dt [s].
EffectPrices priceEffects(const stepping::Scene& scene, const state::State& state, const std::string& shape, double dt,
                          const PriceLimits& limits = {});

/// The same, of effects in use, if that takes no longer than `seconds` with a thousand particles (or all there are);
/// else nothing. nsPerParticleStep: of the run so far.
std::optional<EffectPrices> priceEffectsWithin(const stepping::Scene& scene, const state::State& state,
                                               const std::string& shape, double dt, double nsPerParticleStep,
                                               double seconds);

/// Bytes a particle takes, in the columns of a state and of its stepper.
double bytesPerParticle(const state::State& state, const stepping::Stepper& stepper);
} // namespace mpm::cases

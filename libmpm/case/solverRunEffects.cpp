// What the effects of a run cost and did: option -effects, and the summary's table.
#include "base/error.hpp"
#include "case/effectTables.hpp"
#include "case/solverRun.hpp"

#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
constexpr double worth = 0.01; ///< share of a run that pricing its effects may take
} // namespace

bool wantsEffects(const Options& options)
{
    if (!options.has("effects"))
    {
        if (options.has("markdown"))
            throw InputError("-markdown: found it without -effects; allowed: -effects -markdown");
        return false;
    }
    for (const char* other : {"withinTime", "withinError", "errorMeasure", "profile"})
        if (options.has(other))
            throw InputError(fmt::format("-effects: found it with -{}; allowed: one of them", other));
    if (options.dryRun)
        throw InputError("-effects: found it with -dry-run; allowed: one of them");
    return true;
}

void SolverRun::printEffects() const
{
    const auto prices = priceEffects(scene_.scene, state_, scene_.shape, stepSize());
    if (options_.has("markdown"))
        fmt::print("{}", effectsPage(prices, folder_.name(), state_.particles.dim));
    else
    {
        banner();
        fmt::print("{}", effectsText(prices, state_.particles.dim));
    }
}

EffectRun SolverRun::effectRun() const
{
    return {scene_.scene, state_, firstLedger_, state_.step - firstStep_, stepper_->report()};
}

std::vector<const Effect*> SolverRun::usedEffects() const
{
    return effectsOf({scene_.scene, state::State(state_.particles.dim), scene_.shape});
}

/// Prices are measured if that is cheap beside the run.
std::string SolverRun::deeds() const
{
    std::optional<EffectPrices> prices;
    if (state_.step > firstStep_)
        prices = priceEffectsWithin(scene_.scene, state_, scene_.shape, state_.deltaT,
                                    profile_.nsPerParticleStep(stepSeconds_), worth * stepSeconds_);
    return deedsText(effectRun(), usedEffects(), prices, stepper_->times(), stepSeconds_);
}
} // namespace mpm::cases

#pragma once
/// The catalogue of effects as tables: what `mpmSolve -effects` prints, the page docs/effects.md, and what the summary
/// of a run says.
#include "case/effectPrices.hpp"

#include <string>
#include <utility>

namespace mpm::cases
{
/// Two tables, effects in use and others, with a line on how it was measured.
std::string effectsText(const EffectPrices& prices, int dim);

/// The page docs/effects.md. What stands before its line "## Prices" depends on the catalogue alone.
std::string effectsPage(const EffectPrices& prices, const std::string& caseName, int dim);

/// What effects in use did and cost. No prices: an upper bound from the passes of the run's own steps.
std::string deedsText(const EffectRun& run, const std::vector<const Effect*>& used,
                      const std::optional<EffectPrices>& prices, const stepping::PassTimes& passes, double stepSeconds);

/// "friction", "0 contacts in 2500 steps": effects that were on and never acted.
std::vector<std::string> idleEffects(const EffectRun& run, const std::vector<const Effect*>& used);
} // namespace mpm::cases

#pragma once
/// Reading what a run gave from its files, for accuracyMeasure.hpp.
#include "case/accuracyMeasure.hpp"
#include "state/state.hpp"

namespace mpm::cases
{
Sample fieldSample(const Measure& measure, const CaseDirectory& run, const std::string& timeName);
/// The same of a state of the run that is in memory.
Sample stateSample(const Measure& measure, const CaseDirectory& run, const state::State& state,
                   const std::string& timeName);
Sample historySample(const Measure& measure, const CaseDirectory& run);
Sample profileSample(const Measure& measure, const CaseDirectory& run);
} // namespace mpm::cases

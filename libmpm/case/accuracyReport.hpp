#pragma once
/// What accuracyCost says on the terminal: orders, the Pareto front, and which setting is the cheapest for an error.
#include "case/accuracyCostTable.hpp"

namespace mpm::cases
{
/// Before anything runs: rows, steps, and those that cannot be run.
std::string matrixText(const AccuracyCase& base, const std::vector<MatrixRow>& rows);

/// All of it; `within`: advice for this error alone, otherwise for every decade.
std::string costReport(const Evaluation& evaluation, std::optional<double> within);
} // namespace mpm::cases

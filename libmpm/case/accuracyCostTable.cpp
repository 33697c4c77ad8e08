#include "case/accuracyCostTable.hpp"

#include "base/version.hpp"
#include "output/csvSeries.hpp"

#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
std::string shown(double value)
{
    return std::isfinite(value) ? output::shortest(value) : "";
}

std::vector<std::string> columnNames()
{
    std::vector<std::string> names{"row", "method"};
    for (const auto& axis : accuracyAxes())
        names.push_back(axis);
    for (const char* name : {"status",
                             "reason",
                             "errorMeasure",
                             "error",
                             "errorScale",
                             "against",
                             "value",
                             "reference",
                             "referenceRow",
                             "referenceError",
                             "temporalError",
                             "spatialError",
                             "pareto",
                             "cpuSeconds",
                             "wallSeconds",
                             "repeats",
                             "threads",
                             "sideBySide",
                             "particles",
                             "steps",
                             "particleSteps",
                             "cells",
                             "nsPerParticleStep",
                             "endTime",
                             "machine",
                             "version",
                             "key"})
        names.emplace_back(name);
    return names;
}

/// The settings in effect; the step as it was where it adapts.
std::string settingText(const RowFacts& facts, const RowResult& result, const std::string& axis)
{
    if (axis == "deltaT" && result.done() && result.steps > 0)
        return output::shortest(result.endTime / double(result.steps));
    const auto found = facts.effective.find(axis);
    return found == facts.effective.end() ? "" : found->second;
}

std::vector<std::string> cells(const Evaluation& e, const CostLine& line)
{
    const MatrixRow& row = e.rows[line.row];
    const RowFacts& facts = e.facts[line.row];
    const RowResult& result = e.results[line.row];
    const Measure& measure = e.measures[line.measure];
    const bool done = result.done();
    const auto ifDone = [&](double value) { return done ? shown(value) : ""; };
    std::vector<std::string> out{row.name, row.method};
    for (const auto& axis : accuracyAxes())
        out.push_back(settingText(facts, result, axis));
    const double ns = result.particleSteps > 0 ? 1e9 * result.cpuSeconds / result.particleSteps : NAN;
    for (const auto& text : {result.status,
                             result.reason.empty() ? line.note : result.reason,
                             measure.name,
                             shown(line.error),
                             shown(line.scale),
                             measure.against,
                             shown(line.value),
                             shown(line.reference),
                             line.referenceRow,
                             shown(line.referenceError),
                             shown(line.temporal),
                             shown(line.spatial),
                             std::string(line.pareto ? "1" : "0"),
                             ifDone(result.cpuSeconds),
                             ifDone(result.wallSeconds),
                             ifDone(double(result.repeats)),
                             ifDone(1),
                             ifDone(double(result.sideBySide)),
                             ifDone(double(result.particles)),
                             ifDone(double(result.steps)),
                             ifDone(result.particleSteps),
                             shown(facts.cells > 0 ? double(facts.cells) : NAN),
                             ifDone(ns),
                             ifDone(result.endTime),
                             result.machine,
                             fmt::format("{} {} {}", projectVersion(), gitRevision(), kernelText()),
                             result.key})
        out.push_back(text);
    return out;
}
} // namespace

CsvTable costTable(const Evaluation& evaluation)
{
    CsvTable table(columnNames());
    for (const CostLine& line : evaluation.lines)
        table.addRow(cells(evaluation, line));
    return table;
}
} // namespace mpm::cases

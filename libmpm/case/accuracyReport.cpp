#include "case/accuracyReport.hpp"

#include "base/terminal.hpp"
#include "case/accuracyAnalysis.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace mpm::cases
{
namespace
{
using Lines = std::vector<const CostLine*>;

Lines linesOf(const Evaluation& e, std::size_t measure)
{
    Lines out;
    for (const auto& line : e.lines)
        if (line.measure == measure && std::isfinite(line.error) && line.referenceRow != e.rows[line.row].name)
            out.push_back(&line);
    return out;
}

std::string settingText(const Evaluation& e, std::size_t row)
{
    const RowFacts& facts = e.facts[row];
    return fmt::format("{}, cells of {:g} m, Courant {:.3g} (deltaT {:.3g} s)", e.rows[row].method, facts.cellSize,
                       facts.courant, facts.deltaT);
}

std::string secondsText(double seconds)
{
    return seconds < 1 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

/// Orders in the cell size (at a fixed Courant number) and of the temporal error in the step (on a fixed grid).
std::string orders(const Evaluation& e, const Lines& lines)
{
    Table table({"method", "order in", "over", "order"});
    std::set<std::pair<bool, Setting>> seen;
    for (const bool inSpace : {true, false})
        for (const auto* line : lines)
        {
            auto family = e.facts[line->row].declared;
            for (const char* word : {"cellSize", "courant", "deltaT"})
                if (inSpace == (word == std::string("cellSize")))
                    family.erase(word);
            if (!seen.emplace(inSpace, family).second)
                continue;
            std::vector<double> sizes, errors;
            for (const auto* other : lines)
                if ((inSpace ? sameButCellSize : sameButTimeStep)(e.facts[other->row].declared,
                                                                  e.facts[line->row].declared))
                {
                    sizes.push_back(inSpace ? e.facts[other->row].cellSize : e.facts[other->row].deltaT);
                    errors.push_back(inSpace ? other->error : other->temporal);
                }
            const auto order = fitOrder(sizes, errors);
            if (!order)
                continue;
            const auto [low, high] = std::minmax_element(sizes.begin(), sizes.end());
            table.row({e.rows[line->row].method,
                       inSpace ? fmt::format("h (Courant {:.3g})", e.facts[line->row].courant)
                               : fmt::format("deltaT (h {:g} m)", e.facts[line->row].cellSize),
                       fmt::format("{:.3g} .. {:.3g}", *high, *low), fmt::format("{:.2f}", *order)});
        }
    return table.text(2);
}

std::string front(const Evaluation& e, const Lines& lines)
{
    Lines best;
    for (const auto* line : lines)
        if (line->pareto)
            best.push_back(line);
    std::sort(best.begin(), best.end(), [&](const auto* a, const auto* b) {
        return e.results[a->row].cpuSeconds < e.results[b->row].cpuSeconds;
    });
    Table table({"nothing is cheaper and as accurate as", "error", "processor", "particles", "steps"});
    for (const auto* line : best)
        table.row({settingText(e, line->row), fmt::format("{:.3g}", line->error),
                   secondsText(e.results[line->row].cpuSeconds), fmt::format("{}", e.results[line->row].particles),
                   fmt::format("{}", e.results[line->row].steps)});
    return table.text(2);
}

std::string advice(const Evaluation& e, const Lines& lines, std::optional<double> within)
{
    std::vector<double> prices, errors;
    for (const auto* line : lines)
    {
        prices.push_back(e.results[line->row].cpuSeconds);
        errors.push_back(line->error);
    }
    const auto [low, high] = std::minmax_element(errors.begin(), errors.end());
    std::vector<double> bounds;
    if (within)
        bounds = {*within};
    else if (*high > 0)
        for (double k = std::floor(std::log10(*high)); k >= std::log10(std::max(*low, 1e-14)); --k)
            bounds.push_back(std::pow(10, k));
    std::string text;
    for (const double bound : bounds)
    {
        const auto best = cheapestWithin(prices, errors, bound);
        if (!best)
            text += fmt::format("  within {:g}: none of the rows; the smallest error is {:.3g}\n", bound, *low);
        else
            text += fmt::format("  within {:g}: {} costs {} (error {:.3g})\n", bound, settingText(e, lines[*best]->row),
                                secondsText(prices[*best]), errors[*best]);
    }
    return text;
}

/// How sure the reference is.
std::string certainty(const Evaluation& e, const Lines& lines)
{
    const CostLine& any = *lines.front();
    if (e.measures[any.measure].against != "finest")
        return "";
    if (!std::isfinite(any.referenceError))
        return fmt::format("  the reference is {}; its own error is unknown, as no coarser run of its kind is there\n",
                           any.referenceRow);
    const auto lost = std::count_if(lines.begin(), lines.end(),
                                    [](const auto* line) { return line->error < 2 * line->referenceError; });
    return fmt::format("  the reference is {}, wrong by {:.2g} itself (Richardson); {}\n", any.referenceRow,
                       any.referenceError,
                       lost ? fmt::format("{} of {} errors are below twice that and not resolved", lost, lines.size())
                            : "all errors are above twice that");
}
} // namespace

std::string matrixText(const AccuracyCase& base, const std::vector<MatrixRow>& rows)
{
    Table table({"row", "cells", "steps", "deltaT [s]", "Courant", ""});
    for (const auto& row : rows)
    {
        const RowFacts facts = base.facts(row);
        table.row({row.name, fmt::format("{}", facts.cells), fmt::format("{}", facts.steps),
                   fmt::format("{:.3g}", facts.deltaT), fmt::format("{:.3g}", facts.courant),
                   facts.refused.empty() ? "" : "refused: " + facts.refused});
    }
    return table.text(2);
}

std::string costReport(const Evaluation& e, std::optional<double> within)
{
    std::string text;
    for (std::size_t m = 0; m < e.measures.size(); ++m)
    {
        const Lines lines = linesOf(e, m);
        text += fmt::format("\n{}, against {}\n", e.measures[m].name, e.measures[m].against);
        if (lines.empty())
        {
            text += "  no row has an error (see the column `reason`)\n";
            continue;
        }
        text += certainty(e, lines) + orders(e, lines) + front(e, lines) + advice(e, lines, within);
    }
    return text;
}
} // namespace mpm::cases

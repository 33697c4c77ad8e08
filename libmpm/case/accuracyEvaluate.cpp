// Errors of the rows, measure by measure: against what, how certain that is, and the parts of space and time.
#include "case/accuracyAnalysis.hpp"
#include "case/accuracyCostTable.hpp"
#include "case/accuracyIntegration.hpp"
#include "case/accuracySample.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using Samples = std::vector<std::optional<Sample>>;

/// All that is done for one measure.
class Judge
{
  public:
    Judge(Evaluation& all, const AccuracyCase& base, std::size_t measure, const ExactSolution& exact,
          std::optional<std::size_t> reference, RowIntegration& integration)
        : integration_(integration), all_(all), base_(base), exact_(exact), measure_(measure),
          m_(all.measures[measure]), decided_(reference), samples_(all.rows.size())
    {}

    void judge()
    {
        const std::size_t begin = all_.lines.size();
        for (std::size_t i = 0; i < all_.rows.size(); ++i)
        {
            if (all_.results[i].status.empty())
                continue;
            CostLine line;
            line.row = i;
            line.measure = measure_;
            if (all_.results[i].done())
                take(line);
            all_.lines.push_back(std::move(line));
        }
        lines_ = {all_.lines.begin() + std::ptrdiff_t(begin), all_.lines.end()};
        if (m_.against == "finest")
            againstFinest();
        if (m_.against == "finestTimeStep")
            againstFinestStep();
        split();
        front();
        std::copy(lines_.begin(), lines_.end(), all_.lines.begin() + std::ptrdiff_t(begin));
    }

  private:
    const Setting& declared(std::size_t row) const { return all_.facts[row].declared; }

    /// The run's sample, and its error where that needs no other run.
    void take(CostLine& line)
    {
        try
        {
            const CaseDirectory run(base_.rowFolder(all_.rows[line.row]));
            samples_[line.row] = takeSample(m_, run);
            const Sample& s = *samples_[line.row];
            if (m_.scalar())
                line.value = s.values.front();
            if (m_.against == "number")
            {
                line.reference = m_.number;
                setError(line, std::abs(line.value - m_.number), std::abs(m_.number));
                line.referenceError = 0;
            }
            if (m_.against == "semiDiscrete")
            {
                const auto& end = integration_.end(run);
                const auto time = run.latestTime().name;
                const auto truth = stateSample(m_, run, end.state, time);
                setError(line, sampleDistance(m_, s, truth), sampleSize(m_, truth));
                line.referenceError = sampleDistance(m_, stateSample(m_, run, end.rougher, time), truth) / line.scale;
            }
            if (m_.against == "exact")
            {
                const auto [error, size] = exactError(m_, run, exact_);
                setError(line, error, size);
                line.referenceError = 0;
            }
        }
        catch (const InputError& error)
        {
            line.note = error.what();
        }
        catch (const StepError& error) // of a reference integration
        {
            line.note = error.what();
        }
    }

    void setError(CostLine& line, double error, double size) const
    {
        line.scale = m_.scale.value_or(size > 0 ? size : 1);
        line.error = error / line.scale;
    }

    /// Row a before row b as a reference?
    bool finer(std::size_t a, std::size_t b) const
    {
        const RowFacts &fa = all_.facts[a], &fb = all_.facts[b];
        if (fa.cellSize != fb.cellSize)
            return fa.cellSize < fb.cellSize;
        if (fa.deltaT != fb.deltaT)
            return fa.deltaT < fb.deltaT;
        return all_.results[a].particles > all_.results[b].particles;
    }

    /// The row decided on, else the finest of those that have a sample; their number if none has.
    std::size_t finest() const
    {
        if (decided_ && samples_[*decided_])
            return *decided_;
        std::size_t best = samples_.size();
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (samples_[i] && (best == samples_.size() || finer(i, best)))
                best = i;
        return best;
    }

    void againstFinest()
    {
        const std::size_t best = finest();
        if (best == samples_.size())
            return;
        const Sample& truth = *samples_[best];
        const double size = sampleSize(m_, truth), scale = m_.scale.value_or(size > 0 ? size : 1);
        const auto known = uncertainty(best);
        for (CostLine& line : lines_)
            if (samples_[line.row])
            {
                compare(line, best, size);
                if (known)
                    line.referenceError = *known / scale;
                if (line.row == best)
                    line.error = line.referenceError;
            }
    }

    /// Richardson over the cell sizes of the reference's own family.
    std::optional<double> uncertainty(std::size_t reference) const
    {
        std::vector<std::size_t> family;
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (samples_[i] && sameButCellSize(declared(i), declared(reference)) &&
                all_.facts[i].cellSize > all_.facts[reference].cellSize)
                family.push_back(i);
        std::sort(family.begin(), family.end(), [&](auto a, auto b) { return finer(a, b); });
        if (family.empty())
            return std::nullopt;
        const auto h = [&](std::size_t i) { return all_.facts[i].cellSize; };
        const auto d = [&](std::size_t i) { return sampleDistance(m_, *samples_[i], *samples_[reference]); };
        const auto estimate = family.size() > 1
                                  ? richardson(h(reference), h(family[0]), d(family[0]), h(family[1]), d(family[1]))
                                  : richardson(h(reference), h(family[0]), d(family[0]));
        return estimate ? std::optional(estimate->error) : std::nullopt;
    }

    void compare(CostLine& line, std::size_t reference, double size) const
    {
        try
        {
            const Sample &s = *samples_[line.row], &truth = *samples_[reference];
            line.referenceRow = all_.rows[reference].name;
            if (m_.scalar())
                line.reference = truth.values.front();
            setError(line, sampleDistance(m_, s, truth), size);
        }
        catch (const InputError& error)
        {
            line.note = error.what();
        }
    }

    /// The run of the same grid and method with the smallest step; nothing if it is alone.
    std::optional<std::size_t> smallestStep(std::size_t row) const
    {
        std::size_t best = row, members = 0;
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (samples_[i] && sameButTimeStep(declared(i), declared(row)))
            {
                ++members;
                if (all_.facts[i].deltaT < all_.facts[best].deltaT)
                    best = i;
            }
        return members > 1 ? std::optional(best) : std::nullopt;
    }

    void againstFinestStep()
    {
        for (CostLine& line : lines_)
            if (const auto best = samples_[line.row] ? smallestStep(line.row) : std::nullopt; best && *best != line.row)
                compare(line, *best, sampleSize(m_, *samples_[*best]));
    }

    /// Of two runs of one grid, at the end or the largest of all stored times.
    double difference(std::size_t a, std::size_t b) const
    {
        if (!m_.storedTimes)
            return sampleDistance(m_, *samples_[a], *samples_[b]);
        const CaseDirectory first(base_.rowFolder(all_.rows[a])), second(base_.rowFolder(all_.rows[b]));
        const auto times = first.times(), others = second.times();
        double largest = 0;
        for (std::size_t i = 0; i < std::min(times.size(), others.size()); ++i)
            largest = std::max(largest, sampleDistance(m_, fieldSample(m_, first, times[i].name),
                                                       fieldSample(m_, second, others[i].name)));
        return largest;
    }

    void split()
    {
        if (m_.against == "finestTimeStep" || m_.against == "semiDiscrete")
        {
            for (CostLine& line : lines_)
                line.temporal = line.error;
            return;
        }
        for (CostLine& line : lines_)
        {
            const auto best = samples_[line.row] ? smallestStep(line.row) : std::nullopt;
            if (!best || !std::isfinite(line.scale))
                continue;
            if (*best != line.row)
                line.temporal = difference(line.row, *best) / line.scale;
            for (const CostLine& other : lines_)
                if (other.row == *best)
                    line.spatial = other.error;
        }
    }

    void front()
    {
        std::vector<double> prices, errors;
        for (const CostLine& line : lines_)
        {
            prices.push_back(all_.results[line.row].cpuSeconds);
            errors.push_back(line.referenceRow == all_.rows[line.row].name ? NAN : line.error);
        }
        const auto best = paretoFront(prices, errors);
        for (std::size_t i = 0; i < lines_.size(); ++i)
            lines_[i].pareto = best[i];
    }

    RowIntegration& integration_;
    Evaluation& all_;
    const AccuracyCase& base_;
    const ExactSolution& exact_;
    std::size_t measure_;
    const Measure& m_;
    std::optional<std::size_t> decided_;
    Samples samples_;
    std::vector<CostLine> lines_;
};
} // namespace

Evaluation evaluate(const AccuracyCase& base, std::vector<MatrixRow> rows, std::vector<RowResult> results,
                    std::vector<Measure> measures, const ExactSolution& exact, std::optional<std::size_t> reference,
                    const ReferenceSolver& solver)
{
    RowIntegration integration(solver);
    Evaluation all;
    for (const auto& row : rows)
        all.facts.push_back(base.facts(row));
    all.rows = std::move(rows);
    all.results = std::move(results);
    all.measures = std::move(measures);
    for (std::size_t i = 0; i < all.measures.size(); ++i)
        Judge(all, base, i, exact, reference, integration).judge();
    return all;
}
} // namespace mpm::cases

#include "case/accuracySample.hpp"

#include "base/csvTable.hpp"
#include "case/accuracyFit.hpp"
#include "output/stateFile.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <unordered_map>

namespace mpm::cases
{
namespace
{
Vector3 positionOf(const state::Particles& p, std::size_t i)
{
    Vector3 x{};
    for (int a = 0; a < p.dim; ++a)
        x[std::size_t(a)] = p.x[std::size_t(a)][i];
    return x;
}

/// Material positions by id: where particles were in the first state.
std::unordered_map<std::int64_t, Vector3> materialPositions(const CaseDirectory& run)
{
    const auto first = output::readState(run.statePath(run.firstTime().name));
    std::unordered_map<std::int64_t, Vector3> out;
    for (std::size_t i = 0; i < std::size_t(first.particles.size()); ++i)
        out[first.particles.id[i]] = positionOf(first.particles, i);
    return out;
}

double valueOf(const std::string& field, int component, const state::Particles& p, std::size_t i, const Vector3& X)
{
    const auto c = std::size_t(component);
    if (field == "velocity")
        return p.v[c][i];
    if (field == "stress")
        return p.stress[c][i];
    return field == "displacement" ? p.x[c][i] - X[c] : p.x[c][i];
}
} // namespace

Sample fieldSample(const Measure& m, const CaseDirectory& run, const std::string& timeName)
{
    return stateSample(m, run, output::readState(run.statePath(timeName)), timeName);
}

Sample stateSample(const Measure& m, const CaseDirectory& run, const state::State& state, const std::string& timeName)
{
    const auto places = materialPositions(run);
    const auto& p = state.particles;
    std::vector<std::size_t> order(static_cast<std::size_t>(p.size()));
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p.id[a] < p.id[b]; });
    Sample out;
    out.components = int(m.components.size());
    out.dim = p.dim;
    out.time = state.time;
    out.spacing = state.seedSpacing[0];
    for (const std::size_t i : order)
    {
        const auto place = places.find(p.id[i]);
        if (place == places.end() || p.generation[i] > 0)
            throw InputError(run.statePath(timeName).string() +
                             ": found particles made by splitting, which have no material position; fields are "
                             "compared without splitting");
        out.X.push_back(place->second);
        out.weights.push_back(p.volume0[i]);
        for (const int c : m.components)
            out.values.push_back(valueOf(m.of, c, p, i, place->second));
    }
    return out;
}

Sample historySample(const Measure& m, const CaseDirectory& run)
{
    const auto table = CsvTable::read(run.folder() / "postProcessing/history.csv");
    const auto time = table.column("time"), column = table.column(m.of);
    if (table.rows().empty())
        throw InputError("postProcessing/history.csv has no row");
    std::vector<std::pair<double, double>> series;
    for (const auto& row : table.rows())
        series.emplace_back(table.number(row, time), table.number(row, column));
    Sample out;
    out.time = series.back().first;
    double value = series.back().second;
    if (m.take == "maximum" || m.take == "minimum")
        for (const auto& [t, v] : series)
            value = m.take == "maximum" ? std::max(value, v) : std::min(value, v);
    if (m.take == "mean" || m.take == "rate")
    {
        const auto first = std::find_if(series.begin(), series.end(),
                                        [&](const auto& row) { return row.first >= out.time - m.window * (1 + 1e-9); });
        if (series.end() - first < 2)
            throw InputError(fmt::format("{}: found one row of history.csv in the last {:g} s, allowed: at least two "
                                         "(historyInterval of controlDict)",
                                         m.name, m.window));
        double area = 0;
        for (auto row = first; row + 1 != series.end(); ++row)
            area += 0.5 * (row[0].second + row[1].second) * (row[1].first - row[0].first);
        value = (m.take == "mean" ? area : series.back().second - first->second) / (series.back().first - first->first);
    }
    out.values = {value};
    return out;
}

Sample profileSample(const Measure& m, const CaseDirectory& run)
{
    const auto state = output::readState(run.statePath(run.latestTime().name));
    const auto& p = state.particles;
    const auto bins = std::size_t(m.bins), component = std::size_t(m.components.front());
    std::vector<double> volumes(bins, 0);
    Sample out;
    out.time = state.time;
    out.values.assign(bins, 0);
    for (std::size_t i = 0; i < std::size_t(p.size()); ++i)
    {
        const Vector3 x = positionOf(p, i);
        bool inside = true;
        for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
            inside = inside && x[a] >= m.low[a] && x[a] < m.high[a];
        if (!inside)
            continue;
        const auto bin = std::min(bins - 1, std::size_t(double(bins) * (x[0] - m.low[0]) / (m.high[0] - m.low[0])));
        volumes[bin] += p.volume[i];
        out.values[bin] += p.volume[i] * p.stress[component][i];
    }
    for (std::size_t b = 0; b < bins; ++b)
        if (volumes[b] > 0)
            out.values[b] /= volumes[b];
    return out;
}

namespace
{
/// rms or largest of the rows of `values`.
double norm(const Measure& m, const std::vector<double>& values, const Sample& like)
{
    const std::size_t k = std::size_t(like.components), n = values.size() / k;
    double sum = 0, weights = 0, largest = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
        double square = 0;
        for (std::size_t c = 0; c < k; ++c)
            square += values[i * k + c] * values[i * k + c];
        const double weight = like.weights.empty() ? 1 : like.weights[i];
        sum += weight * square;
        weights += weight;
        largest = std::max(largest, square);
    }
    return std::sqrt(m.largest ? largest : weights > 0 ? sum / weights : 0);
}
} // namespace

double sampleSize(const Measure& m, const Sample& sample)
{
    return norm(m, sample.values, sample);
}

double sampleDistance(const Measure& m, const Sample& a, const Sample& b)
{
    std::vector<double> difference = a.values;
    const auto other = a.X.empty() || a.X == b.X ? b.values : fitAt(b, a.X);
    for (std::size_t i = 0; i < difference.size(); ++i)
        difference[i] -= other[i];
    return norm(m, difference, a);
}
} // namespace mpm::cases

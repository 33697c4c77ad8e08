#include "case/accuracyMeasure.hpp"

#include "case/accuracySample.hpp"
#include "stepping/energyBudget.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

namespace
{
std::vector<std::string> componentNames(const std::string& field, int dim)
{
    std::vector<std::string> names;
    for (int k = 0; k < (field == "stress" ? stressComponents(dim) : dim); ++k)
        names.emplace_back(field == "stress" ? stressNames[std::size_t(k)] : axisNames[std::size_t(k)]);
    return names;
}

void readComponents(const Dictionary& d, Measure& m, int dim)
{
    const auto names = componentNames(m.of, dim);
    if (!d.found("component"))
    {
        for (int k = 0; k < int(names.size()); ++k)
            m.components.push_back(k);
        return;
    }
    std::vector<dictionary::Choice> choices;
    for (const auto& name : names)
        choices.push_back({name, ""});
    const auto wanted = d.choose("component", "of the field", choices);
    m.components = {int(std::find(names.begin(), names.end(), wanted) - names.begin())};
}

void readField(const Dictionary& d, Measure& m, int dim)
{
    m.kind = MeasureKind::field;
    m.of = d.choose("field", "of the particles",
                    {{"displacement", "[m]"}, {"position", "[m]"}, {"velocity", "[m/s]"}, {"stress", "Cauchy [Pa]"}});
    readComponents(d, m, dim);
    m.largest = d.choose("norm", "over the particles", {{"rms", "weighted by initial volume"}, {"max", "the largest"}},
                         "rms") == "max";
    m.storedTimes = d.choose("over", "which times", {{"end", "the end"}, {"storedTimes", "the largest of all"}},
                             "end") == "storedTimes";
}

void readHistory(const Dictionary& d, Measure& m)
{
    m.kind = MeasureKind::history;
    std::vector<dictionary::Choice> columns;
    for (const auto& column : stepping::historyColumns())
        columns.push_back({column, ""});
    m.of = d.choose("history", "column of postProcessing/history.csv", columns);
    m.take = d.choose("take", "of the column",
                      {{"end", "last row"},
                       {"maximum", "largest"},
                       {"minimum", "smallest"},
                       {"mean", "over the window"},
                       {"rate", "change over the window, a second"}},
                      "end");
    if (m.take == "mean" || m.take == "rate")
        m.window = d.get<double>({"window", "time before the end", unit::time, Bound::positive()});
}

void readProfile(const Dictionary& d, Measure& m, int dim)
{
    m.kind = MeasureKind::profile;
    m.of = d.choose("profile", "field", {{"stress", "Cauchy [Pa]"}});
    readComponents(d, m, dim);
    if (m.components.size() != 1)
        throw InputError(d.where(), "component: is missing (allowed: xx, yy, zz, xy ...)");
    m.low = d.get<Vector3>({"low", "lower corner of all boxes", unit::length});
    m.high = d.get<Vector3>({"high", "upper corner", unit::length});
    for (int a = 0; a < dim; ++a)
        if (!(m.high[std::size_t(a)] > m.low[std::size_t(a)]))
            d.fail("high", fmt::format("{:g} along {}", m.high[std::size_t(a)], axisNames[std::size_t(a)]),
                   fmt::format("> {:g} of low", m.low[std::size_t(a)]));
    m.bins = d.get<Index>({"bins", "boxes along x", unit::none, Bound::between(1, 100000)});
}

void readAgainst(const Dictionary& d, Measure& m, const ExactSolution& exact)
{
    m.against = d.choose("against", "what the run is compared with",
                         {{"exact", "the solution in `exact`"},
                          {"number", "`value`"},
                          {"finest", "the finest run"},
                          {"finestTimeStep", "the run of the same grid with the smallest step"},
                          {"semiDiscrete", "the equations of the same grid before time is cut into steps"}});
    if (m.against == "semiDiscrete" && m.kind != MeasureKind::field)
        d.fail("against", "semiDiscrete", "number, finest or finestTimeStep, as the measure is no field");
    if (m.against == "exact" && (m.kind != MeasureKind::field || !exact.has(m.of)))
        d.fail("against", m.kind == MeasureKind::field ? "exact, of which `exact` says nothing for " + m.of : "exact",
               m.kind == MeasureKind::field ? "a field that stands in `exact`"
                                            : "number, finest, finestTimeStep or semiDiscrete");
    if (m.against == "number" && !m.scalar())
        d.fail("against", "number", "exact, finest or finestTimeStep, as the measure is no scalar");
    if (m.against == "number")
        m.number = d.get<double>({"value", "what should come out"});
    if (m.storedTimes && m.against != "exact")
        d.fail("over", "storedTimes", "end, as only exact solutions are known at all times");
    if (d.found("scale"))
        m.scale = d.get<double>({"scale", "the error is divided by it", unit::none, Bound::positive()});
}
} // namespace

std::vector<Measure> readMeasures(const Dictionary& all, const ExactSolution& exact, int dim)
{
    const Dictionary& measures = all.subDict("measures", "what is called the error");
    std::vector<Measure> out;
    for (const auto& name : measures.dictNames())
    {
        const Dictionary& d = measures.subDict(name, "a measure");
        Measure m;
        m.name = name;
        const int kinds = int(d.found("field")) + int(d.found("history")) + int(d.found("profile"));
        if (kinds != 1)
            throw InputError(
                d.where(),
                fmt::format("{}: found {} of the words field, history and profile, allowed: one", name, kinds));
        if (d.found("field"))
            readField(d, m, dim);
        else if (d.found("history"))
            readHistory(d, m);
        else
            readProfile(d, m, dim);
        readAgainst(d, m, exact);
        out.push_back(std::move(m));
    }
    if (out.empty())
        throw InputError(measures.where(), "found no measure, allowed: at least one, as runOut { history maxX; "
                                           "against finest; }");
    return out;
}

Sample takeSample(const Measure& m, const CaseDirectory& run)
{
    switch (m.kind)
    {
    case MeasureKind::history:
        return historySample(m, run);
    case MeasureKind::profile:
        return profileSample(m, run);
    case MeasureKind::field:
        break;
    }
    return fieldSample(m, run, run.latestTime().name);
}

Sample exactSample(const Measure& m, const Sample& like, const ExactSolution& exact)
{
    Sample out = like;
    const std::size_t n = like.X.size(), k = m.components.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < k; ++c)
            out.values[i * k + c] = exact.value(m.of, m.components[c], like.X[i], like.time);
    return out;
}

std::pair<double, double> exactError(const Measure& m, const CaseDirectory& run, const ExactSolution& exact)
{
    std::vector<std::string> times{run.latestTime().name};
    if (m.storedTimes)
    {
        times.clear();
        for (const auto& time : run.times())
            times.push_back(time.name);
    }
    std::pair<double, double> worst{0, 0};
    for (const auto& time : times)
    {
        const Sample sample = fieldSample(m, run, time);
        const Sample truth = exactSample(m, sample, exact);
        worst.first = std::max(worst.first, sampleDistance(m, sample, truth));
        worst.second = std::max(worst.second, sampleSize(m, truth));
    }
    return worst;
}
} // namespace mpm::cases

#include "reference/lawCheck.hpp"

#include "base/terminal.hpp"
#include "constitutive/vonMises.hpp"
#include "reference/vonMisesRates.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::reference
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

namespace
{
std::shared_ptr<const constitutive::Law> findLaw(const Dictionary& d, const Laws& laws)
{
    std::vector<dictionary::Choice> names;
    for (const auto& [name, law] : laws)
        names.push_back({name, law->describe()});
    return laws.at(d.choose("material", "dictionary in constant/materialProperties", names));
}

std::vector<int> readSteps(const Dictionary& d, const std::string& word, const std::string& help, double last)
{
    std::vector<double> doubling;
    for (double n = 1; n <= last; n *= 2)
        doubling.push_back(n);
    std::vector<int> steps;
    for (const double n : d.get<std::vector<double>>({word, help, unit::none, Bound::between(1, 1e6), doubling}))
    {
        if (n != std::floor(n) || (!steps.empty() && n <= steps.back()))
            d.fail(word, fmt::format("{:g}", n), "growing whole numbers");
        steps.push_back(int(n));
    }
    if (steps.empty())
        d.fail(word, "an empty list", "growing whole numbers");
    return steps;
}

Harmonic readHarmonic(const Dictionary& d)
{
    Harmonic out;
    out.sine = d.choose("function", "of time", {{"cos", "amplitude cos(w t)"}, {"sin", "amplitude sin(w t)"}}) == "sin";
    out.amplitude = d.get<double>({"amplitude", "strain rate, tensor component", unit::rate});
    out.angularFrequency = d.get<double>({"angularFrequency", "w [rad/s]", unit::rate, Bound::nonNegative(), 0.0});
    return out;
}

SymmetricTensor readStress(const Dictionary& d)
{
    const auto values = d.get<std::vector<double>>({"startStress", "stress at the start, xx yy zz xy yz zx",
                                                    unit::pressure, Bound::any(), std::vector<double>(6, 0.0)});
    if (values.size() != 6)
        d.fail("startStress", fmt::format("{} numbers", values.size()), "6, (xx yy zz xy yz zx)");
    SymmetricTensor out;
    std::copy(values.begin(), values.end(), out.begin());
    return out;
}

LawCheck readPath(const Dictionary& dict, const Dictionary& d, const std::string& name, const Laws& laws,
                  const std::vector<int>& steps)
{
    const double end = d.get<double>({"endTime", "length of the path", unit::time, Bound::positive()});
    std::array<Harmonic, 6> rates;
    const Dictionary& rate = d.subDict("rate", "strain rates of the components");
    for (int k = 0; k < 6; ++k)
        if (const Dictionary* component = rate.findDict(stressNames[k], "strain rate of this component"))
            rates[k] = readHarmonic(*component);
    auto law = d.found("law")        ? std::shared_ptr<const constitutive::Law>(constitutive::makeLaw(d))
               : d.found("material") ? findLaw(d, laws)
                                     : findLaw(dict, laws);
    const double spin = d.get<double>({"spin", "of the axes of the rates about z", unit::rate, Bound::any(), 0.0});
    return {name, std::move(law), readStress(d), StrainPath::turning(rates, spin, end), steps, {}};
}

/// The rows of one particle within a span of time.
struct Record
{
    std::vector<double> times;
    std::vector<SymmetricTensor> strains, stresses;
};

std::map<Index, Record> readRecords(const std::filesystem::path& file, double from, double to)
{
    const CsvTable table = CsvTable::read(file);
    const auto particle = table.column("particle"), time = table.column("time");
    std::array<std::size_t, 6> e, s;
    for (int k = 0; k < 6; ++k)
    {
        e[k] = table.column(std::string("e") + stressNames[k]);
        s[k] = table.column(std::string("s") + stressNames[k]);
    }
    std::map<Index, Record> records;
    for (const auto& row : table.rows())
    {
        const double t = table.number(row, time), id = table.number(row, particle);
        if (id != std::floor(id) || id < 0)
            table.fail(row, particle, "a particle's id, a whole number");
        Record& record = records[Index(id)];
        if (t < from || t > to)
            continue;
        if (!record.times.empty() && !(t > record.times.back()))
            table.fail(row, time, fmt::format("growing times, > {:g}", record.times.back()));
        record.times.push_back(t);
        record.strains.emplace_back();
        record.stresses.emplace_back();
        for (int k = 0; k < 6; ++k)
        {
            record.strains.back()[k] = table.number(row, e[k]);
            record.stresses.back()[k] = table.number(row, s[k]);
        }
    }
    return records;
}

void readRecorded(const Dictionary& dict, const Dictionary& d, const Laws& laws, const std::filesystem::path& folder,
                  std::vector<LawCheck>& checks)
{
    const auto file = d.get<std::string>(
        {"file", "strain paths mpmSolve recorded", unit::none, {}, std::string("postProcessing/strainPaths.csv")});
    const double from = d.get<double>({"from", "begin", unit::time, {}, -1e300});
    const double to = d.get<double>({"to", "end", unit::time, {}, 1e300});
    const auto steps = readSteps(d, "subdivisions", "steps of the return map in each recorded increment", 32);
    const auto wanted = d.get<std::vector<double>>(
        {"particles", "ids; default: all", unit::none, Bound::nonNegative(), std::vector<double>{}});
    const auto law = d.found("material") ? findLaw(d, laws) : findLaw(dict, laws);
    if (!std::filesystem::is_regular_file(folder / file))
        throw InputError(d.where(),
                         fmt::format("recorded: found no {}, allowed is a record: let mpmSolve write it with "
                                     "recordStrain {{ particles (...); }} in system/controlDict",
                                     (folder / file).string()));

    auto records = readRecords(folder / file, from, to);
    std::vector<std::string> there;
    for (const auto& record : records)
        there.push_back(std::to_string(record.first));
    std::vector<Index> ids;
    for (const double id : wanted)
    {
        if (id != std::floor(id) || !records.count(Index(id)))
            d.fail("particles", fmt::format("{:g}", id), joinWords(there));
        ids.push_back(Index(id));
    }
    if (wanted.empty())
        for (const auto& record : records)
            ids.push_back(record.first);
    for (const Index id : ids)
    {
        Record& r = records[id];
        if (r.times.size() < 2)
            d.fail(d.found("from") ? "from" : "file", fmt::format("{} rows of particle {}", r.times.size(), id),
                   "at least 2 between from and to");
        checks.push_back({fmt::format("particle {}", id), law, r.stresses.front(),
                          StrainPath::table(r.times, r.strains), steps, r.stresses.back()});
    }
}

double norm(const SymmetricTensor& s)
{
    double sum = 0;
    for (const double x : s)
        sum += x * x;
    return std::sqrt(sum);
}
} // namespace

std::vector<LawCheck> readLawChecks(const Dictionary& dict, const Laws& laws, const std::filesystem::path& folder)
{
    std::vector<LawCheck> checks;
    const auto steps = readSteps(dict, "steps", "of the return map over a path", 512);
    dict.found("material");
    dict.passOver("time", "temporal errors, for checkIntegration -time");
    if (const Dictionary* paths = dict.findDict("paths", "strain rates as functions of time"))
        for (const auto& name : paths->dictNames())
            checks.push_back(readPath(dict, paths->subDict(name, "a path"), name, laws, steps));
    if (const Dictionary* recorded = dict.findDict("recorded", "strain paths recorded by mpmSolve"))
        readRecorded(dict, *recorded, laws, folder, checks);
    dict.rejectUnread();
    if (checks.empty())
        throw InputError(dict.where(), "found no path, allowed is paths { ... } and recorded { ... }");
    return checks;
}

namespace
{
/// The solution of a law's rate equations, and the law without sub-steps (null: it has none).
struct Judged
{
    RateSolution exact;
    std::unique_ptr<const constitutive::Law> plain;
};

Judged solve(const LawCheck& check)
{
    const auto* soil = dynamic_cast<const constitutive::MohrCoulomb*>(check.law.get());
    const auto* cone = dynamic_cast<const constitutive::DruckerPrager*>(check.law.get());
    if ((soil && (soil->cutsOff() || soil->usesHistory())) || (cone && cone->cone().limit < cone->cone().apex))
        throw InputError(fmt::format("found {} with tensionCutOff or softening, allowed are laws without: their rate "
                                     "equations are known",
                                     check.law->name()));
    if (cone)
        return {integrateRates(cone->parameters(), check.start, check.path),
                cone->substep() ? std::make_unique<constitutive::DruckerPrager>(cone->parameters()) : nullptr};
    if (const auto* law = soil)
        return {integrateRates(law->parameters(), check.start, check.path),
                law->substep() ? std::make_unique<constitutive::MohrCoulomb>(law->parameters()) : nullptr};
    if (const auto* law = dynamic_cast<const constitutive::VonMises*>(check.law.get()))
        return {integrateRates(VonMisesParameters{law->moduli(), law->yieldStress()}, check.start, check.path),
                law->substep() ? std::make_unique<constitutive::VonMises>(law->moduli(), law->yieldStress()) : nullptr};
    throw InputError(fmt::format(
        "found the law {}, allowed are mohrCoulomb, tresca, druckerPrager and vonMises, whose rate equations are known",
        check.law->name()));
}
} // namespace

LawCheckResult runLawCheck(const LawCheck& check)
{
    LawCheckResult out;
    std::unique_ptr<const constitutive::Law> without;
    try
    {
        Judged judged = solve(check);
        out.exact = std::move(judged.exact);
        without = std::move(judged.plain);
    }
    catch (const InputError& error)
    {
        throw InputError(check.name + ": " + error.what());
    }
    const auto& plain = without ? *without : *check.law;
    out.rows = judgeReturnMap(plain, check.start, check.path, out.exact, check.steps);
    if (without)
        out.substeps = judgeSubsteps(*check.law, plain, check.start, check.path, out.exact, check.steps);
    if (check.recordedEnd)
    {
        const auto undivided = judgeReturnMap(plain, check.start, check.path, out.exact, {1}).front().stress;
        double size = 0;
        for (const auto& s : out.exact.stress)
            size = std::max(size, norm(s));
        SymmetricTensor d;
        for (int k = 0; k < 6; ++k)
            d[k] = undivided[k] - (*check.recordedEnd)[k];
        out.recordError = norm(d) / (size > 0 ? size : 1);
    }
    return out;
}

std::string lawCheckText(const LawCheck& check, const LawCheckResult& result)
{
    std::map<Region, int> entered;
    for (const auto& event : result.exact.events)
        ++entered[event.region];
    std::string regions;
    for (const auto& [region, count] : entered)
        regions += fmt::format("{}{} x {}", regions.empty() ? "" : ", ", constitutive::regionName(region), count);
    const auto& s = result.exact.stress.back();
    std::string text = fmt::format(
        "{}: {}\n  exact stress xx {:.6f} yy {:.6f} zz {:.6f} xy {:.6f} yz {:.6f} zx {:.6f} Pa, {}, drift of f {:.1e}\n"
        "  regions entered: {}{}\n",
        check.name, check.law->describe(), s[0], s[1], s[2], s[3], s[4], s[5],
        result.exact.yieldTime ? fmt::format("first yield at {:.8f} s", *result.exact.yieldTime) : "no yield",
        result.exact.drift, regions,
        result.recordError ? fmt::format("; recorded stress differs by {:.1e}", *result.recordError) : "");
    Table table({check.path.straight() ? "steps per increment" : "steps", "error at the end", "largest error", "order",
                 "f/scale"});
    for (const auto& row : result.rows)
        table.row({std::to_string(row.steps), fmt::format("{:.4e}", row.final), fmt::format("{:.4e}", row.largest),
                   row.order ? fmt::format("{:.2f}", *row.order) : "-", fmt::format("{:.1e}", row.yield)});
    text += table.text();
    if (result.substeps.empty())
        return text;
    Table substeps(
        {"steps, in sub-steps", "error at the end", "largest error", "f/scale", "law calls a step", "time ratio"});
    for (const auto& row : result.substeps)
        substeps.row({std::to_string(row.steps), fmt::format("{:.4e}", row.final), fmt::format("{:.4e}", row.largest),
                      fmt::format("{:.1e}", row.yield), fmt::format("{:.1f}", row.calls),
                      fmt::format("{:.1f}", row.time)});
    return text + substeps.text();
}

CsvTable lawCheckTable()
{
    return CsvTable({"path", "method", "steps", "error", "largestError", "order", "yield", "lawCalls", "timeRatio",
                     "yieldTime", "drift", "recordError"});
}

void addLawCheckRows(CsvTable& table, const LawCheck& check, const LawCheckResult& result)
{
    const auto text = [](std::optional<double> x) { return x ? fmt::format("{:.17g}", *x) : std::string(); };
    for (const auto& row : result.rows)
        table.addRow({check.name, "returnMap", std::to_string(row.steps), text(row.final), text(row.largest),
                      text(row.order), text(row.yield), "1", "1", text(result.exact.yieldTime),
                      text(result.exact.drift), text(result.recordError)});
    for (const auto& row : result.substeps)
        table.addRow({check.name, "substep", std::to_string(row.steps), text(row.final), text(row.largest), "",
                      text(row.yield), text(row.calls), text(row.time), text(result.exact.yieldTime),
                      text(result.exact.drift), ""});
}
} // namespace mpm::reference

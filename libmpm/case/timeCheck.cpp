#include "case/timeCheck.hpp"

#include "base/error.hpp"
#include "base/terminal.hpp"
#include "case/makeStepper.hpp"
#include "dictionary/expression.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/timeStep.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
using dictionary::Bound;
using dictionary::Dictionary;
namespace unit = dictionary::unit;

const std::vector<dictionary::Choice>& schemeCatalogue()
{
    static const std::vector<dictionary::Choice> catalogue = {
        {"USF", "stress before the forces"},
        {"USL", "stress last"},
        {"MUSL", "stress last, from a second projection"},
        {"staggeredUSL", "USL, the first kick half a step"},
        {"staggeredMUSL", "MUSL, the first kick half a step"},
        {"strainVelocityMUSL", "MUSL, particles moved by what strains them"},
        {"RK2", "midpoint rule"},
        {"RK4", "classical Runge-Kutta"}};
    return catalogue;
}

namespace
{
bool isRungeKutta(const std::string& scheme)
{
    return scheme == "RK2" || scheme == "RK4";
}

std::vector<std::string> schemeNames()
{
    std::vector<std::string> names;
    for (const auto& choice : schemeCatalogue())
        names.push_back(choice.name);
    return names;
}

/// Distances falling, the first and all others > 0.
std::vector<double> readFalling(const Dictionary& d, const dictionary::Entry<std::vector<double>>& entry)
{
    const auto values = d.get<std::vector<double>>(entry);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (i > 0 && values[i] >= values[i - 1])
            d.fail(entry.word, fmt::format("{:g} after {:g}", values[i], values[i - 1]), "falling values");
    if (values.empty())
        d.fail(entry.word, "an empty list", "falling values");
    return values;
}

/// Displacements as functions of the reference position.
ExactDisplacement readExact(const Dictionary& d, const state::State& state)
{
    if (!state.particles.hasX() && state.step > 0)
        throw InputError(
            d.where(), fmt::format("exact: found a state at t = {:g} s without reference positions, allowed is one at "
                                   "the start, or a run with fields (referencePosition) in system/controlDict",
                                   state.time));
    const std::vector<std::string> variables = {"X", "Y", "Z", "t"};
    const auto constants = dictionary::readConstants(d, variables);
    const auto displacement =
        dictionary::readVectorExpression(d, "displacement", "of the material point X Y Z at time t", unit::length,
                                         state.particles.dim, variables, constants, true);
    return [displacement](const Vector3& X, double time) {
        Vector3 u{};
        for (std::size_t a = 0; a < 3; ++a)
            u[a] = displacement[a].evaluate({X[0], X[1], X[2], time});
        return u;
    };
}
} // namespace

std::string whyNotScheme(const std::string& scheme, const SceneOfCase& scene)
{
    if (scheme == "strainVelocityMUSL" && scene.scene.transfer != stepping::Transfer::FLIP)
        return "only the transfer FLIP moves particles by the velocity of their strains";
    return isRungeKutta(scheme) ? whyNotSmooth(scene.shape, scene.scene) : std::string();
}

std::unique_ptr<stepping::Stepper> makeScheme(const std::string& scheme, const SceneOfCase& scene, state::State& state)
{
    if (isRungeKutta(scheme))
        return makeRungeKutta(scene.shape,
                              scheme == "RK2" ? stepping::RungeKuttaOrder::RK2 : stepping::RungeKuttaOrder::RK4, state,
                              scene.scene);
    auto own = scene.scene;
    own.stressUpdate = scheme.ends_with("MUSL")  ? stepping::StressUpdate::MUSL
                       : scheme.ends_with("USL") ? stepping::StressUpdate::USL
                                                 : stepping::StressUpdate::USF;
    own.timeIntegration = stepping::TimeIntegration::symplecticEuler;
    own.staggeredStart = scheme.starts_with("staggered");
    own.moveByStrainVelocity = scheme.starts_with("strainVelocity");
    return makeStepper(scene.shape, state, own);
}

TimeCheck readTimeCheck(const Dictionary& dict, const SceneOfCase& scene, const state::State& state)
{
    TimeCheck check;
    const Dictionary& d = dict.subDict("time", "temporal errors");
    check.window = d.get<double>({"window", "length of the runs", unit::time, Bound::positive()});
    check.tolerance = d.get<double>({"tolerance", "of the reference", {}, Bound::between(1e-15, 1e-3), 1e-12});
    const double wave = stepping::fastestWave(state, scene.scene.materials);
    if (d.found("deltaT"))
        check.deltaT = readFalling(d, {"deltaT", "time steps of the runs", unit::time, Bound::positive()});
    else
        for (const double courant : readFalling(d, {"courant", "c_p dt/h of the runs", unit::none, Bound::positive(),
                                                    std::vector<double>{0.4, 0.2, 0.1, 0.05}}))
            check.deltaT.push_back(courant * state.grid.h / wave);
    std::vector<std::string> possible;
    for (const auto& name : schemeNames())
        if (whyNotScheme(name, scene).empty())
            possible.push_back(name);
    check.schemes = d.get<std::vector<std::string>>({"schemes", "to be run", unit::none, {}, possible});
    if (const Dictionary* exact = d.findDict("exact", "the exact solution"))
        check.exact = readExact(*exact, state);
    for (const auto& name : check.schemes)
    {
        const auto names = schemeNames();
        if (std::find(names.begin(), names.end(), name) == names.end())
            d.fail("schemes", "'" + name + "'", joinWords(names));
        if (const auto why = whyNotScheme(name, scene); !why.empty())
            d.fail("schemes", name + " (" + why + ")", joinWords(possible));
    }
    dict.passOver("material", "for checkIntegration -law");
    dict.passOver("steps", "for checkIntegration -law");
    dict.passOver("paths", "for checkIntegration -law");
    dict.passOver("recorded", "for checkIntegration -law");
    dict.rejectUnread();
    return check;
}

namespace
{
/// Positions of the particles by rank of their ids.
using Positions = std::vector<Vector3>;

/// Columns x of a state, or X.
Positions byId(const state::Particles& p, const std::array<state::Column<double>, 3>& columns)
{
    std::vector<std::size_t> order(std::size_t(p.size()));
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p.id[a] < p.id[b]; });
    Positions out(order.size(), Vector3{});
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t a = 0; a < std::size_t(p.dim); ++a)
            out[i][a] = columns[a][order[i]];
    return out;
}

Positions positionsOf(const state::State& state)
{
    return byId(state.particles, state.particles.x);
}

/// RMS distance, the short way round where an axis is periodic.
double distanceIn(const state::GridBox& grid, const Positions& a, const Positions& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
        {
            double d = a[i][k] - b[i][k];
            if (grid.periodic[k])
                d = std::remainder(d, grid.upper(int(k)) - grid.origin[k]);
            sum += d * d;
        }
    return std::sqrt(sum / double(std::max<std::size_t>(1, a.size())));
}

class Comparison
{
  public:
    Comparison(const TimeCheck& check, const SceneOfCase& scene, const state::State& start,
               const ReferenceSolver& solver)
        : check_(check), scene_(scene), start_(start), solver_(solver)
    {}

    TimeCheckResult run()
    {
        out_.waveSpeed = stepping::fastestWave(start_, scene_.scene.materials);
        out_.noOde = whyNotSmooth(scene_.shape, scene_.scene);
        if (out_.noOde.empty())
            solveReference();
        for (const auto& scheme : check_.schemes)
            runScheme(scheme);
        return std::move(out_);
    }

  private:
    /// Steps of the first run, and a multiple of them where dt is a part of its.
    int steps(double deltaT) const
    {
        const int first = std::max(1, int(std::lround(check_.window / check_.deltaT.front())));
        const double parts = check_.deltaT.front() / deltaT;
        return std::abs(parts - std::round(parts)) < 1e-6 ? first * int(std::lround(parts))
                                                          : std::max(1, int(std::lround(check_.window / deltaT)));
    }

    void solveReference()
    {
        const auto model = stepping::semiDiscreteModel(scene_.scene);
        Positions rough;
        for (const double tolerance : {100 * check_.tolerance, check_.tolerance})
        {
            auto equations = makeSemiDiscrete(scene_.shape, start_, scene_.scene);
            const auto y = solver_(*equations, start_, model, check_.window, tolerance);
            state::State end = start_;
            equations->unpack(y.data(), end);
            rough = std::move(reference_);
            reference_ = positionsOf(end);
        }
        out_.referenceError = distance(rough, reference_);
        if (check_.exact)
            out_.spatial = distance(reference_, exactPositions());
    }

    Positions exactPositions() const
    {
        const auto& p = start_.particles;
        Positions out = p.hasX() ? byId(p, p.X) : positionsOf(start_);
        for (auto& x : out)
        {
            const Vector3 u = check_.exact(x, start_.time + check_.window);
            for (std::size_t a = 0; a < 3; ++a)
                x[a] += u[a];
        }
        return out;
    }

    double distance(const Positions& a, const Positions& b) const { return distanceIn(start_.grid, a, b); }

    Positions positionsAfter(const std::string& scheme, int count) const
    {
        state::State state = start_;
        state.step = 0; // a start: velocities and positions belong to the same time
        stepping::beginLedger(state, scene_.scene.materials);
        auto stepper = makeScheme(scheme, scene_, state);
        for (int n = 0; n < count; ++n)
            stepper->step(check_.window / count);
        return positionsOf(state);
    }

    void runScheme(const std::string& scheme)
    {
        std::vector<Positions> ends;
        std::vector<TimeCheckRow> rows;
        for (const double deltaT : check_.deltaT)
        {
            TimeCheckRow row;
            row.scheme = scheme;
            row.steps = steps(deltaT);
            row.deltaT = check_.window / row.steps;
            ends.emplace_back();
            try
            {
                ends.back() = positionsAfter(scheme, row.steps);
            }
            catch (const StepError& error)
            {
                row.failure = error.what();
            }
            rows.push_back(row);
        }
        const Positions reference = out_.noOde.empty() ? reference_ : ownReference(scheme, rows, ends);
        const TimeCheckRow* before = nullptr;
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            auto& row = rows[i];
            if (row.failure.empty() && reference.empty())
                row.failure = "its reference, the scheme at half the smallest deltaT, failed";
            if (!row.failure.empty())
                continue;
            row.error = distance(ends[i], reference);
            if (check_.exact)
                row.total = distance(ends[i], exactPositions());
            if (before && before->error > 0 && row.error > 0)
                row.order = std::log(before->error / row.error) / std::log(before->deltaT / row.deltaT);
            before = &row;
        }
        out_.rows.insert(out_.rows.end(), rows.begin(), rows.end());
    }

    /// Extrapolated from the finest run and the scheme at half its step, with the order seen between the last three.
    Positions ownReference(const std::string& scheme, const std::vector<TimeCheckRow>& rows,
                           const std::vector<Positions>& ends)
    {
        const Positions& fine = ends.back();
        if (fine.empty())
            return {};
        try
        {
            Positions out = positionsAfter(scheme, 2 * rows.back().steps);
            double order = 1;
            if (const std::size_t n = ends.size();
                n > 1 && !ends[n - 2].empty() && 2 * rows[n - 2].steps == rows[n - 1].steps)
                order = std::clamp(std::log2(distance(ends[n - 2], fine) / distance(fine, out)), 0.5, 4.0);
            const double part = 1 / (std::exp2(order) - 1);
            out_.pairErrors.emplace_back(scheme, part * distance(fine, out));
            for (std::size_t i = 0; i < out.size(); ++i)
                for (std::size_t a = 0; a < 3; ++a)
                    out[i][a] += part * (out[i][a] - fine[i][a]);
            return out;
        }
        catch (const StepError&)
        {
            return {};
        }
    }

    const TimeCheck& check_;
    const SceneOfCase& scene_;
    const state::State& start_;
    const ReferenceSolver& solver_;
    TimeCheckResult out_;
    Positions reference_;
};

std::string number(std::optional<double> x, const char* format = "{:.4e}")
{
    return x ? fmt::format(fmt::runtime(format), *x) : "-";
}
} // namespace

TimeCheckResult runTimeCheck(const TimeCheck& check, const SceneOfCase& scene, const state::State& start,
                             const ReferenceSolver& solver)
{
    return Comparison(check, scene, start, solver).run();
}

std::string timeCheckText(const TimeCheck& check, const TimeCheckResult& result, const SceneOfCase& scene,
                          const state::State& start)
{
    std::string text = fmt::format("{} particles, shape {}, from t = {:g} s over {:g} s, c_p = {:.4g} m/s\n",
                                   start.particles.size(), scene.shape, start.time, check.window, result.waveSpeed);
    if (result.noOde.empty())
        text += fmt::format("reference: semi-discrete equations by SUNDIALS CVODE, own error {:.1e} m\n",
                            result.referenceError);
    else
    {
        text +=
            fmt::format("reference: each scheme itself, extrapolated from its smallest deltaT and half of it, as {}\n",
                        result.noOde);
        for (const auto& [scheme, error] : result.pairErrors)
            text += fmt::format("  {}: own error {:.1e} m\n", scheme, error);
    }
    if (result.spatial)
        text += fmt::format("spatial error (reference against the exact solution): {:.4e} m\n", *result.spatial);
    std::vector<std::string> heads = {"scheme", "dt [s]", "c_p dt/h", "steps", "temporal error [m]", "order"};
    if (check.exact)
        heads.push_back("total error [m]");
    Table table(heads);
    std::string failures;
    for (const auto& row : result.rows)
    {
        std::vector<std::string> cells = {row.scheme,
                                          fmt::format("{:.4g}", row.deltaT),
                                          fmt::format("{:.4g}", result.waveSpeed * row.deltaT / start.grid.h),
                                          std::to_string(row.steps),
                                          row.failure.empty() ? number(row.error) : "failed",
                                          number(row.order, "{:.2f}")};
        if (check.exact)
            cells.push_back(number(row.total));
        table.row(cells);
        if (!row.failure.empty())
            failures += fmt::format("{} with dt = {:.4g} s: {}\n", row.scheme, row.deltaT, row.failure);
    }
    return text + table.text() + failures;
}

CsvTable timeCheckTable(const TimeCheckResult& result, double cellSize)
{
    CsvTable table({"scheme", "deltaT", "courant", "steps", "temporalError", "order", "spatialError", "totalError",
                    "referenceError", "failure"});
    const auto text = [](std::optional<double> x) { return x ? fmt::format("{:.17g}", *x) : std::string(); };
    for (const auto& row : result.rows)
    {
        double own = result.referenceError;
        for (const auto& [scheme, error] : result.pairErrors)
            own = scheme == row.scheme ? error : own;
        table.addRow({row.scheme, text(row.deltaT), text(result.waveSpeed * row.deltaT / cellSize),
                      std::to_string(row.steps), row.failure.empty() ? text(row.error) : std::string(), text(row.order),
                      text(result.spatial), text(row.total), text(own), row.failure});
    }
    return table;
}
} // namespace mpm::cases

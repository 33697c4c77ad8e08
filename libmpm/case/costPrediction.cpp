#include "case/costPrediction.hpp"

#include "base/clock.hpp"
#include "base/terminal.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
constexpr double countedSteps = 2e7; ///< more are estimated: counting takes some 10 ns each

constexpr double busy = 1.15, tellingShare = 1.02; ///< ratios worth a word

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

std::string whole(double number)
{
    return number < 1e15 ? fmt::format("{:.0f}", number) : fmt::format("{:.3g}", number);
}
} // namespace

RunCount countRun(const RunTime& runTime, double time, Index step, double firstLimit, double limit)
{
    RunCount count;
    count.exact = !runTime.adjustable();
    while (!runTime.done(time))
    {
        const double before = time, dt = runTime.nextStep(time, step == 0 ? firstLimit : limit);
        if (count.steps >= countedSteps)
        {
            const double factor = 1 + (runTime.endTime() - time) / dt / count.steps;
            return {factor * count.steps, factor * count.states, factor * count.rows, false};
        }
        time += dt;
        ++step;
        ++count.steps;
        const bool last = runTime.done(time);
        count.rows += step % runTime.historyInterval() == 0 || last;
        count.states += runTime.writeNow(before, time, step);
        if (!(time > before)) // a step below the resolution of time: the run itself would stand still
            return {std::numeric_limits<double>::infinity(), count.states, count.rows, false};
    }
    return count;
}

Seconds processSeconds()
{
    timespec t = {};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return {double(t.tv_sec) + 1e-9 * double(t.tv_nsec), now()};
}

Spread spreadOf(const std::vector<Seconds>& values)
{
    if (values.empty())
        return {};
    std::vector<double> cpu, wall;
    for (const auto& value : values)
    {
        cpu.push_back(value.cpu);
        wall.push_back(value.wall);
    }
    const auto [leastCpu, mostCpu] = std::minmax_element(cpu.begin(), cpu.end());
    const auto [leastWall, mostWall] = std::minmax_element(wall.begin(), wall.end());
    return {{median(cpu), median(wall)}, {*leastCpu, *leastWall}, {*mostCpu, *mostWall}};
}

Index cellsWithMaterial(const state::State& state)
{
    const auto& p = state.particles;
    std::vector<Index> cells(static_cast<std::size_t>(p.size()));
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        Index cell = 0;
        for (int a = p.dim - 1; a >= 0; --a)
        {
            const double place = (p.x[std::size_t(a)][i] - state.grid.origin[a]) / state.grid.h;
            cell = cell * state.grid.cells[a] + std::clamp<Index>(Index(place), 0, state.grid.cells[a] - 1);
        }
        cells[i] = cell;
    }
    std::sort(cells.begin(), cells.end());
    return std::unique(cells.begin(), cells.end()) - cells.begin();
}

double columnBytes(const state::State& state)
{
    double bytes = 0;
    auto& particles = const_cast<state::Particles&>(state.particles); // the visitor only looks
    particles.forEachColumn([&](const auto& column) { bytes += double(column.size() * sizeof(column[0])); });
    return bytes;
}

double fallSpeed(const state::State& state, const std::optional<Vector3>& gravity)
{
    double square = 0;
    const auto& p = state.particles;
    for (int a = 0; a < p.dim && gravity && p.size() > 0; ++a)
    {
        const auto& x = p.x[std::size_t(a)];
        const auto [low, high] = std::minmax_element(x.begin(), x.begin() + p.size());
        square += 2 * std::abs((*gravity)[a]) * (*high - *low);
    }
    return std::sqrt(square);
}

namespace
{
/// Columns that not every state has.
template <class Particles>
void enableOptional(const Particles& from, Particles& to)
{
    if constexpr (requires { from.hasX(); })
        if (from.hasX())
            to.enableX();
    if constexpr (requires { from.hasAffine(); })
        if (from.hasAffine())
            to.enableAffine();
    for (const auto& optional : Particles::optionalColumns())
        to.keep(optional.column, from.has(optional.column));
}
} // namespace

state::State firstParticles(const state::State& state, Index count)
{
    state::State part(state.particles.dim);
    part.time = state.time;
    part.step = state.step;
    part.deltaT = state.deltaT;
    part.seedSpacing = state.seedSpacing;
    part.nextId = state.nextId;
    part.grid = state.grid;
    part.materials = state.materials;
    part.provenance = state.provenance;
    auto& from = const_cast<state::Particles&>(state.particles); // the visitor only looks
    auto& to = part.particles;
    enableOptional(from, to);
    to.resize(std::min(count, from.size()));
    std::vector<const void*> columns;
    from.forEachColumn([&](const auto& column) { columns.push_back(column.data()); });
    std::size_t next = 0;
    to.forEachColumn(
        [&](auto& column) { std::memcpy(column.data(), columns[next++], std::size_t(to.size()) * sizeof(column[0])); });
    to.padLastChunk();
    return part;
}

namespace
{
/// All there is to do with so many particles, steps, and seconds a particle-step.
Seconds totalFor(const CostPrediction& p, double particles, double steps, const Seconds& particleStep)
{
    const double growth = particles / double(p.particles);
    Seconds total = p.rehearsal.start;
    total += steps * particles * particleStep;
    total += growth * p.count.rows * (steps / std::max(1.0, p.count.steps)) * p.rehearsal.row;
    total += growth * p.count.states * p.rehearsal.state;
    return total;
}

Seconds leastFor(const CostPrediction& p, double particles)
{
    return totalFor(p, particles, p.count.steps, p.rehearsal.particleStep.median);
}

Seconds mostFor(const CostPrediction& p, double particles)
{
    const auto& r = p.rehearsal;
    Seconds dearest = r.particleStep.median;
    if (r.wideParticleStep)
    {
        dearest.cpu = std::max(dearest.cpu, r.wideParticleStep->median.cpu);
        dearest.wall = std::max(dearest.wall, r.wideParticleStep->median.wall);
    }
    return totalFor(p, particles, std::max(p.count.steps, p.mostSteps.value_or(0)), dearest);
}

Seconds middleFor(const CostPrediction& p, double particles)
{
    Seconds sum = leastFor(p, particles);
    sum += mostFor(p, particles);
    return 0.5 * sum;
}
} // namespace

void describeState(CostPrediction& p, const state::State& state, const std::optional<splitting::Rule>& rule)
{
    p.particles = state.particles.size();
    p.cellsWithMaterial = cellsWithMaterial(state);
    p.particleBytes = columnBytes(state);
    if (!rule)
        return;
    // fourWay, and stretched at its worst, halves every edge.
    const int dim = state.particles.dim;
    double atCap = 0, once = 0;
    for (Index i = 0; i < p.particles; ++i)
    {
        const int left = std::max(0, rule->maxGeneration - int(state.particles.generation[std::size_t(i)]));
        once += left > 0 ? double(1 << dim) : 1;
        atCap += std::exp2(double(dim * left));
    }
    const double most = double(std::max(rule->maxParticles, p.particles));
    p.splitOnce = {std::min(once, most), {}};
    p.splitCap = {std::min(atCap, most), {}};
}

void addUp(CostPrediction& p)
{
    const double particles = double(p.particles);
    p.least = leastFor(p, particles);
    p.most = mostFor(p, particles);
    p.total = middleFor(p, particles);
    p.output = p.count.rows * p.rehearsal.row;
    p.output += p.count.states * p.rehearsal.state;
    p.stepping = p.total - p.rehearsal.start - p.output;
    for (auto* split : {&p.splitOnce, &p.splitCap})
        if (*split)
            (*split)->total = middleFor(p, (*split)->particles);
}

namespace
{
std::string spreadText(const Rehearsal& r)
{
    const auto ns = [](double seconds) { return 1e9 * seconds; };
    const auto& s = r.particleStep;
    std::string text = fmt::format("{:.1f} ns per particle and step ({:.1f} to {:.1f} in {} batches)", ns(s.median.cpu),
                                   ns(s.least.cpu), ns(s.most.cpu), r.batches);
    if (r.wideParticleStep)
        text += fmt::format("; {:.1f} when domains are wider than a cell", ns(r.wideParticleStep->median.cpu));
    return text;
}

/// Both clocks.
std::string secondsText(const Seconds& s)
{
    return fmt::format("{} ({} of processor time)", formatDuration(s.wall), formatDuration(s.cpu));
}

std::string stepsText(const CostPrediction& p)
{
    if (p.count.exact)
        return fmt::format("{} of {:g} s", whole(p.count.steps), p.deltaT);
    std::string text =
        fmt::format("about {}, estimated from the step allowed now, {:.4g} s", whole(p.count.steps), p.deltaT);
    if (p.mostSteps)
        text += fmt::format("; {} at the speed of a fall through the body's height, loosened to twice its volume",
                            whole(*p.mostSteps));
    return text;
}
} // namespace

std::vector<std::pair<std::string, std::string>> predictionLines(const CostPrediction& p, int threads)
{
    const auto& r = p.rehearsal;
    std::vector<std::pair<std::string, std::string>> lines;
    const auto line = [&](const char* what, std::string text) { lines.emplace_back(what, std::move(text)); };
    line("cells", fmt::format("{} hold particles, {:.1f} particles each", p.cellsWithMaterial,
                              double(p.particles) / double(std::max<Index>(1, p.cellsWithMaterial))));
    line("steps", stepsText(p));
    line("memory",
         fmt::format("{} at most; particles {}, the rest is nodes, buffers and the program{}", formatBytes(r.peakBytes),
                     formatBytes(p.particleBytes), p.splitOnce ? "; splitting adds in proportion" : ""));
    const double stays = p.purge > 0 ? std::min(p.purge, p.count.states) : p.count.states;
    const double tables = p.count.rows * r.rowBytes + p.count.steps * r.stepBytes;
    line("on disk", fmt::format("{} states of {}{}, {} rows of history; {} in all", whole(p.count.states),
                                formatBytes(r.stateBytes),
                                stays < p.count.states ? fmt::format(", of which the last {} stay", whole(stays)) : "",
                                whole(p.count.rows), formatBytes(stays * r.stateBytes + tables)));
    if (!r.fault.empty())
        line("rehearsal", "a step cannot be taken: " + r.fault);
    if (r.batches == 0)
        return lines;
    line("speed", spreadText(r));
    if (p.splitOnce)
    {
        line("predicted", fmt::format("{} if no particle splits", secondsText(p.total)));
        line("", fmt::format("{} if each splits once, at the start ({} particles)", secondsText(p.splitOnce->total),
                             whole(p.splitOnce->particles)));
        line("", fmt::format("at most {} particles by maxGeneration and maxParticles: {}", whole(p.splitCap->particles),
                             formatDuration(p.splitCap->total.wall)));
        line("", "which particles will be stretched beyond the threshold only the run can tell");
    }
    else
        line("predicted", secondsText(p.total));
    if (!p.splitOnce && p.most.cpu > tellingShare * p.least.cpu)
        line("", fmt::format("the middle between {}, as the state is now, and {}, {}", formatDuration(p.least.wall),
                             formatDuration(p.most.wall),
                             !p.mostSteps          ? "all domains wider than a cell"
                             : !r.wideParticleStep ? "with the larger number of steps"
                                                   : "with the larger number of steps and wider domains"));
    line("", fmt::format("of it steps {}, tables and states {}, start {}", formatDuration(p.stepping.wall),
                         formatDuration(p.output.wall), formatDuration(r.start.wall)));
    line("rehearsed", fmt::format("{} steps in {}, thrown away", r.steps, formatDuration(r.seconds)));
    if (threads == 1 && p.stepping.wall > busy * p.stepping.cpu)
        line("", "the machine is busy: alone on it, the processor time is what the run takes");
    return lines;
}
} // namespace mpm::cases

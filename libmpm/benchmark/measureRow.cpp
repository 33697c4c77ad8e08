#include "benchmark/measureRow.hpp"

#include "base/alignedVector.hpp"
#include "base/clock.hpp"
#include "benchmark/naiveStepper.hpp"
#include "benchmark/peaks.hpp"
#include "case/makeStepper.hpp"
#include "output/csvSeries.hpp"
#include "stepping/energyBudget.hpp"
#include "stepping/timeStep.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <malloc.h>
#include <omp.h>
#include <unistd.h>

namespace mpm::benchmark
{
namespace
{
constexpr Index sortInterval = 20, budgetInterval = 100;
constexpr double lastTime = 0.75; ///< [s] the collapse slows down after it

double residentBytes()
{
    malloc_trim(0);
    trimAligned();
    double pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * double(sysconf(_SC_PAGESIZE));
}

double columnBytes(state::Particles& particles)
{
    double bytes = 0;
    particles.forEachColumn([&](const auto& column) { bytes += double(column.size() * sizeof(column[0])); });
    return bytes;
}

template <class Body>
double timeOf(const Body& body)
{
    double seconds = 0;
    {
        Clock clock(seconds);
        body();
    }
    return seconds;
}

Timing timingOf(std::vector<double> blocks)
{
    std::sort(blocks.begin(), blocks.end());
    const std::size_t n = blocks.size();
    return {0.5 * (blocks[(n - 1) / 2] + blocks[n / 2]), blocks.front(), blocks.back()};
}

/// A pass, or 0 from a stepper that does not tell it apart.
std::vector<std::pair<std::string, double>> passSeconds(const auto& t)
{
    std::vector<std::pair<std::string, double>> passes;
    if constexpr (requires { t.weights; })
        passes.emplace_back("weights", t.weights);
    passes.emplace_back("to grid", t.toGrid);
    passes.emplace_back("nodal", t.nodal);
    passes.emplace_back("to particles", t.toParticles);
    if constexpr (requires { t.law; })
        passes.emplace_back("law", t.law);
    else
        passes.emplace_back("law", t.constitutive);
    passes.emplace_back("sort", t.sort);
    passes.emplace_back("split", t.split);
    return passes;
}

stepping::Scene sceneOf(const Setting& setting)
{
    auto scene = columnScene(setting.law, setting.stressUpdate);
    scene.picRate = setting.picRate;
    if (setting.splitting)
        scene.splitting = columnSplitting();
    return scene;
}

/// A column on its way through the collapse.
struct Run
{
    Run(ColumnCache& columns, const ColumnSize& size, const Setting& setting)
        : scene(sceneOf(setting)), ignoresMass(cases::limitIgnoresMass(setting.shape)), state(columns.collapsed(size)),
          stepper(cases::makeStepper(setting.shape, state, scene))
    {
        stepping::beginLedger(state, scene.materials);
        steps(sortInterval / 2);
        stepSeconds = timeOf([&] { steps(sortInterval / 2); }) / (sortInterval / 2);
    }

    /// Particles and steps done.
    double steps(Index count)
    {
        double done = 0;
        const double dt = columnDeltaT(*stepper, state, scene, ignoresMass);
        for (Index i = 0; i < count; ++i)
        {
            done += double(state.particles.size());
            stepper->step(dt);
        }
        return done;
    }

    /// What mpmSolve does at a row of history.csv and energyBudget.csv.
    std::size_t writeBudget()
    {
        const auto totals = stepping::totals(state, scene.materials);
        std::string rows;
        for (const auto& row :
             {stepping::historyRow(state, totals, stepper->report()), stepping::budgetRow(state, totals)})
            for (const double value : row)
                rows += output::shortest(value) + ",";
        return rows.size();
    }

    stepping::Scene scene;
    bool ignoresMass;
    state::State state;
    std::unique_ptr<stepping::Stepper> stepper;
    double stepSeconds = 0; ///< of the warm-up
};

/// Steps of a block: about 0.3 s, at most 0.1 s of the collapse, whole sort intervals.
Index blockSteps(const Run& run, bool quick)
{
    const double wanted = (quick ? 0.05 : 0.3) / run.stepSeconds;
    const double most = 0.1 / run.state.deltaT;
    return sortInterval * std::max<Index>(1, Index(std::min(wanted, most) / sortInterval));
}

struct Blocks
{
    Timing timing;
    std::vector<std::pair<std::string, double>> passes; ///< shares
    double yielding = 0;                                ///< share, mean of the ends of the blocks
};

Blocks runBlocks(std::unique_ptr<Run>& run, ColumnCache& columns, const ColumnSize& size, const Setting& setting)
{
    std::vector<double> seconds;
    std::map<std::string, double> spent;
    double total = 0, yielding = 0;
    const int blockCount = setting.quick ? 3 : 5;
    const Index steps = blockSteps(*run, setting.quick);
    for (int block = 0; block < blockCount; ++block)
    {
        if (run->state.time + double(steps) * run->state.deltaT > lastTime)
        {
            run.reset();
            run = std::make_unique<Run>(columns, size, setting);
        }
        const auto before = passSeconds(run->stepper->times());
        double done = 0;
        const double stepping = timeOf([&] { done = run->steps(steps); });
        const double budget = timeOf([&] { run->writeBudget(); });
        const double charged = stepping + budget * double(steps) / double(budgetInterval);
        seconds.push_back(charged / done);
        total += charged;
        yielding += yieldingShare(run->state, run->scene.materials) / blockCount;
        const auto after = passSeconds(run->stepper->times());
        for (std::size_t i = 0; i < after.size(); ++i)
            spent[after[i].first] += after[i].second - before[i].second;
    }
    Blocks blocks{timingOf(std::move(seconds)), {}, yielding};
    double other = total;
    for (const auto& [name, unused] : passSeconds(run->stepper->times()))
    {
        blocks.passes.emplace_back(name, spent[name] / total);
        other -= spent[name];
    }
    blocks.passes.emplace_back("other", other / total);
    return blocks;
}
} // namespace

Row Bench::measure(const Setting& setting)
{
    omp_set_num_threads(setting.threads);
    const bool flat = setting.dimension == 2;
    const ColumnSize size =
        columnSize(setting.dimension, setting.particles, setting.quick ? (flat ? 30 : 12) : (flat ? 119 : 35));
    Row row;
    row.setting = setting;
    row.particles = size.particles();
    row.work = countedWork(setting.dimension, setting.shape, setting.stressUpdate, setting.law);
    row.triad = peaks(setting.threads).triad;
    row.fmaPeak = peaks(setting.threads).fma;
    if (setting.naive && naiveKnows(setting.shape))
        row.naive = naive(setting, size);
    columns_.collapsed({size.dim, size.across, 0}); // in the cache before memory is looked at

    const double before = residentBytes();
    auto run = std::make_unique<Run>(columns_, size, setting);
    const Blocks blocks = runBlocks(run, columns_, size, setting);
    row.residentBytes = (residentBytes() - before) / double(run->state.particles.size());
    row.columnBytes = columnBytes(run->state.particles) / double(run->state.particles.size());
    row.ours = blocks.timing;
    row.passes = blocks.passes;
    row.yielding = blocks.yielding;
    return row;
}

const Bench::Peaks& Bench::peaks(int threads)
{
    const auto found = peaks_.find(threads);
    if (found != peaks_.end())
        return found->second;
    return peaks_[threads] = {triadBytesPerSecond(threads), fmaFlopsPerSecond(threads)};
}

const Timing& Bench::naive(const Setting& setting, const ColumnSize& size)
{
    const auto key = fmt::format("{} {} {} {} {} {} {}", size.dim, size.across, size.refinements, setting.shape,
                                 int(setting.stressUpdate), setting.law, setting.picRate);
    const auto found = naive_.find(key);
    if (found != naive_.end())
        return found->second;
    std::unique_ptr<NaiveStepper> stepper;
    double dt = 0;
    {
        const auto scene = sceneOf(setting);
        state::State state = columns_.collapsed(size);
        const auto ours = cases::makeStepper(setting.shape, state, scene);
        dt = columnDeltaT(*ours, state, scene, cases::limitIgnoresMass(setting.shape));
        ours->step(dt); // the naive step gets its particles sorted once
        stepper = makeNaiveStepper(setting.shape, state, scene);
    }
    const double first = timeOf([&] { stepper->step(dt); });
    const int steps = std::max(3, int((setting.quick ? 0.05 : 0.3) / first));
    std::vector<double> blocks;
    for (int block = 0; block < 3; ++block)
        blocks.push_back(timeOf([&] {
                             for (int i = 0; i < steps; ++i)
                                 stepper->step(dt);
                         }) /
                         (double(stepper->particles()) * steps));
    return naive_[key] = timingOf(std::move(blocks));
}
} // namespace mpm::benchmark

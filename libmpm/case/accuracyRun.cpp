#include "case/accuracyRun.hpp"

#include "base/csvTable.hpp"
#include "base/terminal.hpp"
#include "case/accuracyProcess.hpp"
#include "output/csvSeries.hpp"
#include "output/replaceFile.hpp"
#include "output/stateFile.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <mutex>
#include <thread>

namespace mpm::cases
{
namespace fs = std::filesystem;

namespace
{
constexpr double shortRun = 1; ///< [s] of processor time, below which a process is timed three times
const std::vector<std::string> columns = {"key",         "status",        "reason",     "cpuSeconds",
                                          "wallSeconds", "repeats",       "sideBySide", "particles",
                                          "steps",       "particleSteps", "endTime",    "machine"};

fs::path resultFile(const fs::path& row)
{
    return row / "result.csv";
}

void store(const fs::path& row, const RowResult& r)
{
    CsvTable table(columns);
    table.addRow({r.key, r.status, r.reason, output::shortest(r.cpuSeconds), output::shortest(r.wallSeconds),
                  fmt::format("{}", r.repeats), fmt::format("{}", r.sideBySide), fmt::format("{}", r.particles),
                  fmt::format("{}", r.steps), output::shortest(r.particleSteps), output::shortest(r.endTime),
                  r.machine});
    output::replaceText(resultFile(row), table.text());
}

RowResult load(const fs::path& row)
{
    const auto table = CsvTable::read(resultFile(row));
    if (table.rows().size() != 1)
        return {};
    const auto& cells = table.rows().front();
    const auto text = [&](const char* column) { return cells.cells[table.column(column)]; };
    const auto number = [&](const char* column) { return table.number(cells, table.column(column)); };
    return {.key = text("key"),
            .status = text("status"),
            .reason = text("reason"),
            .cpuSeconds = number("cpuSeconds"),
            .wallSeconds = number("wallSeconds"),
            .repeats = Index(number("repeats")),
            .sideBySide = Index(number("sideBySide")),
            .particles = Index(number("particles")),
            .steps = Index(number("steps")),
            .particleSteps = number("particleSteps"),
            .endTime = number("endTime"),
            .machine = text("machine")};
}

/// What profile.csv says of the steps: processor seconds, and the particles of all steps.
std::pair<double, double> readProfile(const fs::path& row)
{
    const auto table = CsvTable::read(row / "postProcessing/profile.csv");
    const auto pass = table.column("pass"), seconds = table.column("seconds"), ns = table.column("nsPerParticleStep");
    double processor = 0, particleSteps = 0;
    for (const auto& cells : table.rows())
    {
        if (cells.cells[pass] == "processor")
            processor = table.number(cells, seconds);
        if (cells.cells[pass] == "total" && table.number(cells, ns) > 0)
            particleSteps = 1e9 * table.number(cells, seconds) / table.number(cells, ns);
    }
    return {processor, std::round(particleSteps)};
}

void complete(RowResult& result, const fs::path& row)
{
    const CaseDirectory folder(row);
    const auto end = output::readSummary(folder.statePath(folder.latestTime().name));
    result.particles = end.particles;
    result.steps = end.step;
    result.endTime = end.time;
}

/// One row: seeds, runs and times it. Empty status: stopped on the way.
RowResult runRow(const AccuracyCase& base, const MatrixRow& row, const std::string& key, const RunOptions& options)
{
    RowResult result;
    result.key = key;
    result.machine = machineName();
    result.sideBySide = options.sideBySide;
    base.make(row);
    const fs::path folder = base.rowFolder(row);
    const auto run = [&](const std::string& utility, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"-case", folder.string()});
        return runProcess(utilityPath(utility), arguments, folder / ("log." + utility), options.stopped);
    };
    const auto ended = [&](const std::string& utility, const ProcessResult& process) {
        if (process.ended(0))
            return false;
        if (options.stopped && options.stopped())
            return true;
        result.status = process.ended(1) ? "refused" : "failed";
        result.reason = utility + ": " + errorInLog(folder / ("log." + utility));
        if (process.exitCode > 2)
            result.reason += fmt::format(" (exit code {})", process.exitCode);
        return true;
    };
    if (ended("seedParticles", run("seedParticles", {})))
        return result;
    Index wanted = std::max<Index>(options.repeats, 1);
    result.cpuSeconds = std::numeric_limits<double>::infinity();
    for (Index repeat = 0; repeat < wanted; ++repeat)
    {
        const auto process = run("mpmSolve", {"-profile", "-overwrite"});
        if (ended("mpmSolve", process))
        {
            result.cpuSeconds = 0;
            return result;
        }
        const auto [cpu, particleSteps] = readProfile(folder);
        result.particleSteps = particleSteps;
        if (cpu < result.cpuSeconds)
            result.wallSeconds = process.wallSeconds;
        result.cpuSeconds = std::min(result.cpuSeconds, cpu);
        result.repeats = repeat + 1;
        if (options.repeats == 0 && repeat == 0 && process.cpuSeconds < shortRun)
            wanted = 3;
    }
    complete(result, folder);
    result.status = "done";
    return result;
}
} // namespace

std::string machineName()
{
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with("model name") && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "unknown";
}

RowResult storedResult(const AccuracyCase& base, const MatrixRow& row, const std::string& key)
{
    std::error_code none;
    if (!fs::exists(resultFile(base.rowFolder(row)), none))
        return {};
    try
    {
        RowResult result = load(base.rowFolder(row));
        return result.key == key ? result : RowResult{};
    }
    catch (const InputError&) // of another version, or edited: run again
    {
        return {};
    }
}

namespace
{
/// Rows done side by side, and what a person sees of it.
class Work
{
  public:
    Work(const AccuracyCase& base, const std::vector<MatrixRow>& rows, const RunOptions& options)
        : base_(base), rows_(rows), options_(options), results_(rows.size())
    {
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            const auto facts = base.facts(rows[i]);
            const auto key = base.key(rows[i]);
            refused_ += !facts.refused.empty();
            if (!facts.refused.empty())
                results_[i] = {.key = key, .status = "refused", .reason = facts.refused, .machine = {}};
            else if (!options.again)
                results_[i] = storedResult(base, rows[i], key);
            if (results_[i].status.empty())
                todo_.push_back({i, key, facts.work});
            else
                ++known_;
        }
        for (const auto& task : todo_)
            all_ += task.work;
    }

    std::vector<RowResult> run()
    {
        if (known_ > 0)
            fmt::print("  {} of {} rows are known, {} refused\n", known_ - refused_, rows_.size(), refused_);
        if (todo_.empty())
            return std::move(results_);
        progress_ = std::make_unique<Progress>("accuracyCost", 0, all_);
        progress_->inPieces();
        std::vector<std::thread> others;
        for (int i = 1; i < options_.sideBySide; ++i)
            others.emplace_back([this] { workOff(); });
        workOff();
        for (auto& thread : others)
            thread.join();
        progress_->finish();
        if (failure_)
            std::rethrow_exception(failure_);
        return std::move(results_);
    }

  private:
    struct Task
    {
        std::size_t row;
        std::string key;
        double work;
    };

    bool stopped() const { return options_.stopped && options_.stopped(); }

    void workOff()
    {
        for (std::size_t at = next_++; at < todo_.size() && !stopped() && !failed_; at = next_++)
            try
            {
                const Task& task = todo_[at];
                RowResult result = runRow(base_, rows_[task.row], task.key, options_);
                if (!result.status.empty())
                    store(base_.rowFolder(rows_[task.row]), result);
                const std::lock_guard lock(mutex_);
                tell(task, result);
                results_[task.row] = std::move(result);
            }
            catch (...)
            {
                const std::lock_guard lock(mutex_);
                failure_ = std::current_exception();
                failed_ = true;
            }
    }

    void tell(const Task& task, const RowResult& result)
    {
        if (result.status.empty())
            return;
        done_ += task.work;
        ++finished_;
        progress_->note(fmt::format("  {:>4}/{} {:<50} {}", finished_ + known_, rows_.size(), rows_[task.row].name,
                                    result.done() ? fmt::format("{:.3g} s, {} particles, {} steps", result.cpuSeconds,
                                                                result.particles, result.steps)
                                                  : result.status + ": " + result.reason));
        progress_->update(done_, fmt::format("{} of {} rows", finished_ + known_, rows_.size()));
    }

    const AccuracyCase& base_;
    const std::vector<MatrixRow>& rows_;
    const RunOptions& options_;
    std::vector<RowResult> results_;
    std::vector<Task> todo_;
    std::unique_ptr<Progress> progress_;
    std::mutex mutex_;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<bool> failed_ = false;
    std::exception_ptr failure_;
    std::size_t known_ = 0, refused_ = 0, finished_ = 0;
    double all_ = 0, done_ = 0;
};
} // namespace

std::vector<RowResult> runRows(const AccuracyCase& base, const std::vector<MatrixRow>& rows, const RunOptions& options)
{
    return Work(base, rows, options).run();
}
} // namespace mpm::cases

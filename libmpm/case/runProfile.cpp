#include "case/runProfile.hpp"

#include "base/processorClock.hpp"
#include "base/terminal.hpp"
#include "output/csvSeries.hpp"
#include "output/replaceFile.hpp"

#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
double sum(const stepping::PassTimes& p)
{
    return p.weights + p.toGrid + p.nodal + p.toParticles + p.law + p.sort + p.split;
}
} // namespace

void RunProfile::beginSteps(const stepping::PassTimes& passes)
{
    start_ = elapsed() - timeStep - monitor - history - output -
             sum(passes); // the stability limit may have run passes already
    processorStart_ = processorNow() - apartProcessor;
}

double RunProfile::processor() const
{
    return processorNow() - processorStart_ - apartProcessor;
}

double RunProfile::elapsed() const
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

std::vector<RunProfile::Row> RunProfile::rows(const stepping::PassTimes& p) const
{
    std::vector<Row> rows{{"start", start_},
                          {"weights", p.weights},
                          {"toGrid", p.toGrid},
                          {"nodal", p.nodal},
                          {"toParticles", p.toParticles},
                          {"law", p.law},
                          {"sort", p.sort},
                          {"split", p.split},
                          {"timeStep", timeStep},
                          {"monitor", monitor},
                          {"history", history},
                          {"output", output}};
    const double total = elapsed();
    double other = total;
    for (const Row& row : rows)
        other -= row.seconds;
    rows.push_back({"other", other});
    rows.push_back({"total", total});
    rows.push_back({"processor", processor()});
    return rows;
}

std::string RunProfile::text(const stepping::PassTimes& passes, int indent) const
{
    Table table({"pass", "seconds", "share [%]", "ns per particle and step"});
    const auto all = rows(passes);
    const double total = all[all.size() - 2].seconds;
    for (const Row& row : all)
        if (row.seconds != 0)
            table.row({row.pass, fmt::format("{:.3f}", row.seconds), fmt::format("{:.2f}", 100 * row.seconds / total),
                       fmt::format("{:.1f}", nsPerParticleStep(row.seconds))});
    return table.text(indent);
}

void RunProfile::write(const std::filesystem::path& file, const stepping::PassTimes& passes) const
{
    const auto all = rows(passes);
    const double total = all[all.size() - 2].seconds;
    std::string text = "pass,seconds,share,nsPerParticleStep\n";
    for (const Row& row : all)
        text += fmt::format("{},{},{},{}\n", row.pass, output::shortest(row.seconds),
                            output::shortest(row.seconds / total), output::shortest(nsPerParticleStep(row.seconds)));
    output::makeFolder(file.parent_path());
    output::replaceText(file, text);
}
} // namespace mpm::cases

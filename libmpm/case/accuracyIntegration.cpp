#include "case/accuracyIntegration.hpp"

#include "case/accuracyCase.hpp"
#include "case/makeStepper.hpp"
#include "output/stateFile.hpp"

#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace mpm::cases
{
namespace
{
constexpr double tolerance = 1e-11;

/// Hash of the start, shape and end: what the solution depends on besides the dictionaries all rows share.
std::string keyOf(const std::filesystem::path& start, const std::string& shape, double window)
{
    std::ifstream in(start, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    return textHash(bytes) + shape + fmt::format(" {:.17g}", window);
}
} // namespace

const RowIntegration::End& RowIntegration::end(const CaseDirectory& run)
{
    const auto startFile = run.statePath(run.firstTime().name);
    auto start = output::readState(startFile);
    const double window = output::readSummary(run.statePath(run.latestTime().name)).time - start.time;
    const auto scene = readScene(run, start);
    const auto key = keyOf(startFile, scene.shape, window);
    if (const auto found = known_.find(key); found != known_.end())
        return found->second;
    auto rungeKutta = scene.scene; // the transfer of the row is no part of the equations
    rungeKutta.transfer = stepping::Transfer::FLIP;
    rungeKutta.picRate = 0;
    const auto equations = makeSemiDiscrete(scene.shape, start, rungeKutta);
    const auto model = stepping::semiDiscreteModel(rungeKutta);
    const auto carried = [&](double wanted) {
        equations->arrange(start);
        const auto y = solver_(*equations, start, model, window, wanted);
        auto state = start;
        equations->unpack(y.data(), state);
        state.time = start.time + window;
        return state;
    };
    return known_.emplace(key, End{carried(tolerance), carried(100 * tolerance)}).first->second;
}
} // namespace mpm::cases

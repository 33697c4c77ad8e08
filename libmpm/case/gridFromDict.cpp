#include "case/gridFromDict.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::cases
{
namespace
{
using dictionary::Bound;
namespace unit = dictionary::unit;

constexpr double wholeCells = 1e-6; ///< [cells]
constexpr double mostCells = 1e7;   ///< an axis; beyond it is a slip of the pen
constexpr double mostNodes = 1e12;  ///< what a state file holds and sort keys can count

std::string text(const Vector3& v)
{
    return fmt::format("({:.10g} {:.10g} {:.10g})", v[0], v[1], v[2]);
}

std::array<bool, 3> readPeriodic(const dictionary::Dictionary& dict, int dim)
{
    std::array<bool, 3> periodic{};
    if (!dict.found("periodic"))
        return periodic;
    for (const auto& axis : dict.get<std::vector<std::string>>({"periodic", "axes whose two sides are one"}))
    {
        const auto at = std::find(axisNames.begin(), axisNames.begin() + dim, axis) - axisNames.begin();
        if (at == dim)
            dict.fail("periodic", axis, dim == 2 ? "a list of x and y" : "a list of x, y and z");
        periodic[std::size_t(at)] = true;
    }
    return periodic;
}
} // namespace

state::GridBox gridFromDict(const dictionary::Dictionary& dict)
{
    state::GridBox grid;
    const Index dim = dict.get<Index>({"dimension", "2: plane strain, 3", unit::none, Bound::between(2, 3)});
    const auto low = dict.get<Vector3>({"min", "lower corner of the grid", unit::length});
    const auto high = dict.get<Vector3>({"max", "upper corner of the grid", unit::length});
    const double h = dict.get<double>({"cellSize", "side of a cell", unit::length, Bound::positive()});
    grid.dim = int(dim);
    grid.origin = low;
    grid.cells = {1, 1, 1};
    if (dim == 2 && (low[2] != 0 || high[2] != 0))
        dict.fail(low[2] != 0 ? "min" : "max", text(low[2] != 0 ? low : high), "z = 0 in 2D");

    Vector3 fitting = high;
    bool fits = true;
    for (std::size_t k = 0; k < std::size_t(dim); ++k)
    {
        const double cells = (high[k] - low[k]) / h;
        if (!(cells > 0) || !(cells < mostCells))
            dict.fail("max", text(high),
                      fmt::format("{} > {:.10g} of min, fewer than {:g} cells of {:.10g} away", axisNames[k], low[k],
                                  mostCells, h));
        grid.cells[k] = std::max<Index>(1, std::llround(cells));
        fits = fits && std::abs(cells - double(grid.cells[k])) <= wholeCells;
        fitting[k] = low[k] + double(grid.cells[k]) * h;
    }
    if (!fits)
        dict.fail("max", text(high),
                  fmt::format("a whole number of cells of cellSize {:.10g} from min {}; the nearest is {}", h,
                              text(low), text(fitting)));
    double nodes = 1;
    for (std::size_t k = 0; k < std::size_t(dim); ++k)
        nodes *= double(grid.cells[k] + 1);
    if (nodes > mostNodes)
        dict.fail("cellSize", fmt::format("{:.10g}, which makes {:.2g} nodes", h, nodes),
                  fmt::format("at most {:g} nodes in all", mostNodes));
    grid.h = (high[0] - low[0]) / double(grid.cells[0]);
    grid.periodic = readPeriodic(dict, grid.dim);
    return grid;
}
} // namespace mpm::cases

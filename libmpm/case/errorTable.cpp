#include "case/errorTable.hpp"

#include "base/csvTable.hpp"
#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mpm::cases
{
namespace
{
constexpr double sameCourant = 0.02, sameLength = 1e-6; ///< relative

bool close(double a, double b, double tolerance)
{
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

bool sameNumber(const std::string& a, const std::string& b)
{
    const auto x = parseNumber(a), y = parseNumber(b);
    return a == b || (x && y && close(*x, *y, 1e-9));
}

/// The cells of one line, by name.
class Cells
{
  public:
    Cells(const CsvTable& table, const CsvTable::Row& row) : table_(table), row_(row) {}
    std::string text(const std::string& column) const { return row_.cells[table_.column(column)]; }
    double number(const std::string& column) const { return table_.number(row_, table_.column(column)); }
    double number(const std::string& column, double empty) const
    {
        return text(column).empty() ? empty : number(column);
    }
    double positive(const std::string& column) const
    {
        const double value = number(column);
        if (!(value > 0))
            table_.fail(row_, table_.column(column), "a number > 0");
        return value;
    }
    [[noreturn]] void fail(const std::string& column, const std::string& allowed) const
    {
        table_.fail(row_, table_.column(column), allowed);
    }

  private:
    const CsvTable& table_;
    const CsvTable::Row& row_;
};

AccuracyRow rowOf(const Cells& cells)
{
    AccuracyRow row;
    row.name = cells.text("row");
    auto& s = row.setting;
    s.cellSize = cells.positive("cellSize");
    s.particlesPerCell = std::lround(cells.positive("particlesPerCell"));
    s.shape = cells.text("shape");
    s.transfer = cells.text("transfer");
    s.order = cells.text("order");
    s.picRate = cells.text("picRate");
    s.stressUpdate = cells.text("stressUpdate");
    s.staggeredStart = cells.text("staggeredStart");
    s.timeIntegration = cells.text("timeIntegration");
    const std::string splitting = cells.text("splitting");
    if (splitting != "on" && splitting != "off")
        cells.fail("splitting", "on or off");
    s.splitting = splitting == "on";
    s.courant = cells.positive("courant");
    s.deltaT = cells.positive("deltaT");
    row.error = cells.number("error");
    if (row.error < 0)
        cells.fail("error", "a number >= 0");
    row.referenceError = cells.number("referenceError", 0);
    row.cpuSeconds = cells.positive("cpuSeconds");
    row.particleSteps = cells.positive("particleSteps");
    row.nsPerParticleStep = cells.positive("nsPerParticleStep");
    row.endTime = cells.number("endTime");
    row.machine = cells.text("machine");
    row.version = cells.text("version");
    return row;
}

/// How unlike two settings are: a word more than any number.
double unlikeness(const RunSetting& a, const RunSetting& b)
{
    const auto ratio = [](double x, double y) { return x > 0 && y > 0 ? std::abs(std::log(x / y)) : 0; };
    double sum = 0;
    sum += 100 * (a.shape != b.shape);
    sum += 50 * (a.transfer != b.transfer) + 20 * !sameNumber(a.order, b.order);
    sum += 50 * (a.stressUpdate != b.stressUpdate) + 50 * (a.timeIntegration != b.timeIntegration);
    sum += 20 * (a.splitting != b.splitting) + 10 * (a.staggeredStart != b.staggeredStart);
    sum += 20 * !sameNumber(a.picRate, b.picRate);
    sum += 4 * ratio(a.cellSize, b.cellSize) + 4 * ratio(double(a.particlesPerCell), double(b.particlesPerCell));
    return sum + ratio(a.courant, b.courant);
}

struct Fit
{
    double order = 0, constant = 0; ///< log error = constant + order log cellSize
};

Fit fitOf(const std::vector<const AccuracyRow*>& rows)
{
    double x = 0, y = 0, xx = 0, xy = 0;
    const double n = double(rows.size());
    for (const auto* row : rows)
    {
        const double h = std::log(row->setting.cellSize), e = std::log(row->error);
        x += h / n;
        y += e / n;
    }
    for (const auto* row : rows)
    {
        const double h = std::log(row->setting.cellSize) - x;
        xx += h * h;
        xy += h * (std::log(row->error) - y);
    }
    const double order = xy / xx;
    return {order, y - order * x};
}
} // namespace

bool RunSetting::sameMethod(const RunSetting& o) const
{
    return shape == o.shape && transfer == o.transfer && sameNumber(order, o.order) && sameNumber(picRate, o.picRate) &&
           stressUpdate == o.stressUpdate && staggeredStart == o.staggeredStart &&
           timeIntegration == o.timeIntegration && splitting == o.splitting;
}

bool RunSetting::sameSeeding(const RunSetting& o) const
{
    return close(cellSize, o.cellSize, sameLength) && particlesPerCell == o.particlesPerCell;
}

std::string RunSetting::describe() const
{
    std::string text = shape + ", " + transfer;
    if (!order.empty())
        text += " of order " + order;
    if (const auto rate = parseNumber(picRate); rate && *rate > 0)
        text += " with picRate " + picRate;
    text += ", " + stressUpdate;
    if (timeIntegration != "symplecticEuler")
        text += ", " + timeIntegration;
    if (staggeredStart == "yes")
        text += ", staggered start";
    if (splitting)
        text += ", splitting";
    return text +
           fmt::format(", cells of {:g} m, {} particles per cell and axis, deltaT {:g} s (Courant number {:.3g})",
                       cellSize, particlesPerCell, deltaT, courant);
}

ErrorTable::ErrorTable(const std::filesystem::path& file, const std::string& measure) : file_(file)
{
    if (!std::filesystem::exists(file))
        throw InputError({file.string()},
                         "found no such table; run accuracyCost in this case first (system/accuracyCostDict)");
    const auto table = CsvTable::read(file);
    for (const auto* column : {"row", "cellSize", "shape", "errorMeasure", "error", "cpuSeconds"})
        table.column(column); // told even where no row asks
    std::vector<std::string> measures;
    for (const auto& line : table.rows())
    {
        const Cells cells(table, line);
        const auto of = cells.text("errorMeasure");
        if (!of.empty() && std::find(measures.begin(), measures.end(), of) == measures.end())
            measures.push_back(of);
    }
    measure_ = !measure.empty() || measures.empty() ? measure : measures.front();
    if (!measure.empty() && std::find(measures.begin(), measures.end(), measure) == measures.end())
    {
        const auto near = nearestWord(measure, measures);
        throw InputError(fmt::format("-errorMeasure: found '{}', allowed {} ({}){}", measure, joinWords(measures),
                                     file.string(), near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
    for (const auto& line : table.rows())
    {
        const Cells cells(table, line);
        if (cells.text("errorMeasure") == measure_ && cells.text("status") == "done" && !cells.text("error").empty())
            rows_.push_back(rowOf(cells));
    }
}

const AccuracyRow* ErrorTable::nearest(const RunSetting& setting) const
{
    const AccuracyRow* best = nullptr;
    for (const auto& row : rows_)
        if (!best || unlikeness(row.setting, setting) < unlikeness(best->setting, setting))
            best = &row;
    return best;
}

std::optional<ExpectedError> ErrorTable::expect(const RunSetting& setting) const
{
    const AccuracyRow* near = nearest(setting);
    if (!near)
        return std::nullopt;
    const auto& s = near->setting;
    if (s.sameMethod(setting) && s.sameSeeding(setting) && close(s.courant, setting.courant, sameCourant))
        return ExpectedError{near->bound(), std::nullopt, "measured with this setting, row " + near->name};
    // One row a cell size: that of the nearest Courant number.
    std::map<double, const AccuracyRow*> byCell;
    const auto distance = [&](const AccuracyRow& row) {
        return std::abs(std::log(row.setting.courant / setting.courant));
    };
    for (const auto& row : rows_)
        if (row.setting.sameMethod(setting) && row.setting.particlesPerCell == setting.particlesPerCell &&
            row.error > 2 * row.referenceError && row.error > 0)
            if (auto& place = byCell[row.setting.cellSize]; !place || distance(row) < distance(*place))
                place = &row;
    std::vector<const AccuracyRow*> rows;
    for (const auto& [h, row] : byCell)
        rows.push_back(row);
    if (rows.size() >= 2)
    {
        const Fit fit = fitOf(rows);
        const double least = rows.front()->setting.cellSize, most = rows.back()->setting.cellSize;
        const bool inside = setting.cellSize >= least * (1 - sameLength) && setting.cellSize <= most * (1 + sameLength);
        return ExpectedError{std::exp(fit.constant + fit.order * std::log(setting.cellSize)), fit.order,
                             fmt::format("{} with order {:.2g} from {} cell sizes between {:g} and {:g} m",
                                         inside ? "interpolated" : "extrapolated", fit.order, rows.size(), least,
                                         most)};
    }
    return ExpectedError{
        near->bound(), std::nullopt,
        fmt::format("{}; the row most like it is {}: {}",
                    s.sameMethod(setting) ? "too few rows of this method for an order" : "no row has this method",
                    near->name, s.describe())};
}
} // namespace mpm::cases

#include "dictionary/timeFunction.hpp"

#include "base/csvTable.hpp"
#include "dictionary/timeIntegrals.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mpm::dictionary
{
namespace
{
class Constant3 : public TimeFunction::Source
{
  public:
    explicit Constant3(const Vector3& value) : f(value) {}
    Vector3 value(double) const override { return f; }
    Vector3 derivative(double) const override { return {}; }
    Integrals over(double, double dt) const override
    {
        Integrals out;
        for (std::size_t a = 0; a < 3; ++a)
        {
            out.once[a] = f[a] * dt;
            out.twice[a] = 0.5 * f[a] * dt * dt;
        }
        return out;
    }
    Integrals from0(double t) const override { return over(0, t); }
    const Vector3* constant() const override { return &f; }
    bool fixed(std::size_t a, double& number) const override
    {
        number = f[a];
        return true;
    }

  private:
    Vector3 f;
};

/// Straight lines between rows.
class Table : public TimeFunction::Source
{
  public:
    Table(std::vector<double> times, std::vector<Vector3> values, TimeFunction::Beyond beyond)
        : times_(std::move(times)), values_(std::move(values)), zero_(beyond == TimeFunction::Beyond::zero)
    {
        sums_.resize(times_.size());
        for (std::size_t k = 0; k + 1 < times_.size(); ++k)
        {
            const auto piece = over(times_[k], times_[k + 1] - times_[k]);
            for (std::size_t a = 0; a < 3; ++a)
            {
                sums_[k + 1].once[a] = sums_[k].once[a] + piece.once[a];
                sums_[k + 1].twice[a] =
                    sums_[k].twice[a] + sums_[k].once[a] * (times_[k + 1] - times_[k]) + piece.twice[a];
            }
        }
        start_ = sinceFirst(0);
    }

    Vector3 value(double t) const override
    {
        const auto p = piece(t);
        Vector3 out = p.value;
        for (std::size_t a = 0; a < 3; ++a)
            out[a] += p.slope[a] * (t - p.begin);
        return out;
    }
    Vector3 derivative(double t) const override { return piece(t).slope; }

    /// Sum over the pieces the interval meets, each a parabola and a cubic.
    Integrals over(double t, double dt) const override
    {
        const double end = t + dt;
        Integrals out;
        for (double s = t; s < end;)
        {
            const auto p = piece(s);
            const double to = std::min(end, p.end), d = to - s;
            const bool over = zero_ && s >= times_.back();
            for (std::size_t a = 0; a < 3; ++a)
            {
                const double f = over ? 0 : p.value[a] + p.slope[a] * (s - p.begin);
                out.twice[a] += out.once[a] * d + d * d * (f / 2 + p.slope[a] * d / 6);
                out.once[a] += d * (f + p.slope[a] * d / 2);
            }
            s = to;
        }
        return out;
    }
    Integrals from0(double t) const override
    {
        auto out = sinceFirst(t);
        for (std::size_t a = 0; a < 3; ++a)
        {
            out.twice[a] -= start_.twice[a] + start_.once[a] * t;
            out.once[a] -= start_.once[a];
        }
        return out;
    }

    bool fixed(std::size_t a, double& number) const override
    {
        number = values_.front()[a];
        return (!zero_ || number == 0) &&
               std::all_of(values_.begin(), values_.end(), [&](const Vector3& v) { return v[a] == number; });
    }

  private:
    struct Piece
    {
        double begin, end;
        Vector3 value, slope; ///< at `begin`
    };
    Piece piece(double t) const
    {
        constexpr double ever = std::numeric_limits<double>::infinity();
        if (t < times_.front())
            return {times_.front(), times_.front(), zero_ ? Vector3{} : values_.front(), {}};
        if (t >= times_.back())
            return {times_.back(), ever, zero_ && t > times_.back() ? Vector3{} : values_.back(), {}};
        const auto k = std::size_t(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin()) - 1;
        Piece out{times_[k], times_[k + 1], values_[k], {}};
        for (std::size_t a = 0; a < 3; ++a)
            out.slope[a] = (values_[k + 1][a] - values_[k][a]) / (times_[k + 1] - times_[k]);
        return out;
    }
    /// Integrals from the first time on.
    Integrals sinceFirst(double t) const
    {
        if (t <= times_.front())
        {
            Integrals out;
            const double d = t - times_.front();
            for (std::size_t a = 0; a < 3 && !zero_; ++a)
            {
                out.once[a] = values_.front()[a] * d;
                out.twice[a] = values_.front()[a] * d * d / 2;
            }
            return out;
        }
        const auto k =
            std::min(std::size_t(std::upper_bound(times_.begin(), times_.end(), t) - times_.begin()), times_.size()) -
            1;
        const double d = t - times_[k];
        auto out = sums_[k];
        const auto rest = over(times_[k], d);
        for (std::size_t a = 0; a < 3; ++a)
        {
            out.twice[a] += out.once[a] * d + rest.twice[a];
            out.once[a] += rest.once[a];
        }
        return out;
    }

    std::vector<double> times_;
    std::vector<Vector3> values_;
    bool zero_;
    std::vector<Integrals> sums_; ///< from the first time to each
    Integrals start_;             ///< from the first time to 0
};

/// Columns of a CSV file as rows of a table.
std::vector<TableRow> readCsv(const Dictionary& d, int components, double& scale, std::optional<Vector3>& direction)
{
    const auto path = d.file("file", "times and values, a CSV file of the case with a header line");
    scale = d.get<double>({"scale", "factor of the values", unit::none, {}, 1.0});
    if (components > 1 && d.found("direction"))
        direction = d.get<Vector3>({"direction", "of the values, where they are one column"});
    const auto table = CsvTable::read(path);
    const std::size_t columns = table.columns().size();
    if (columns < 2 || columns > (components == 1 ? 2u : 4u))
        d.fail("file", fmt::format("{} columns in {}", columns, path.string()),
               components == 1 ? "2: times and values" : "2 to 4: times, then one, two or three columns of values");
    if (components > 1 && (columns == 2) != direction.has_value())
        d.fail(columns == 2 ? "file" : "direction",
               columns == 2 ? fmt::format("one column of values in {}", path.string())
                            : fmt::format("a direction, and {} columns of values in {}", columns - 1, path.string()),
               columns == 2 ? "direction (1 0 0); beside it, or two or three columns of values" : "one of them");
    std::vector<TableRow> rows;
    for (const auto& row : table.rows())
    {
        TableRow out{table.number(row, 0), {}, {path.string(), row.line}};
        for (std::size_t c = 1; c < columns; ++c)
            out.values.push_back(table.number(row, c));
        rows.push_back(std::move(out));
    }
    return rows;
}

TimeFunction fromRows(const Dictionary& d, const std::string& word, const std::vector<TableRow>& rows, int dim,
                      int components, TimeFunction::Beyond beyond, double scale,
                      const std::optional<Vector3>& direction)
{
    std::vector<double> times;
    std::vector<Vector3> values;
    if (rows.empty())
        d.fail(word, "a table without rows", "one row or more");
    for (const auto& row : rows)
    {
        const auto fail = [&](const std::string& found, const std::string& allowed) {
            throw InputError(row.where, fmt::format("{}: found {}, allowed {}", word, found, allowed));
        };
        if (!times.empty() && !(row.at > times.back()))
            fail(fmt::format("time {:g} after {:g}", row.at, times.back()), "times that rise");
        const std::size_t n = row.values.size();
        if (components == 1 ? n != 1 : direction ? n != 1 : n != 3 && !(dim == 2 && n == 2))
            fail(fmt::format("{} values at time {:g}", n, row.at), components == 1 ? "one"
                                                                   : dim == 2      ? "2 or 3, (x y 0)"
                                                                                   : "3, (x y z)");
        Vector3 value{};
        for (std::size_t a = 0; a < 3; ++a)
            value[a] = scale * (direction ? (*direction)[a] * row.values[0] : a < n ? row.values[a] : 0.0);
        if (dim == 2 && components > 1 && value[2] != 0)
            fail(fmt::format("a z component of {:g}", value[2]), "0 in 2D");
        times.push_back(row.at);
        values.push_back(value);
    }
    return TimeFunction(std::move(times), std::move(values), beyond);
}
} // namespace

TimeFunction::TimeFunction(std::shared_ptr<const Source> source, std::string text)
    : source_(std::move(source)), text_(std::move(text))
{}

TimeFunction::TimeFunction(const Vector3& value)
    : TimeFunction(std::make_shared<Constant3>(value), fmt::format("({:g} {:g} {:g})", value[0], value[1], value[2]))
{}

TimeFunction::TimeFunction(const VectorExpression& formulas, const std::string& word)
    : TimeFunction(makeFormulaSource(formulas, word),
                   fmt::format("({} {} {})", formulas[0].text(), formulas[1].text(), formulas[2].text()))
{
    if (formulas[0].number() && formulas[1].number() && formulas[2].number())
        source_ =
            std::make_shared<Constant3>(Vector3{*formulas[0].number(), *formulas[1].number(), *formulas[2].number()});
}

TimeFunction::TimeFunction(std::vector<double> times, std::vector<Vector3> values, Beyond beyond)
    : text_(fmt::format("a table of {} times", times.size()))
{
    source_ = std::make_shared<Table>(std::move(times), std::move(values), beyond);
}

TimeFunction TimeFunction::read(const Dictionary& d, const std::string& word, const std::string& help,
                                const Dimensions& dimensions, int dim, Beyond beyond, int components)
{
    std::optional<Vector3> direction;
    if (d.holdsDict(word))
    {
        const Dictionary& own = d.subDict(word, help);
        double scale = 1;
        const auto rows = readCsv(own, components, scale, direction);
        return fromRows(own, "file", rows, dim, components, beyond, scale, direction);
    }
    if (d.holdsTable(word))
        return fromRows(d, word, d.get<std::vector<TableRow>>({word, help, dimensions}), dim, components, beyond, 1,
                        direction);
    const std::vector<std::string> variables = {"t"};
    const auto constants = readConstants(d, variables);
    VectorExpression formulas;
    if (components == 1)
        formulas[0] = Expression(d.get<FormulaText>({word, help, dimensions}), word, variables, constants);
    else
        formulas = readVectorExpression(d, word, help, dimensions, dim, variables, constants, true);
    for (const auto& formula : formulas)
        if (!std::isfinite(formula.evaluate({0.0})))
            throw InputError(formula.where(),
                             fmt::format("{}: found \"{}\", which is not finite at t = 0", word, formula.text()));
    return TimeFunction(formulas, word);
}

Vector3 TimeFunction::value(double t) const
{
    return source_->value(t);
}

Vector3 TimeFunction::derivative(double t) const
{
    return source_->derivative(t);
}

TimeFunction::Integrals TimeFunction::integrals(double t) const
{
    return source_->from0(t);
}

TimeFunction::Integrals TimeFunction::integrals(double t, double dt) const
{
    return source_->over(t, dt);
}

const Vector3* TimeFunction::constant() const
{
    return source_->constant();
}

std::optional<double> TimeFunction::number(std::size_t component) const
{
    double out = 0;
    return source_->fixed(component, out) ? std::optional(out) : std::nullopt;
}

double TimeFunction::magnitude(double t, double dt) const
{
    double most = 0;
    for (const double s : {t, t + 0.5 * dt, t + dt})
    {
        const Vector3 f = value(s);
        most = std::max(most, std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]));
    }
    return most;
}
} // namespace mpm::dictionary

#include "output/csvSeries.hpp"

#include "base/error.hpp"
#include "output/replaceFile.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace mpm::output
{
namespace
{
std::string headerLine(const std::vector<std::string>& columns)
{
    std::string line;
    for (const auto& column : columns)
    {
        if (!line.empty())
            line += ',';
        line += column;
    }
    return line;
}
} // namespace

std::string shortest(double value)
{
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

CsvSeries::CsvSeries(const std::filesystem::path& file, std::vector<std::string> columns,
                     std::optional<double> continueAt, std::size_t timeColumn)
    : file_(file), columns_(std::move(columns)), timeColumn_(timeColumn)
{
    if (!file_.parent_path().empty())
        makeFolder(file_.parent_path());
    const std::string rows = continueAt && std::filesystem::exists(file_) ? keptRows(*continueAt) : "";
    replaceText(file_, headerLine(columns_) + "\n" + rows);
    stream_.open(file_, std::ios::app);
    if (!stream_)
        throw InputError({file_.string()}, "cannot be written");
}

CsvSeries CsvSeries::rehearsal(const std::filesystem::path& file, std::vector<std::string> columns,
                               std::size_t timeColumn)
{
    CsvSeries series;
    series.file_ = file;
    series.columns_ = std::move(columns);
    series.timeColumn_ = timeColumn;
    series.stream_.open(file, std::ios::app);
    if (!series.stream_)
        throw InputError({file.string()}, "cannot be written");
    return series;
}

std::string CsvSeries::keptRows(double until)
{
    std::ifstream stream(file_);
    std::string line, rows;
    if (!std::getline(stream, line))
        return rows;
    if (line != headerLine(columns_))
        throw InputError({file_.string(), 1}, fmt::format("other columns than this run writes: found \"{}\", expected "
                                                          "\"{}\"; move the file away or start anew",
                                                          line, headerLine(columns_)));
    const double limit = until + 1e-10 * std::abs(until);
    for (int number = 2; std::getline(stream, line); ++number)
    {
        if (stream.eof())
            break; // no newline: the run was killed while writing this row
        double time = 0;
        std::size_t begin = 0;
        for (std::size_t column = 0; column < timeColumn_ && begin < line.size(); ++column)
            begin = std::min(line.find(',', begin), line.size() - 1) + 1;
        const auto [end, error] = std::from_chars(line.data() + begin, line.data() + line.size(), time);
        const auto commas = std::count(line.begin(), line.end(), ',');
        if (error != std::errc() || std::size_t(commas) + 1 != columns_.size() ||
            (end != line.data() + line.size() && *end != ','))
            throw InputError({file_.string(), number},
                             fmt::format("found \"{}\", {} numbers with commas expected", line, columns_.size()));
        if (time > limit)
            continue;
        rows += line + "\n";
        lastTime_ = time;
    }
    return rows;
}

void CsvSeries::write(std::span<const double> row)
{
    if (row.size() != columns_.size())
        throw InputError({file_.string()},
                         fmt::format("a row of {} values for {} columns", row.size(), columns_.size()));
    std::string line;
    for (double value : row)
    {
        if (!line.empty())
            line += ',';
        line += shortest(value);
    }
    stream_ << line << '\n' << std::flush;
    if (!stream_)
        throw InputError({file_.string()}, "a row cannot be written (disk full?)");
    lastTime_ = row[timeColumn_];
}

void CsvSeries::synchronise() const
{
    synchroniseFile(file_);
}
} // namespace mpm::output

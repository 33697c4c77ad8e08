#include "base/csvTable.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace mpm
{
namespace
{
/// Cuts text into rows of cells. Quoted cells may hold commas, doubled quotes and line ends.
std::vector<CsvTable::Row> cut(const std::string& file, const std::string& text)
{
    std::vector<CsvTable::Row> rows;
    std::size_t at = 0;
    int line = 1;
    while (at < text.size())
    {
        CsvTable::Row row{line, {}};
        const bool comment = text[at] == '#';
        for (bool more = true; more;)
        {
            std::string cell;
            const bool quoted = !comment && at < text.size() && text[at] == '"';
            if (quoted)
            {
                for (++at;; ++at)
                {
                    if (at >= text.size())
                        throw InputError({file, row.line}, "found a quote that never closes, allowed is \"text\"");
                    if (text[at] == '"' && at + 1 < text.size() && text[at + 1] == '"')
                        ++at;
                    else if (text[at] == '"')
                        break;
                    line += text[at] == '\n';
                    cell += text[at];
                }
                ++at;
            }
            while (at < text.size() && text[at] != ',' && text[at] != '\n')
                cell += text[at++];
            if (!cell.empty() && cell.back() == '\r')
                cell.pop_back();
            row.cells.push_back(cell);
            more = at < text.size() && text[at] == ',';
            line += at < text.size() && text[at] == '\n';
            ++at;
        }
        if (!comment && !(row.cells.size() == 1 && row.cells[0].empty()))
            rows.push_back(std::move(row));
    }
    return rows;
}

std::string trimmed(const std::string& s)
{
    const auto first = s.find_first_not_of(" \t");
    return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(" \t") - first + 1);
}

std::string joinCells(const std::vector<std::string>& cells)
{
    std::string out;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
        std::string cell = cells[i];
        if (cell.find_first_of(",\"\n\r") != std::string::npos)
        {
            for (std::size_t q = 0; (q = cell.find('"', q)) != std::string::npos; q += 2)
                cell.insert(q, 1, '"');
            cell = '"' + cell + '"';
        }
        out += (i ? "," : "") + cell;
    }
    return out + "\n";
}
} // namespace

CsvTable::CsvTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

CsvTable CsvTable::read(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file))
        throw InputError({file.string(), 0}, "found no readable file, allowed is a table of comma-separated values");
    std::stringstream text;
    text << in.rdbuf();

    CsvTable table;
    table.file_ = file.string();
    auto rows = cut(table.file_, text.str());
    if (rows.empty())
        throw InputError({table.file_, 0}, "found an empty table, allowed is a header line and rows");
    for (const auto& name : rows.front().cells)
    {
        if (table.find(trimmed(name)))
            throw InputError({table.file_, rows.front().line},
                             fmt::format("found column {} twice, allowed is once", trimmed(name)));
        table.columns_.push_back(trimmed(name));
    }
    table.rows_.assign(std::make_move_iterator(rows.begin() + 1), std::make_move_iterator(rows.end()));
    for (const auto& row : table.rows_)
        if (row.cells.size() != table.columns_.size())
            throw InputError({table.file_, row.line},
                             fmt::format("found {} cells, allowed are {}", row.cells.size(), table.columns_.size()));
    return table;
}

std::optional<std::size_t> CsvTable::find(const std::string& column) const
{
    const auto it = std::find(columns_.begin(), columns_.end(), column);
    return it == columns_.end() ? std::nullopt : std::optional<std::size_t>(it - columns_.begin());
}

std::size_t CsvTable::column(const std::string& name) const
{
    if (const auto found = find(name))
        return *found;
    const std::string nearest = nearestWord(name, columns_);
    throw InputError({file_, 1}, fmt::format("found no column {}{}; columns are {}", name,
                                             nearest.empty() ? "" : fmt::format(" (is {} meant?)", nearest),
                                             joinWords(columns_, ", ")));
}

double CsvTable::number(const Row& row, std::size_t column) const
{
    const auto value = parseNumber(trimmed(row.cells[column]));
    if (!value)
        fail(row, column, "a finite number");
    return *value;
}

void CsvTable::fail(const Row& row, std::size_t column, const std::string& allowed) const
{
    throw InputError({file_, row.line},
                     fmt::format("{}: found '{}', allowed is {}", columns_[column], row.cells[column], allowed));
}

std::size_t CsvTable::addColumn(const std::string& name)
{
    if (const auto found = find(name))
        return *found;
    columns_.push_back(name);
    for (auto& row : rows_)
        row.cells.emplace_back();
    return columns_.size() - 1;
}

void CsvTable::addRow(std::vector<std::string> cells)
{
    cells.resize(columns_.size());
    rows_.push_back({int(rows_.size()) + 2, std::move(cells)});
}

std::string CsvTable::text() const
{
    std::string out = joinCells(columns_);
    for (const auto& row : rows_)
        out += joinCells(row.cells);
    return out;
}

std::optional<double> parseNumber(const std::string& text)
{
    const char* first = text.data() + (!text.empty() && text[0] == '+');
    const char* last = text.data() + text.size();
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value))
        return std::nullopt;
    return value;
}
} // namespace mpm

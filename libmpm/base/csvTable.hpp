#pragma once
/// Comma-separated tables with a header line, cells quoted as in RFC 4180, '#' lines and empty lines skipped.
///
/// Every complaint carries file:line, what was found and what is allowed.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mpm
{
class CsvTable
{
  public:
    struct Row
    {
        int line; ///< where it stands in the file
        std::vector<std::string> cells;
    };

    explicit CsvTable(std::vector<std::string> columns = {});
    /// Throws InputError: unreadable file, no header, a column named twice, a row of another length, an open quote.
    static CsvTable read(const std::filesystem::path& file);

    const std::vector<std::string>& columns() const { return columns_; }
    const std::vector<Row>& rows() const { return rows_; }
    std::optional<std::size_t> find(const std::string& column) const;
    /// Throws InputError for a column that is not there: the list and the nearest name.
    std::size_t column(const std::string& name) const;
    /// The finite number in a cell; throws InputError.
    double number(const Row& row, std::size_t column) const;
    /// Throws InputError: "file:line: column: found ..., allowed ...".
    [[noreturn]] void fail(const Row& row, std::size_t column, const std::string& allowed) const;

    /// Appends the column, or returns the one that is there.
    std::size_t addColumn(const std::string& name);
    void addRow(std::vector<std::string> cells);
    void set(std::size_t row, std::size_t column, std::string cell) { rows_[row].cells[column] = std::move(cell); }

    /// The table as text; cells with commas, quotes or line ends are quoted.
    std::string text() const;

  private:
    std::string file_;
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
};

/// The number in `text` or nothing; the whole text must be one finite number.
std::optional<double> parseNumber(const std::string& text);
} // namespace mpm

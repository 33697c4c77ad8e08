#pragma once
/// A time series as CSV: one header line, one row a time, first column `time` if not said otherwise, numbers in their
/// shortest form that reads back to the same bits. Rows reach the file one by one (nothing is buffered beyond a row).
///
/// A run that continues at time t keeps the rows up to t and cuts off later ones, those a former run wrote beyond the
/// state that was restarted from, together with a last line that a killed run left unfinished; the file is rewritten
/// through a temporary and a rename. A header other than expected is an InputError, the file stays as it is.
///
///     CsvSeries history("postProcessing/history.csv", {"time", "dt", "particles"}, state.time);
///     history.write({state.time, state.deltaT, 1800});
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mpm::output
{
class CsvSeries
{
  public:
    /// Without continueAt the series starts anew and replaces an old file. With it, rows with
    /// time <= continueAt + 1e-10 |continueAt| stay; a missing file is begun. timeColumn: which column is the time.
    CsvSeries(const std::filesystem::path& file, std::vector<std::string> columns,
              std::optional<double> continueAt = std::nullopt, std::size_t timeColumn = 0);

    /// Rows go to an open file that is there (memoryFile.hpp), without a header: for measuring what they cost.
    static CsvSeries rehearsal(const std::filesystem::path& file, std::vector<std::string> columns,
                               std::size_t timeColumn = 0);

    /// One value a column. Throws InputError if the row cannot be written (disk full).
    void write(std::span<const double> row);
    void write(std::initializer_list<double> row) { write(std::span(row.begin(), row.size())); }

    /// Brings the rows to the disk (fsync), as far as the file system can. From any thread.
    void synchronise() const;

    /// Time of the last row in the file; nothing if there is none. A continuing run need not repeat it.
    std::optional<double> lastTime() const { return lastTime_; }

  private:
    CsvSeries() = default;
    std::string keptRows(double until);

    std::filesystem::path file_;
    std::vector<std::string> columns_;
    std::ofstream stream_;
    std::size_t timeColumn_ = 0;
    std::optional<double> lastTime_;
};

/// The shortest decimal form that reads back to the same double ("0.1", "1e-05", "nan").
std::string shortest(double value);
} // namespace mpm::output

// Tables of numbers as CSV: one header line with units in the names, then full double precision.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ripstop/core/members.h"

namespace ripstop::inline output {

struct CsvTable {
  std::vector<std::string> columns;       // "speed_m_s", "drag_n"
  std::vector<std::vector<double>> rows;  // as long as `columns`; NaN and infinities are written as such

  /// All values of a column. Throws Error(bad_data) naming the columns there are.
  std::vector<double> column(std::string_view name) const;
};

/// Throws Error(bad_data) for a name with comma, quote or line break or a row of another length, Error(io).
void write_csv(const std::filesystem::path& path, const CsvTable& table);

/// Every double comes back bit for bit (but for the payload of a NaN). Empty lines and lines that start with
/// '#' are skipped, blanks around fields dropped. Throws Error(bad_data) with file and line, Error(io).
CsvTable read_csv(const std::filesystem::path& path);

/// The rows of a table of listed structs, which has all of their columns.
template <class Row>
std::vector<Row> read_rows(const std::filesystem::path& path) {
  std::vector<Row> rows;
  for (const std::vector<double>& row : read_csv(path).rows) rows.push_back(from_row<Row>(row));
  return rows;
}

/// A table with words in it, such as the keys of a sweep.
struct TextTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // as long as `columns`
};
/// Fields with a comma or a quote are quoted as in RFC 4180, line breaks become blanks. Throws as above.
void write_csv(const std::filesystem::path& path, const TextTable& table);
/// The shortest text that reads back as the same double.
std::string csv_number(double value);

/// A table that grows by rows during a run and survives its end at any moment.
class CsvLog {
 public:
  /// Starts the file, or continues one that has the same columns: a last line that a kill left unfinished is
  /// dropped, and so are complete rows after the first `keep_rows` (those that a restart will compute again).
  /// Throws Error(bad_data) for other columns or a broken row, Error(io).
  CsvLog(std::filesystem::path path, std::vector<std::string> columns,
         std::optional<std::size_t> keep_rows = {});

  /// The row is on the disk when this returns. Throws as write_csv().
  void add(const std::vector<double>& row);
  void add_rows(const std::vector<std::vector<double>>& rows);

 private:
  std::filesystem::path path_;
  std::vector<std::string> columns_;
};

}  // namespace ripstop::inline output

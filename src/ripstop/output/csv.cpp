#include "ripstop/output/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"

namespace ripstop::inline output {
namespace {

std::string header_line(const std::filesystem::path& path, const std::vector<std::string>& columns) {
  for (const std::string& name : columns) {
    if (name.empty() || name.find_first_of(",\"\r\n#") != std::string::npos) {
      throw Error(ExitCode::bad_data,
                  fmt::format("{}: \"{}\" cannot be a column's name", path.string(), name));
    }
  }
  return fmt::format("{}\n", fmt::join(columns, ","));
}

std::string row_line(const std::filesystem::path& path, const std::vector<std::string>& columns,
                     const std::vector<double>& row) {
  if (row.size() != columns.size()) {
    throw Error(ExitCode::bad_data, fmt::format("{}: a row of {} values for {} columns", path.string(),
                                                row.size(), columns.size()));
  }
  return fmt::format("{}\n", fmt::join(row, ","));  // {}: the shortest text that reads back the same
}

std::string_view trimmed(std::string_view text) {
  constexpr const char* blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

CsvTable parse(const std::filesystem::path& path, std::string_view text) {
  CsvTable table;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string_view> fields = fields_of(line);
    if (table.columns.empty()) {
      table.columns.assign(fields.begin(), fields.end());
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (std::find(fields.begin(), fields.begin() + i, fields[i]) != fields.begin() + i)
          throw Error(ExitCode::bad_data,
                      fmt::format("{}:{}: the column \"{}\" occurs twice", path.string(), number, fields[i]));
      continue;
    }
    if (fields.size() != table.columns.size()) {
      throw Error(ExitCode::bad_data, fmt::format("{}:{}: {} values for {} columns", path.string(), number,
                                                  fields.size(), table.columns.size()));
    }
    std::vector<double>& row = table.rows.emplace_back(fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const char* last = fields[i].data() + fields[i].size();
      const auto [stop, error] = std::from_chars(fields[i].data(), last, row[i]);
      if (error != std::errc() || stop != last) {
        throw Error(ExitCode::bad_data, fmt::format("{}:{}: column {} contains \"{}\", which is not a number",
                                                    path.string(), number, table.columns[i], fields[i]));
      }
    }
  }
  if (table.columns.empty()) {
    throw Error(ExitCode::bad_data,
                fmt::format("{} is empty: the line with the names of the columns is missing", path.string()));
  }
  return table;
}

}  // namespace

std::vector<double> CsvTable::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) {
    throw Error(ExitCode::bad_data,
                fmt::format("the table has no column {}; it has {}", name, fmt::join(columns, ", ")));
  }
  std::vector<double> values;
  for (const std::vector<double>& row : rows) values.push_back(row[found - columns.begin()]);
  return values;
}

void write_csv(const std::filesystem::path& path, const CsvTable& table) {
  std::string text = header_line(path, table.columns);
  for (const std::vector<double>& row : table.rows) text += row_line(path, table.columns, row);
  write_file(path, text);
}

void write_csv(const std::filesystem::path& path, const TextTable& table) {
  std::string text = header_line(path, table.columns);
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() != table.columns.size()) {
      throw Error(ExitCode::bad_data, fmt::format("{}: a row of {} values for {} columns", path.string(),
                                                  row.size(), table.columns.size()));
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::string field = row[i];
      std::replace_if(
          field.begin(), field.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
      if (field.find_first_of(",\"#") != std::string::npos) {
        std::string inside;
        for (const char c : field) inside += c == '"' ? "\"\"" : std::string(1, c);
        field = '"' + inside + '"';
      }
      text += (i ? "," : "") + field;
    }
    text += '\n';
  }
  write_file(path, text);
}

std::string csv_number(double value) {
  return fmt::format("{}", value);
}

CsvTable read_csv(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  if (!text.empty() && text.back() != '\n' && text.back() != '\r')
    throw Error(ExitCode::bad_data,
                fmt::format("{}:{}: the last line has no line end: the table may be incomplete; use the "
                            "complete file, or end the line",
                            path.string(), std::count(text.begin(), text.end(), '\n') + 1));
  return parse(path, text);
}

CsvLog::CsvLog(std::filesystem::path path, std::vector<std::string> columns,
               std::optional<std::size_t> keep_rows)
    : path_(std::move(path)), columns_(std::move(columns)) {
  CsvTable table{columns_, {}};
  std::error_code ignored;
  if (std::filesystem::exists(path_, ignored)) {
    const std::string text = read_file(path_);
    const std::size_t complete = text.rfind('\n') + 1;  // npos + 1 = 0: not even the header is complete
    if (complete > 0) table = parse(path_, std::string_view(text).substr(0, complete));
    if (table.columns != columns_) {
      throw Error(ExitCode::bad_data,
                  fmt::format("{} has the columns {} instead of {}; move it away", path_.string(),
                              fmt::join(table.columns, ", "), fmt::join(columns_, ", ")));
    }
    table.rows.resize(std::min(table.rows.size(), keep_rows.value_or(table.rows.size())));
  }
  write_csv(path_, table);
}

void CsvLog::add(const std::vector<double>& row) {
  append_to_file(path_, row_line(path_, columns_, row));
}

void CsvLog::add_rows(const std::vector<std::vector<double>>& rows) {
  std::string lines;
  for (const std::vector<double>& row : rows) lines += row_line(path_, columns_, row);
  append_to_file(path_, lines);
}

}  // namespace ripstop::inline output

#include "ripstop/core/table/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/table/layout.h"
#include "ripstop/core/table/text.h"
#include "ripstop/core/table/values.h"
#include "ripstop/core/visible.h"

namespace ripstop::table {
namespace {

constexpr std::size_t most_bytes = 64 << 20;
constexpr std::size_t sample_bytes = 1 << 20;  // that the separator is found in

/// A first line "sep=;" of spreadsheet programs is taken off.
char stated_separator(std::string_view& text) {
  if (text.size() < 6 || folded(text.substr(0, 4)) != "sep=" || text[5] != '\n') return '\0';
  const char separator = text[4];
  text.remove_prefix(5);  // the end of the line stays, so that lines keep their numbers
  return separator;
}

/// How well a separator fits: headings and numbers agree, many headings, many rows of numbers.
std::tuple<bool, std::size_t, std::size_t> fit_of(const std::vector<Row>& rows, KnownHeadings& known) {
  Header header;
  const bool comments = std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.comment; });
  for (const HeaderSearch search : {HeaderSearch{2, false}, HeaderSearch{2, true}}) {
    if (search.comments && !comments) break;
    if (!find_header(rows, 0, known, search, header)) continue;
    const std::vector<std::size_t> places = known.places(rows[header.header]);
    const auto is_whole = [&](const Row& row) {
      std::size_t values = 0;
      for (const std::size_t i : places) {
        if (i >= row.cells.size() || row.cells[i].empty()) continue;
        if (!is_value(row.cells[i])) return false;
        ++values;
      }
      return values > 0;
    };
    const auto whole = std::count_if(rows.begin() + static_cast<long>(header.data), rows.end(), is_whole);
    return {header.consistent, header.headings, static_cast<std::size_t>(whole)};
  }
  // Without a known header: the separator that gives most numbers.
  std::size_t numbers = 0;
  for (const Row& row : rows) {
    const auto values = static_cast<std::size_t>(std::count_if(row.cells.begin(), row.cells.end(), is_value));
    numbers += values > 1 && values == row.cells.size();
  }
  return {false, 0, numbers};
}

bool occurs(std::string_view text, char separator) {
  if (separator == blanks) return text.find_first_of(" \t") != std::string_view::npos;
  return text.find(separator == wide_blanks ? '\t' : separator) != std::string_view::npos ||
         (separator == wide_blanks && text.find("  ") != std::string_view::npos);
}

char find_separator(std::string_view text, KnownHeadings& known, const std::filesystem::path& file) {
  std::string_view sample = text.substr(0, sample_bytes);
  if (sample.size() < text.size()) sample = sample.substr(0, sample.rfind('\n') + 1);
  char best = ',', in_quotes = '\0';
  std::tuple<bool, std::size_t, std::size_t> best_fit{false, 0, 0};
  const bool quotes = sample.find('"') != std::string_view::npos;
  for (const char separator : {'\t', ';', '|', ',', wide_blanks, blanks}) {
    if (!quotes && !occurs(sample, separator)) continue;  // one cell in each row
    std::vector<Row> rows;
    try {
      rows = split_rows(sample, separator, file);
    } catch (const Error&) {  // a quote does not end
      if (!in_quotes) in_quotes = separator;
      continue;
    }
    const auto fit = fit_of(rows, known);
    if (fit > best_fit) best = separator, best_fit = fit;
  }
  return in_quotes && !std::get<0>(best_fit) ? in_quotes : best;
}

/// One specimen of a block: its columns, and the rows in which one of its own has a value.
Specimen specimen_of(const Block& block, const std::vector<Column>& columns, int side,
                     const std::vector<std::size_t>& rows, const std::string& name) {
  Specimen specimen;
  specimen.name = name;
  specimen.header_line = block.header_line;
  std::vector<std::size_t> taken;
  const auto belongs = [&](std::size_t i) {
    return columns[i].quantity != Quantity::specimen &&
           (block.specimen_of[i] < 0 || block.specimen_of[i] == side);
  };
  for (const std::size_t r : rows) {
    bool filled = false;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto cell = static_cast<std::size_t>(columns[i].place - 1);
      const bool own = belongs(i) && (side < 0 || block.specimen_of[i] == side);
      filled = filled || (own && cell < block.rows[r]->cells.size() && !block.rows[r]->cells[cell].empty());
    }
    if (filled) taken.push_back(r);
  }
  for (const std::size_t r : taken) specimen.lines.push_back(block.rows[r]->line);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!belongs(i)) continue;
    Column column = columns[i];
    column.values.clear();
    for (const std::size_t r : taken)
      if (column.problem.empty()) column.values.push_back(columns[i].values[r]);
    specimen.columns.push_back(std::move(column));
  }
  return specimen;
}

/// Rows by the text of a specimen column, in the order of appearance; one group without such a column.
std::vector<std::pair<std::string, std::vector<std::size_t>>> groups_of(const Block& block, Table& table) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> groups(1);
  groups.front().first = block.name;
  for (std::size_t r = 0; r < block.rows.size(); ++r) groups.front().second.push_back(r);
  const auto column = std::find_if(block.columns.begin(), block.columns.end(),
                                   [](const Column& c) { return c.quantity == Quantity::specimen; });
  if (column == block.columns.end()) return groups;
  constexpr std::size_t fewest_rows = 3;  // of a specimen on average; else the column only counts the rows
  std::vector<std::pair<std::string, std::vector<std::size_t>>> named;
  const auto place = static_cast<std::size_t>(column->place - 1);
  std::size_t last = 0;
  for (std::size_t r = 0; r < block.rows.size(); ++r) {
    const std::vector<std::string>& cells = block.rows[r]->cells;
    const std::string& name = place < cells.size() ? cells[place] : "";
    if (named.empty() || (!name.empty() && named[last].first != name)) {
      last = 0;
      while (last < named.size() && named[last].first != name) ++last;
      if (last == named.size()) named.push_back({name, {}});
    }
    named[last].second.push_back(r);
    if (named.size() * fewest_rows > block.rows.size() + fewest_rows) {
      table.notes.push_back(
          fmt::format("column {} \"{}\" counts rows and is ignored", column->place, column->heading));
      return groups;
    }
  }
  return named;
}

void add_specimens(Table& table, const Block& block, const std::vector<Column>& columns) {
  const int sides = static_cast<int>(block.side_names.size());
  for (const auto& [name, rows] : groups_of(block, table))
    for (int side = sides > 0 ? 0 : -1; side < sides; ++side) {
      std::string own = name;
      if (side >= 0) own += (name.empty() ? "" : " ") + block.side_names[static_cast<std::size_t>(side)];
      Specimen specimen = specimen_of(block, columns, side, rows, own);
      if (!specimen.lines.empty()) table.specimens.push_back(std::move(specimen));
    }
}

std::string range_of(const Column& column) {
  double low = 0, high = 0;
  std::size_t count = 0;
  for (const double value : column.values) {
    if (std::isnan(value)) continue;
    low = count == 0 ? value : std::min(low, value);
    high = count == 0 ? value : std::max(high, value);
    ++count;
  }
  if (count == 0) return "no values";
  const std::size_t missing = column.values.size() - count;
  const std::string unit = si_unit(dimension_of(column.quantity));
  return fmt::format("{} values from {:.5g} to {:.5g}{}{}{}", count, low, high, unit.empty() ? "" : " ", unit,
                     missing > 0 ? fmt::format(", {} cells empty", missing) : "");
}

}  // namespace

Table read_table(const std::filesystem::path& file, const Format& format) {
  return parse_table(read_file(file), file, format);
}

Table parse_table(const std::string& bytes, const std::filesystem::path& file, const Format& format) {
  if (bytes.size() > most_bytes) refuse(file, 0, "larger than 64 MiB; export fewer rows");
  const Text decoded = decode(bytes, file);
  std::string_view text = decoded.utf8;
  if (!text.empty() && text.back() != '\n')
    refuse(
        file, static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 1,
        "the last line has no line end: the table may be incomplete; use the complete file, or end the line");
  const char stated = stated_separator(text);
  KnownHeadings known(format);
  const char separator = stated ? stated : find_separator(text, known, file);
  const std::vector<Row> rows = split_rows(text, separator, file);
  Layout layout = find_layout(rows, known, file);

  Table table{file, decoded.encoding, name_of_separator(separator), '.', {}, {}, std::move(layout.notes)};
  for (const Row& row : rows)
    if (row.comment) table.comments.push_back({row.line, row.text});
  for (const Block& block : layout.blocks) check_rows(block, file);
  const char decimal = decimal_mark(layout.blocks, format, file);
  table.decimal = decimal ? decimal : '.';
  for (const Block& block : layout.blocks) {
    std::vector<Column> columns = block.columns;
    for (Column& column : columns)
      if (column.quantity != Quantity::specimen) {
        read_values(block, column, decimal, format.decimal, file);
        if (!column.problem.empty() && format.wanted.empty()) throw Error(ExitCode::bad_data, column.problem);
      }
    add_specimens(table, block, columns);
  }
  if (table.specimens.empty()) refuse(file, 0, "a header, but no measurements below it");
  for (std::size_t i = 0; table.specimens.size() > 1 && i < table.specimens.size(); ++i)
    if (table.specimens[i].name.empty()) table.specimens[i].name = std::to_string(i + 1);
  return table;
}

std::vector<const Column*> Specimen::all(Quantity quantity) const {
  std::vector<const Column*> found;
  for (const Column& column : columns)
    if (column.quantity == quantity) found.push_back(&column);
  return found;
}

const Column* find_only(const Table& table, const Specimen& specimen, Quantity quantity) {
  const std::vector<const Column*> found = specimen.all(quantity);
  if (found.empty()) return nullptr;
  if (found.size() > 1)
    refuse(
        table.file, specimen.header_line,
        fmt::format(
            "two columns can be {}: \"{}\" and \"{}\"; select one of them, for example --columns \"{}={}\"",
            name_of(quantity), found[0]->heading, found[1]->heading, name_of(quantity), found[0]->heading));
  if (!found.front()->problem.empty()) throw Error(ExitCode::bad_data, found.front()->problem);
  return found.front();
}

const Column& need_only(const Table& table, const Specimen& specimen, Quantity quantity) {
  const Column* column = find_only(table, specimen, quantity);
  if (!column) refuse_missing(table, specimen, name_of(quantity));
  need_values(table, specimen, *column);
  return *column;
}

void refuse_missing(const Table& table, const Specimen& specimen, const std::string& quantities) {
  std::vector<std::string> headings;
  for (const Column& column : specimen.columns)
    headings.push_back(fmt::format("\"{}\" ({})", column.heading, name_of(column.quantity)));
  refuse(table.file, specimen.header_line,
         fmt::format("no column for the {0}; recognised columns: {1}; write the heading \"{0} [unit]\", or "
                     "give the column with --columns \"{0}=HEADING\"",
                     quantities, headings.empty() ? "none" : fmt::format("{}", fmt::join(headings, ", "))));
}

void need_values(const Table& table, const Specimen& specimen, const Column& column) {
  for (std::size_t i = 0; i < column.values.size(); ++i)
    if (std::isnan(column.values[i]))
      refuse(table.file, specimen.lines[i],
             fmt::format(
                 "no value in the column \"{}\" (number {}), which must have one in each row: fill the cell, "
                 "or remove the line",
                 column.heading, column.place));
}

std::vector<std::string> explanation(const Table& table) {
  std::vector<std::string> lines;
  for (const Specimen& specimen : table.specimens)
    for (const Column& column : specimen.columns)
      lines.push_back(fmt::format("{}{}: column {} \"{}\" is {} in {}, {}", table.file.filename().string(),
                                  specimen.name.empty() ? "" : ", specimen " + specimen.name, column.place,
                                  column.heading, name_of(column.quantity),
                                  column.unit.empty() ? "no known unit" : column.unit,
                                  column.problem.empty() ? range_of(column) : "not used"));
  for (const std::string& note : table.notes) lines.push_back(table.file.filename().string() + ": " + note);
  for (std::string& line : lines) line = visible_line(line);
  return lines;
}

}  // namespace ripstop::table

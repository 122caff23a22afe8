#include "ripstop/core/table/values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "ripstop/core/error.h"
#include "ripstop/core/table/number.h"

namespace ripstop::table {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double day = 86400;  // [s]

const std::string& cell_of(const Row& row, const Column& column) {
  static const std::string empty;
  const auto i = static_cast<std::size_t>(column.place - 1);
  return i < row.cells.size() ? row.cells[i] : empty;
}

/// "file:7: "1.016" in the column "Load (N)" (number 2) REASON"
std::string message(const std::filesystem::path& file, const Row& row, const Column& column,
                    const std::string& reason) {
  return fmt::format("{}:{}: \"{}\" in the column \"{}\" (number {}) {}", file.string(), row.line,
                     cell_of(row, column).substr(0, 40), column.heading, column.place, reason);
}

struct Seen {
  const Row* row = nullptr;
  const Column* column = nullptr;
};

/// The marks in the cells of one column.
struct Marks {
  const Row* decimal[2] = {};    // surely, by '.' or ','
  const Row* ambiguous[2] = {};  // the first cell such as "1.016"
  const Row* small = nullptr;    // the first integer of up to three digits
  const Row* large = nullptr;    // the first of four digits or more
};

Marks marks_of(const Block& block, const Column& column) {
  Marks marks;
  for (const Row* row : block.rows) {
    const auto first = [&](const Row*& found) {
      if (!found) found = row;
    };
    switch (form_of(cell_of(*row, column))) {
      case NumberForm::point_decimal:
        first(marks.decimal[0]);
        break;
      case NumberForm::comma_decimal:
        first(marks.decimal[1]);
        break;
      case NumberForm::point_or_group:
        first(marks.ambiguous[0]);
        break;
      case NumberForm::comma_or_group:
        first(marks.ambiguous[1]);
        break;
      case NumberForm::small_integer:
        first(marks.small);
        break;
      case NumberForm::integer:
        first(marks.large);
        break;
      default:
        break;
    }
  }
  return marks;
}

/// Reason why a mark of this column can be a decimal or a thousands mark; empty: it is unambiguous, and
/// `decimal` is the mark.
std::string ambiguity(const Block& block, const Column& column, char& decimal,
                      const std::filesystem::path& file) {
  const Marks marks = marks_of(block, column);
  if (marks.decimal[0] || marks.decimal[1]) return "";  // then the whole file has this mark
  for (const int k : {0, 1}) {
    if (!marks.ambiguous[k]) continue;
    const char mark = k == 0 ? '.' : ',';
    if (marks.large && decimal != (k == 0 ? ',' : '.')) {  // thousands without groups: the mark is no group's
      decimal = mark;
      continue;
    }
    const Row* plain = marks.small ? marks.small : marks.large;
    if (!plain && decimal != 0) continue;
    const std::string why = plain ? fmt::format("because other values such as \"{}\" (line {}) have no mark",
                                                cell_of(*plain, column), plain->line)
                                  : "and no other value of the file shows which";
    return message(
        file, *marks.ambiguous[k], column,
        fmt::format("may be a thousand or a decimal number, {}; state the decimal mark: decimal = "
                    "\"point\" or \"comma\" in the campaign, --decimal point or --decimal comma on the "
                    "command line",
                    why));
  }
  return "";
}

using Times = std::vector<std::pair<const Row*, ClockTime>>;

/// Why the form of these times leaves a choice; empty: it does not.
std::string doubt(const Times& times, ClockForm form, const Column& column,
                  const std::filesystem::path& file) {
  const bool fraction =
      std::any_of(times.begin(), times.end(), [](const auto& t) { return t.second.has_fraction; });
  const ClockTime& first = times.front().second;
  for (const auto& [row, time] : times) {
    if (time.parts != first.parts)
      return message(file, *row, column,
                     fmt::format("has {} parts, but times above it have {}; use one format for all",
                                 time.parts, first.parts));
    if (time.parts == 2 && form == ClockForm::none && !fraction)
      return message(
          file, *row, column,
          "may be hours and minutes or minutes and seconds; write (hh:mm) or (mm:ss) into the heading");
    if (time.other_date != first.other_date)
      return message(file, *row, column,
                     fmt::format("has another date than \"{}\" above it, and the order of day and month is "
                                 "ambiguous; write dates as 2026-05-31",
                                 first.other_date));
  }
  return "";
}

/// A later row whose time is earlier by more than a row out of order explains; nothing: there is none. Midnight
/// without a date is a step of more than 12 h.
const Row* set_back(const Times& times, ClockForm form) {
  constexpr double out_of_order = 600;  // [s]
  for (std::size_t i = 1; i < times.size(); ++i) {
    const ClockTime &before = times[i - 1].second, &now = times[i].second;
    const double unit = now.parts == 2 && form == ClockForm::hours_minutes ? 60 : 1;
    double back = unit * (before.seconds - now.seconds);
    if (now.has_day) back += day * (before.day - now.day);
    if (back > out_of_order && (now.has_day || back <= 0.5 * day)) return times[i].first;
  }
  return nullptr;
}

/// Seconds after the first time.
std::vector<double> seconds_of(const Times& times, ClockForm form) {
  std::vector<double> seconds;
  double last = 0, midnights = 0;
  for (const auto& [row, time] : times) {
    double now = time.seconds * (time.parts == 2 && form == ClockForm::hours_minutes ? 60 : 1);
    if (time.has_day) now += day * time.day;
    // A decrease of more than half of 24 h is midnight; a smaller one is a row out of order.
    if (!seconds.empty() && !time.has_day && last - now > 0.5 * day) midnights += day;
    last = now;
    seconds.push_back(now + midnights);
  }
  const double start = seconds.front();
  for (double& s : seconds) s -= start;
  return seconds;
}

/// True if the column has clock times: its values are then read, or its problem is recorded.
bool read_clock(const Block& block, Column& column, const std::filesystem::path& file) {
  if (column.quantity != Quantity::time) return false;
  Times times;
  const Row* other = nullptr;
  for (const Row* row : block.rows) {
    const std::string& cell = cell_of(*row, column);
    if (const std::optional<ClockTime> time = clock_of(cell))
      times.emplace_back(row, *time);
    else if (!cell.empty() && !other)
      other = row;
  }
  const ClockForm form = clock_form(column.unit);
  if (times.empty() && form == ClockForm::none) return false;
  if (other)
    column.problem =
        message(file, *other, column,
                "is not a clock time such as 10:15:03.5, unlike the rest of the column; correct it");
  else if (!times.empty())
    column.problem = doubt(times, form, column, file);
  if (const Row* row = column.problem.empty() ? set_back(times, form) : nullptr)
    column.problem =
        message(file, *row, column,
                "is earlier than the time above it: a clock of twelve hours needs AM and PM, and "
                "a clock that was set back needs two files");
  if (!column.problem.empty()) return true;
  column.unit = "clock";
  column.values.assign(block.rows.size(), nothing);
  if (times.empty()) return true;
  const std::vector<double> seconds = seconds_of(times, form);
  for (std::size_t i = 0, k = 0; i < block.rows.size() && k < times.size(); ++i)
    if (times[k].first == block.rows[i]) column.values[i] = seconds[k++];
  return true;
}

}  // namespace

char decimal_mark(const std::vector<Block>& blocks, const Format& format, const std::filesystem::path& file) {
  if (format.decimal != Decimal::automatic) return format.decimal == Decimal::point ? '.' : ',';
  Seen seen[2];
  for (const Block& block : blocks)
    for (const Column& column : block.columns) {
      if (column.quantity == Quantity::specimen) continue;
      const Marks marks = marks_of(block, column);
      for (const int k : {0, 1})
        if (marks.decimal[k] && !seen[k].row) seen[k] = {marks.decimal[k], &column};
    }
  if (seen[0].row && seen[1].row) {
    const Seen &a = seen[0], &b = seen[1];
    const Seen& last = a.row->line > b.row->line ? a : b;
    const Seen& first = a.row->line > b.row->line ? b : a;
    throw Error(ExitCode::bad_data, message(file, *last.row, *last.column,
                                            fmt::format("has a different decimal mark than \"{}\" in the "
                                                        "column \"{}\" (line {}); use one mark everywhere",
                                                        cell_of(*first.row, *first.column).substr(0, 40),
                                                        first.column->heading, first.row->line)));
  }
  return seen[0].row ? '.' : seen[1].row ? ',' : '\0';
}

void check_rows(const Block& block, const std::filesystem::path& file) {
  for (const Row* row : block.rows) {
    if (row->cells.size() > block.width)
      refuse(file, row->line,
             fmt::format("{} values for {} columns: check that the header matches the values. Numbers with "
                         "decimal commas need quotes where commas separate them",
                         row->cells.size(), block.width));
    // Side by side a shorter specimen may end before the others; a row that ends within a specimen is cut.
    for (std::size_t i = 0; i < block.columns.size(); ++i) {
      if (static_cast<std::size_t>(block.columns[i].place) <= row->written) continue;
      const int specimen = block.specimen_of[i];
      bool begun = specimen < 0;
      for (std::size_t k = 0; k < block.columns.size(); ++k)
        begun = begun || (block.specimen_of[k] == specimen && !cell_of(*row, block.columns[k]).empty());
      if (begun)
        refuse(file, row->line,
               fmt::format(
                   "{} values for {} columns, none for column {} \"{}\": check that the file is complete",
                   row->written, block.width, block.columns[i].place, block.columns[i].heading));
    }
  }
}

void read_values(const Block& block, Column& column, char decimal, Decimal stated,
                 const std::filesystem::path& file) {
  if (!column.problem.empty() || read_clock(block, column, file)) return;
  if (stated == Decimal::automatic) column.problem = ambiguity(block, column, decimal, file);
  if (!column.problem.empty()) return;
  const double factor = unit_factor(dimension_of(column.quantity), column.unit).value_or(1);
  for (const Row* row : block.rows) {
    const std::string& cell = cell_of(*row, column);
    if (cell.empty()) {
      column.values.push_back(nothing);
      continue;
    }
    const std::optional<double> value = number_of(cell, decimal == 0 ? '.' : decimal);
    if (!value || !std::isfinite(*value * factor)) {
      const bool groups = form_of(cell) != NumberForm::not_a_number;
      const char* mark = decimal == ',' ? "comma" : "point";
      column.problem = message(
          file, *row, column,
          fmt::format("is not a finite number{}; correct the cell, or leave it empty",
                      groups ? fmt::format(" with a decimal {} and digits in groups of three", mark) : ""));
      return;
    }
    constexpr double largest = 1e12;  // in SI units; no machine measures more
    if (std::abs(*value * factor) > largest) {
      column.problem =
          message(file, *row, column,
                  "is larger than any measured value: instruments write such numbers on overload; "
                  "leave the cell empty");
      return;
    }
    column.values.push_back(*value * factor);
  }
}

}  // namespace ripstop::table

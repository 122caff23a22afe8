// Tables from machines: testing machines, load cells, tunnels, loggers. docs/guide/tables.md describes the
// accepted forms.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ripstop/core/table/heading.h"

namespace ripstop::table {

enum class Decimal { automatic, point, comma };

/// The user's choice of a column: --columns "force=Kraft [kN]".
struct ColumnChoice {
  Quantity quantity = Quantity::other;
  std::string heading;  // with or without its unit; empty: only the unit is given
  std::string unit;     // empty: as in the file
};

struct Format {
  std::vector<Quantity> wanted;  // the quantities that are used; empty: all
  std::vector<ColumnChoice> columns;
  Decimal decimal = Decimal::automatic;
};

struct Column {
  Quantity quantity = Quantity::other;
  std::string heading;         // as in the file
  std::string unit;            // of the file: "kN"; "clock" for clock times
  int place = 0;               // counted from 1
  std::vector<double> values;  // in SI, a strain as a fraction; NaN: the cell is empty
  std::string problem;         // why it cannot be used; empty: it can
};

struct Specimen {
  std::string name;             // "2"; empty: the file has only one
  int header_line = 0;          // of the file
  std::vector<Column> columns;  // of known and wanted quantities, in the order of the file
  std::vector<int> lines;       // of the file, one for each row

  std::vector<const Column*> all(Quantity quantity) const;
};

struct Comment {
  int line = 0;
  std::string text;  // without the '#'
};

struct Table {
  std::filesystem::path file;
  std::string encoding, separator;
  char decimal = '.';
  std::vector<Comment> comments;
  std::vector<Specimen> specimens;  // one at least, each with one row at least
  std::vector<std::string> notes;   // lines that were left out, and why
};

/// A column that cannot be read (no unit, no number, two ways to read it) is refused here, but where
/// `format.wanted` is not
/// empty only when it is asked for: a record with an extension may have a strain without a unit. Throws
/// Error(bad_data) with file, line, column, value and remedy, Error(io).
Table read_table(const std::filesystem::path& file, const Format& format = {});
/// The same for a file's bytes; `file` is its name in messages.
Table parse_table(const std::string& bytes, const std::filesystem::path& file, const Format& format = {});

/// "force=Kraft [kN],extension=Weg [mm]". Throws Error(usage).
std::vector<ColumnChoice> parse_columns(const std::string& text);
/// "point", "comma"; "" and "auto": automatic. Throws Error(usage).
Decimal parse_decimal(const std::string& text);

/// The only column of a quantity; null: there is none. Throws Error(bad_data) for two, and names them.
const Column* find_only(const Table& table, const Specimen& specimen, Quantity quantity);
/// Throws Error(bad_data) also where there is none, and where a cell is empty.
const Column& need_only(const Table& table, const Specimen& specimen, Quantity quantity);
[[noreturn]] void refuse_missing(const Table& table, const Specimen& specimen, const std::string& quantities);
/// Every cell has a number. Throws Error(bad_data).
void need_values(const Table& table, const Specimen& specimen, const Column& column);

/// One line for each column: how it was understood.
std::vector<std::string> explanation(const Table& table);

}  // namespace ripstop::table

#include "ripstop/material/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/material/units.h"

namespace ripstop {
namespace {

constexpr std::size_t most_bytes = 64 << 20;

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& reason) {
  throw Error(ExitCode::bad_data, line > 0 ? fmt::format("{}:{}: {}", file.string(), line, reason)
                                           : fmt::format("{}: {}", file.string(), reason));
}

std::string trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"' || c == '\''; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// With a decimal comma only where fields are not separated by commas.
std::optional<double> number(std::string text, char separator) {
  if (separator != ',') std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || rest != end || begin == end) return {};
  return value;
}

struct Column {
  enum class Kind { force, displacement, strain, time, other } kind = Kind::other;
  std::string name, unit;
};

/// "Load (lbf)" -> {force, "Load", "lbf"}; "extension_mm" -> {displacement, "extension", "mm"}.
Column column_of(const std::string& heading, const RecordFormat& format) {
  Column column{Column::Kind::other, heading, ""};
  for (const auto& [open, close] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const std::size_t from = heading.find(open), to = heading.find(close);
    if (from == std::string::npos || to == std::string::npos || to < from) continue;
    column.name = trimmed(heading.substr(0, from));
    column.unit = trimmed(heading.substr(from + 1, to - from - 1));
  }
  const auto has = [&](std::initializer_list<const char*> words) {
    const std::string name = lower(column.name);
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return name.find(word) != std::string::npos; });
  };
  if (heading == format.force_column || (format.force_column.empty() && has({"force", "load"})))
    column.kind = Column::Kind::force;
  else if (heading == format.displacement_column ||
           (format.displacement_column.empty() &&
            has({"displacement", "extension", "elongation", "stroke", "travel", "crosshead", "position"})))
    column.kind = Column::Kind::displacement;
  else if (format.displacement_column.empty() && has({"strain"}))
    column.kind = Column::Kind::strain;
  else if (has({"time"}))
    column.kind = Column::Kind::time;
  const std::size_t bar = column.name.rfind('_');
  if (column.unit.empty() && column.kind != Column::Kind::other && bar != std::string::npos) {
    column.unit = column.name.substr(bar + 1);
    column.name.resize(bar);
  }
  return column;
}

struct Reader {
  const std::filesystem::path& file;
  const RecordFormat& format;
  TensileRecord record{};
  char separator = ',';
  std::vector<Column> columns{};
  int force = -1, displacement = -1, time = -1;
  bool is_strain = false;
  int header_line = 0;

  double factor(Quantity quantity, const Column& column, const std::string& given, const char* key) const {
    if (!given.empty() && !column.unit.empty() && given != column.unit)
      refuse(file, header_line,
             fmt::format("mixed units: the header says {} in {}, {} says {}; correct one of them",
                         column.name, column.unit, key, given));
    const std::string unit = given.empty() ? column.unit : given;
    if (unit.empty())
      refuse(file, header_line,
             fmt::format("no unit for the column \"{}\": write it in the header as in \"force [N]\", or give "
                         "{}",
                         column.name, key));
    const std::optional<double> value = unit_factor(quantity, unit);
    if (!value)
      refuse(file, header_line,
             fmt::format("\"{}\" is not a unit for {}; known: {}", unit, column.name, known_units(quantity)));
    return *value;
  }

  int only(Column::Kind kind, const char* what, const char* key) const {
    int found = -1;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].kind != kind) continue;
      if (found >= 0)
        refuse(file, header_line,
               fmt::format("two columns look like {}: \"{}\" and \"{}\"; choose one with {}", what,
                           columns[found].name, columns[i].name, key));
      found = static_cast<int>(i);
    }
    return found;
  }

  void read_header(const std::string& line, int line_number) {
    header_line = line_number;
    separator = line.find('\t') != std::string::npos ? '\t' : line.find(';') != std::string::npos ? ';' : ',';
    for (const std::string& heading : split(line, separator)) columns.push_back(column_of(heading, format));
    force = only(Column::Kind::force, "force", "force_column");
    displacement = only(Column::Kind::displacement, "displacement", "displacement_column");
    time = only(Column::Kind::time, "time", "another name");
    if (displacement < 0) {
      displacement = only(Column::Kind::strain, "strain", "displacement_column");
      is_strain = displacement >= 0;
    }
    for (const auto& [index, what, key] : {std::tuple{force, "force", "force_column"},
                                           std::tuple{displacement, "displacement", "displacement_column"}})
      if (index < 0)
        refuse(file, line_number,
               fmt::format("no column for the {} in the header \"{}\"; name it there as in \"{} [unit]\" or "
                           "with {}",
                           what, line.substr(0, 80), what, key));
  }

  /// A second header line that holds only units, "(mm),(N)".
  bool take_units(const std::vector<std::string>& fields) {
    if (!record.force.empty() || fields.size() != columns.size()) return false;
    for (const std::string& field : fields)
      if (number(field, separator)) return false;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      std::string unit = fields[i];
      std::erase_if(unit, [](char c) { return c == '(' || c == ')' || c == '[' || c == ']'; });
      if (columns[i].unit.empty()) columns[i].unit = unit;
    }
    return true;
  }

  /// "# length: 200 mm"; other comments are left alone.
  void read_comment(const std::string& line, int line_number) {
    const std::string text = trimmed(std::string_view(line).substr(1));
    const std::size_t colon = text.find_first_of(":=");
    if (colon == std::string::npos) return;
    const std::string key = lower(trimmed(text.substr(0, colon)));
    const std::string rest = trimmed(text.substr(colon + 1));
    double* target = key == "length" || key == "gauge length" ? &record.coupon.length
                     : key == "width"                         ? &record.coupon.width
                     : key == "orientation"                   ? &record.coupon.orientation
                                                              : nullptr;
    if (!target) return;
    const Quantity quantity = key == "orientation" ? Quantity::angle : Quantity::length;
    const std::size_t end = rest.find_first_not_of("0123456789.,+-eE");
    const std::optional<double> value = number(trimmed(rest.substr(0, end)), ';');
    const std::string unit = end == std::string::npos ? "" : trimmed(rest.substr(end));
    const std::optional<double> scale = unit_factor(quantity, unit);
    if (!value || !scale)
      refuse(file, line_number,
             fmt::format("\"{}\" must be a number and a unit ({}), as in \"# length: 200 mm\"", text,
                         known_units(quantity)));
    if (quantity == Quantity::length && !(*value > 0))
      refuse(file, line_number, fmt::format("the coupon's {} is {}: it must be above 0", key, rest));
    *target = *value * *scale;
  }

  void read_row(const std::string& line, int line_number) {
    const std::vector<std::string> fields = split(line, separator);
    if (take_units(fields)) return;
    const bool surplus = std::any_of(fields.begin() + std::min(fields.size(), columns.size()), fields.end(),
                                     [](const std::string& field) { return !field.empty(); });
    if (fields.size() < columns.size() || surplus)
      refuse(file, line_number,
             fmt::format(
                 "{} values for {} columns: {}", fields.size(), columns.size(),
                 surplus ? "do the header's names and the values belong together?" : "is the file whole?"));
    const auto value = [&](int column) {
      const std::optional<double> v = number(fields[column], separator);
      if (!v || !std::isfinite(*v))
        refuse(file, line_number,
               fmt::format("\"{}\" in the column \"{}\" is not a finite number", fields[column].substr(0, 40),
                           columns[column].name));
      return *v;
    };
    record.displacement.push_back(value(displacement));
    record.force.push_back(value(force));
    if (time >= 0) record.time.push_back(value(time));
    record.line.push_back(line_number);
  }
};

void agree(const std::filesystem::path& file, double& own, double given, bool own_said, bool given_said,
           const char* what, const char* unit) {
  if (!given_said) return;
  if (own_said && std::abs(own - given) > 1e-6 * std::abs(given))
    refuse(file, 0,
           fmt::format("its own comments say {} {:.6g} {}, the file beside it says {:.6g} {}", what, own,
                       unit, given, unit));
  own = given;
}

}  // namespace

TensileRecord read_record(const std::filesystem::path& file, const Coupon& given,
                          const RecordFormat& format) {
  return parse_record(read_file(file), file, given, format);
}

TensileRecord parse_record(const std::string& bytes, const std::filesystem::path& file, const Coupon& given,
                           const RecordFormat& format) {
  if (bytes.size() > most_bytes) refuse(file, 0, "larger than 64 MiB: this is no tensile record");
  if (!bytes.empty() && bytes.back() != '\n' && bytes.back() != '\r')
    refuse(file, static_cast<int>(std::count(bytes.begin(), bytes.end(), '\n')) + 1,
           "the last line has no end: the record may be cut in mid-number; take the whole file, or end the "
           "line");
  Reader reader{file, format};
  reader.record.file = file;
  std::string_view rest = bytes;
  if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string line = trimmed(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (line.empty()) continue;
    if (line.front() == '#')
      reader.read_comment(line, line_number);
    else if (reader.columns.empty())
      reader.read_header(line, line_number);
    else
      reader.read_row(line, line_number);
  }
  TensileRecord& record = reader.record;
  if (reader.columns.empty()) refuse(file, 0, "empty: no header, no measurements");
  if (record.force.empty()) refuse(file, reader.header_line, "a header, but no measurements after it");
  Coupon& own = record.coupon;
  agree(file, own.length, given.length, own.length > 0, given.length > 0, "a length of", "m");
  agree(file, own.width, given.width, own.width > 0, given.width > 0, "a width of", "m");
  agree(file, own.orientation, given.orientation, own.orientation >= 0, given.orientation >= 0, "orientation",
        "deg");
  if (!(record.coupon.length > 0))
    refuse(file, 0, "no coupon length: write \"# length: 200 mm\" in it or length_m in the file beside it");

  const double force_factor =
      reader.factor(Quantity::force, reader.columns[reader.force], format.force_unit, "force_unit");
  for (double& f : record.force) f *= force_factor;
  const Column& x = reader.columns[reader.displacement];
  const double factor =
      reader.is_strain ? record.coupon.length * reader.factor(Quantity::fraction, x, format.displacement_unit,
                                                              "displacement_unit")
                       : reader.factor(Quantity::length, x, format.displacement_unit, "displacement_unit");
  for (double& d : record.displacement) d *= factor;
  if (!record.time.empty()) {
    const double scale = reader.columns[reader.time].unit.empty()
                             ? 1.0
                             : reader.factor(Quantity::time, reader.columns[reader.time], "", "time unit");
    for (double& t : record.time) t *= scale;
  }
  return record;
}

}  // namespace ripstop

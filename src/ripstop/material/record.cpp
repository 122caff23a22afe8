#include "ripstop/material/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "ripstop/core/error.h"
#include "ripstop/core/file.h"
#include "ripstop/core/table/number.h"
#include "ripstop/core/table/text.h"
#include "ripstop/core/units.h"

namespace ripstop::inline material {
namespace {

using table::Quantity;

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& reason) {
  throw Error(ExitCode::bad_data, line > 0 ? fmt::format("{}:{}: {}", file.string(), line, reason)
                                           : fmt::format("{}: {}", file.string(), reason));
}

/// "length: 200 mm"; other comments are left alone.
void read_comment(const table::Comment& comment, const std::filesystem::path& file, Coupon& coupon) {
  const std::size_t colon = comment.text.find_first_of(":=");
  if (colon == std::string::npos) return;
  const std::string key = table::folded(table::trimmed(comment.text.substr(0, colon)));
  const std::string rest = table::trimmed(comment.text.substr(colon + 1));
  double* target = key == "length" || key == "gauge length" ? &coupon.length
                   : key == "width"                         ? &coupon.width
                   : key == "orientation"                   ? &coupon.orientation
                                                            : nullptr;
  if (!target) return;
  const Dimension dimension = key == "orientation" ? Dimension::angle : Dimension::length;
  const std::size_t end = rest.find_first_not_of("0123456789.,+-eE");
  const std::string number = table::trimmed(rest.substr(0, end));
  const std::optional<double> value = table::number_of(number, number.find(',') < number.size() ? ',' : '.');
  const std::string unit = end == std::string::npos ? "" : table::trimmed(rest.substr(end));
  const std::optional<double> scale = unit_factor(dimension, unit);
  if (!value || !scale)
    refuse(file, comment.line,
           fmt::format("\"{}\" must be a number and a unit ({}), for example \"# length: 200 mm\"",
                       comment.text, known_units(dimension)));
  if (dimension == Dimension::length && !(*value > 0))
    refuse(file, comment.line, fmt::format("the coupon's {} is {}: it must be above 0", key, rest));
  *target = *value * *scale;
}

void agree(const std::filesystem::path& file, double& own, double given, bool own_said, bool given_said,
           const char* what, const char* unit) {
  if (!given_said) return;
  if (own_said && std::abs(own - given) > 1e-6 * std::abs(given))
    refuse(file, 0,
           fmt::format("the comments of the record give {} {:.6g} {}, the campaign file gives {:.6g} {}",
                       what, own, unit, given, unit));
  own = given;
}

Coupon coupon_of(const table::Table& table, const Coupon& given) {
  Coupon own;
  const std::filesystem::path& file = table.file;
  for (const table::Comment& comment : table.comments) read_comment(comment, file, own);
  agree(file, own.length, given.length, own.length > 0, given.length > 0, "a length of", "m");
  agree(file, own.width, given.width, own.width > 0, given.width > 0, "a width of", "m");
  agree(file, own.orientation, given.orientation, own.orientation >= 0, given.orientation >= 0, "orientation",
        "deg");
  if (!(own.length > 0))
    refuse(file, 0, "no coupon length: write \"# length: 200 mm\" in it or length_m in the campaign file");
  return own;
}

table::Format format_of(const RecordFormat& given) {
  table::Format format;
  format.wanted = {Quantity::force, Quantity::extension, Quantity::strain, Quantity::time};
  format.columns = given.columns;
  format.decimal = given.decimal;
  for (const auto& [quantity, column, unit] :
       {std::tuple{Quantity::force, &given.force_column, &given.force_unit},
        std::tuple{Quantity::extension, &given.displacement_column, &given.displacement_unit}}) {
    if (column->empty() && unit->empty()) continue;
    std::erase_if(format.columns, [&](const table::ColumnChoice& choice) {
      return choice.quantity == quantity ||
             (quantity == Quantity::extension && choice.quantity == Quantity::strain);
    });
    format.columns.push_back({quantity, *column, *unit});
  }
  return format;
}

TensileRecord record_of(const table::Table& table, const table::Specimen& specimen, const Coupon& coupon) {
  TensileRecord record;
  record.file = table.file;
  record.specimen = specimen.name;
  record.coupon = coupon;
  const table::Column* force = find_only(table, specimen, Quantity::force);
  if (!force) refuse_missing(table, specimen, "force");
  const table::Column* way = find_only(table, specimen, Quantity::extension);
  if (!way) way = find_only(table, specimen, Quantity::strain);
  if (!way) refuse_missing(table, specimen, "extension");
  const table::Column* time = find_only(table, specimen, Quantity::time);
  const double factor = way->quantity == Quantity::strain ? coupon.length : 1.0;
  for (std::size_t i = 0; i < specimen.lines.size(); ++i) {
    if (std::isnan(force->values[i]) && std::isnan(way->values[i])) continue;  // only the time increases
    for (const table::Column* column : {force, way, time})
      if (column && std::isnan(column->values[i])) need_values(table, specimen, *column);
    record.force.push_back(force->values[i]);
    record.displacement.push_back(factor * way->values[i]);
    if (time) record.time.push_back(time->values[i]);
    record.line.push_back(specimen.lines[i]);
  }
  if (record.force.empty())
    refuse(table.file, specimen.header_line, "a header, but no measurements below it");
  table::Table used{table.file, {}, {}, '.', {}, {{specimen.name, 0, {*way, *force}, specimen.lines}},
                    table.notes};
  if (time) used.specimens.front().columns.push_back(*time);
  record.understood = explanation(used);
  return record;
}

}  // namespace

std::string TensileRecord::name() const {
  const std::string name = file.filename().string();
  return specimen.empty() ? name : fmt::format("{} ({})", name, specimen);
}

std::vector<TensileRecord> read_records(const std::filesystem::path& file, const Coupon& given,
                                        const RecordFormat& format) {
  return parse_records(read_file(file), file, given, format);
}

std::vector<TensileRecord> parse_records(const std::string& text, const std::filesystem::path& file,
                                         const Coupon& given, const RecordFormat& format) {
  const table::Table table = table::parse_table(text, file, format_of(format));
  const Coupon coupon = coupon_of(table, given);
  std::vector<TensileRecord> records;
  for (const table::Specimen& specimen : table.specimens)
    records.push_back(record_of(table, specimen, coupon));
  return records;
}

TensileRecord read_record(const std::filesystem::path& file, const Coupon& given,
                          const RecordFormat& format) {
  return parse_record(read_file(file), file, given, format);
}

TensileRecord parse_record(const std::string& text, const std::filesystem::path& file, const Coupon& given,
                           const RecordFormat& format) {
  std::vector<TensileRecord> records = parse_records(text, file, given, format);
  if (records.size() > 1)
    refuse(file, records[1].line.front(),
           fmt::format("{} specimens in one file, where one is expected", records.size()));
  return std::move(records.front());
}

}  // namespace ripstop::inline material

#include "ripstop/parachute/scale.h"

#include <cmath>
#include <optional>
#include <variant>

#include "ripstop/core/toml/fields.h"

namespace ripstop::inline parachute {
namespace {

/// To a tenth of a millimetre; small lengths to five digits, so that a small parachute keeps its proportions.
double rounded(double length) {
  const double parts = length < 0.1 ? 1e6 : length < 1 ? 1e5 : 1e4;  // of a metre
  return std::round(length * parts) / parts;
}

/// Calls `each` with every length of the design, its key and its range.
template <class Each>
void visit_lengths(const Fields& fields, const std::string& table, const Each& each) {
  for (const Field& field : fields.list()) {
    const std::string key = table + field.key;
    if (const auto* kind = std::get_if<Kind>(&field.value))
      visit_lengths(kind->select(kind->get()), table, each);
    if (const auto* sub = std::get_if<Subtable>(&field.value); sub && field.key != "mesh")
      visit_lengths(sub->fields(), key + ".", each);
    if (const auto* rows = std::get_if<Rows>(&field.value))
      for (std::size_t i = 0; i < rows->count(); ++i) visit_lengths(rows->row(i), key + ".", each);
    if (!field.key.ends_with("_m")) continue;
    if (const auto* value = std::get_if<double*>(&field.value)) each(**value, key, field.range, true);
    if (const auto* value = std::get_if<std::optional<double>*>(&field.value); value && **value)
      each(***value, key, field.range, true);
    if (const auto* list = std::get_if<NumberList>(&field.value))
      for (double& value : *list->value) each(value, key, field.range, false);
  }
}

}  // namespace

void scale_lengths(Design& design, double factor, Rounded round) {
  Fields fields;
  describe(fields, design);
  visit_lengths(fields, "", [&](double& value, const std::string&, const Range&, bool single) {
    value *= factor;
    if (single && round == Rounded::yes) value = rounded(value);
  });
}

ScaleLimits scale_limits(Design design) {
  ScaleLimits limits;
  Fields fields;
  describe(fields, design);
  visit_lengths(fields, "", [&](double value, const std::string& key, const Range& range, bool) {
    if (!(value > 0)) return;
    if (range.high / value < limits.high)
      limits.high = range.high / value, limits.high_key = key, limits.high_value = range.high;
    if (range.low / value > limits.low)
      limits.low = range.low / value, limits.low_key = key, limits.low_value = range.low;
  });
  return limits;
}

Design in_size(const Design& design, double ratio) {
  if (ratio == 1) return design;
  Design other = design;
  scale_lengths(other, ratio, Rounded::no);
  other.mesh.line_segment_m *= ratio;
  if (other.nominal_area_m2) *other.nominal_area_m2 *= ratio * ratio;
  return other;
}

}  // namespace ripstop::inline parachute

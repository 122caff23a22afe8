// A number with a unit as people type it: "5 lb", "1.2 oz/yd^2", "20 ft/s".
#pragma once

#include <string>

namespace ripstop {

/// The unit that the name of a key ends with: "m" of "length_m", "kg/m2" of "areal_density_kg_m2". Empty when the name
/// has none.
std::string unit_of_key(const std::string& key);

struct TypedNumber {
  double value = 0;
  std::string refusal;    // why the text is none, as the end of "must be ..."; empty: it is one
  bool has_unit = false;  // of its own
};

/// The value of "5 lb" in `unit` (as of unit_of_key(); empty: only a percentage has a unit). A text without a unit is
/// in `unit`. Upper and lower case of a unit matter only where they change its meaning.
TypedNumber read_typed(const std::string& text, const std::string& unit);

}  // namespace ripstop

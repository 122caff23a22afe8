// The meaning of a column heading: quantity and unit, in six languages.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ripstop/core/units.h"

namespace ripstop::table {

enum class Quantity {
  other,
  specimen,  // name or number of the specimen that a row belongs to
  force,
  extension,
  strain,
  stress,
  time,
  altitude,
  speed,
  acceleration,
  pressure,
  drag,
  density,
};

/// "force"; the words that users write.
std::string name_of(Quantity quantity);
std::optional<Quantity> quantity_named(std::string_view name);
std::string quantity_names();
Dimension dimension_of(Quantity quantity);

/// A clock time in the heading or in the row of units: "Time (mm:ss)".
enum class ClockForm { none, hours_minutes_seconds, hours_minutes, minutes_seconds };

struct Heading {
  std::string text;                // as in the file
  std::string name;                // without its unit
  std::string unit;                // empty: none that is known
  std::string other_unit;          // a second unit in parentheses or brackets
  std::string odd;                 // in parentheses or brackets, and not a known unit
  std::vector<Quantity> meanings;  // by its words; the first that fits the unit counts
  bool weak = false;               // its words also mean other things: it counts only with a unit that fits
  ClockForm clock = ClockForm::none;
};

Heading read_heading(const std::string& text);
/// False: a heading with these words (words_of) has no meaning. Fast, for all the cells that are no headings.
bool may_have_meaning(std::string_view words);
/// The text of a unit without its parentheses or brackets.
std::string bare_unit(const std::string& text);
ClockForm clock_form(const std::string& unit);

/// The meaning that a column in this unit has; other: none of them.
Quantity meaning_in(const Heading& heading, const std::string& unit);

}  // namespace ripstop::table

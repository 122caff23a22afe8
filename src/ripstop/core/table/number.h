// Numbers as machines write them: decimal mark, digits grouped in threes, clock times.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace ripstop::table {

/// The marks in one cell.
enum class NumberForm {
  not_a_number,
  wrong_groups,    // digits and marks, but not in groups of three: "12,34,567.8"
  small_integer,   // up to three digits
  integer,         // four digits or more without groups, or groups by blanks or apostrophes
  point_decimal,   // surely: "0.5", "12.34", "1013.250", "1,016.5", "1,234,567"
  comma_decimal,   // surely
  point_or_group,  // "1.016": one to three digits, the mark, three digits
  comma_or_group,  // "1,016"
};

/// `text` has no blanks at its ends.
NumberForm form_of(std::string_view text);

/// The value with this decimal mark ('.' or ','); the other mark, blanks and apostrophes group digits. Empty: not a
/// finite
/// number, or digits are not grouped in threes.
std::optional<double> number_of(std::string_view text, char decimal);

/// A time of day or a duration, with or without a date before it.
struct ClockTime {
  double seconds = 0;  // "10:15:03.5" -> 36903.5
  int parts = 3;       // 2: "10:15", hours and minutes or minutes and seconds; `seconds` is of the latter
  bool has_fraction = false;  // of the last part
  bool has_day = false;       // a date whose day is known
  int day = 0;                // days since 1 January 1970
  std::string other_date;     // with ambiguous order of day and month
};
std::optional<ClockTime> clock_of(std::string_view text);

}  // namespace ripstop::table

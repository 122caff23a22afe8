// Formulas over named numbers, as files of other programs hold them: "2 * pi * radius / math::cos(angle)".
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ripstop {

struct Evaluation {
  double value = 0;
  std::vector<std::string> notes;  // notes on results that the author of the formula may not have intended
};

/// The language of the Rust crate evalexpr, as far as it makes numbers out of numbers: + - * / % ^ and brackets; min,
/// max, floor, ceil, round; sin, asin, sinh, sqrt, hypot, atan2 and their kin as `math::name`. Precedence falls from
/// ^ over the sign and * / % to + -; equals are taken from the left, ^ too (2^3^2 = 64). A literal without point or
/// exponent is an integer, and so is the result of integers: 1/2 = 0, which is noted. Throws Error(bad_data) whose
/// message begins with the place ("character 7: ...") for unreadable text, an unknown name, a division by zero and a
/// function without a value.
Evaluation evaluate(std::string_view formula, const std::map<std::string, double>& names);

/// The names of numbers that the formula refers to, in order; functions left out.
std::vector<std::string> names_in(std::string_view formula);

}  // namespace ripstop

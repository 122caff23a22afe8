// Keys of cases, tables and results as words and a unit, for people to read.
#pragma once

#include <string>
#include <utility>

namespace ripstop {

struct Wording {
  std::string text;  // "highest line tension"
  std::string unit;  // "N"; empty: a plain number or no number at all

  /// "highest line tension [N]"
  std::string with_unit() const { return unit.empty() ? text : text + " [" + unit + "]"; }
};

/// Of a key such as "max_line_tension_n", or the full name of one, "flow.speed_m_s".
Wording in_words(const std::string& key);
/// A key and its value: "linear cloth", "vent diameter 0.09 m", "cells [50,50,75]".
std::string in_words(const std::string& key, const std::string& value);
/// Rounded to `digits` significant digits, without an exponent below 1e15: "10680" for 10676.3.
std::string rounded(double value, int digits = 4);
/// Both values rounded to `digits` significant digits, or to more if they would look equal although they differ: 9.97 and
/// 10 with 2 digits are "9.97" and "10". For messages that compare a value with its limit.
std::pair<std::string, std::string> rounded_apart(double value, double limit, int digits = 3);

}  // namespace ripstop

#include "ripstop/core/quantity.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "ripstop/core/units.h"

namespace ripstop {
namespace {

/// Exponents of length, mass, time and angle.
using Powers = std::array<int, 4>;

struct Factor {
  double value = 1;
  Powers powers{};
};

Powers powers_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::force:
      return {1, 1, -2, 0};
    case Dimension::length:
      return {1, 0, 0, 0};
    case Dimension::time:
      return {0, 0, 1, 0};
    case Dimension::angle:
      return {0, 0, 0, 1};
    case Dimension::fraction:
      return {};
    case Dimension::speed:
      return {1, 0, -1, 0};
    case Dimension::acceleration:
      return {1, 0, -2, 0};
    case Dimension::pressure:
      return {-1, 1, -2, 0};
    case Dimension::density:
      return {-3, 1, 0, 0};
    case Dimension::mass:
      return {0, 1, 0, 0};
    case Dimension::frequency:
      return {0, 0, -1, 0};
  }
  return {};
}

/// Meanings of a unit: "lb" is a mass or a force, "g" a mass or an acceleration.
std::vector<Factor> meanings(const std::string& unit) {
  std::vector<Factor> found;
  if (unit == "cfm" || unit == "CFM") found.push_back({cfm_per_square_foot, powers_of(Dimension::speed)});
  for (int i = 0; i <= static_cast<int>(last_dimension); ++i) {
    const auto dimension = static_cast<Dimension>(i);
    if (const std::optional<double> factor = unit_factor(dimension, unit))
      found.push_back({*factor, powers_of(dimension)});
  }
  return found;
}

std::vector<Factor> product(const std::vector<Factor>& left, const std::vector<Factor>& right, int power) {
  std::vector<Factor> all;
  for (const Factor& a : left)
    for (const Factor& b : right) {
      Factor both{a.value * std::pow(b.value, power), a.powers};
      for (std::size_t i = 0; i < both.powers.size(); ++i) both.powers[i] += power * b.powers[i];
      all.push_back(both);
    }
  return all;
}

/// "oz/yd2", "N s/m", "1/m": names with powers, parted by blanks and slashes. A unit after a slash and a blank could
/// be in the numerator or the denominator, so it is refused.
std::vector<Factor> parsed_unit(const std::string& text) {
  if (std::vector<Factor> whole = meanings(text); !whole.empty()) return whole;
  std::vector<Factor> all{Factor{}};
  const std::string plain = plain_unit(text);
  bool below = false;
  for (std::size_t at = 0; at < plain.size();) {
    const std::size_t end = std::min(plain.find_first_of(" /", at), plain.size());
    std::string name = plain.substr(at, end - at);
    const std::size_t digits = name.find_first_of("-0123456789");
    int power = 1;
    if (digits != std::string::npos && digits > 0) {
      const char* last = name.data() + name.size();
      const auto [stop, error] = std::from_chars(name.data() + digits, last, power);
      if (error != std::errc() || stop != last || std::abs(power) > 9) return {};
      name.resize(digits);
    }
    if (name != "1") all = product(all, meanings(name), below ? -power : power);
    if (end < plain.size()) {
      if (below && plain[end] == ' ') return {};
      below = below || plain[end] == '/';
    }
    at = end + 1;
  }
  return all;
}

/// Degrees of a scale whose zero is elsewhere, as kelvin.
std::optional<double> kelvin_of(double value, const std::string& unit) {
  const std::string plain = plain_unit(unit);
  for (const char* name : {"C", "degC", "deg C", "°C"})
    if (plain == name) return value + 273.15;
  for (const char* name : {"F", "degF", "deg F", "°F"})
    if (plain == name) return (value - 32) / 1.8 + 273.15;
  if (plain == "K" || plain == "kelvin") return value;
  return {};
}

}  // namespace

std::string unit_of_key(const std::string& key) {
  // The longest first, as "_m" ends "_kg_m" too.
  constexpr std::array<std::pair<std::string_view, const char*>, 26> units{{{"_pa_s2_m2", "Pa s2/m2"},
                                                                            {"_n_s2_m4", "N s2/m4"},
                                                                            {"_pa_s_m", "Pa s/m"},
                                                                            {"_n_s_m3", "N s/m3"},
                                                                            {"_n_s_m", "N s/m"},
                                                                            {"_n_s", "N s"},
                                                                            {"_kg_m3", "kg/m3"},
                                                                            {"_deg_s", "deg/s"},
                                                                            {"_per_s", "1/s"},
                                                                            {"_kg_m2", "kg/m2"},
                                                                            {"_kg_m", "kg/m"},
                                                                            {"_pa_s", "Pa s"},
                                                                            {"_1_m2", "1/m2"},
                                                                            {"_1_m", "1/m"},
                                                                            {"_m_s2", "m/s2"},
                                                                            {"_m_s", "m/s"},
                                                                            {"_n_m", "N/m"},
                                                                            {"_cfm", "cfm"},
                                                                            {"_deg", "deg"},
                                                                            {"_m2", "m2"},
                                                                            {"_hz", "Hz"},
                                                                            {"_kg", "kg"},
                                                                            {"_pa", "Pa"},
                                                                            {"_m", "m"},
                                                                            {"_n", "N"},
                                                                            {"_s", "s"}}};
  const std::string name = key.substr(0, key.find('['));
  if (name.ends_with("_k")) return "K";
  for (const auto& [suffix, unit] : units)
    if (name.ends_with(suffix)) return unit;
  return "";
}

TypedNumber read_typed(const std::string& text, const std::string& unit) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  const char* const last = text.data() + text.size();
  const char* first = text.data() + begin + (text.substr(begin).starts_with('+') ? 1 : 0);
  double value = 0;
  const auto [stop, error] = std::from_chars(first, last, value);
  const bool number = error == std::errc() && !(first > text.data() + begin && *first == '-');
  if (error == std::errc::result_out_of_range || (number && !std::isfinite(value)))
    return {0, "a finite number", false};
  if (!number) return {0, "a number", false};
  const std::string typed = plain_unit(std::string(stop, last));
  if (typed.empty()) return {value, "", false};
  if (unit == "K") {
    if (const std::optional<double> kelvin = kelvin_of(value, typed)) return {*kelvin, "", true};
    return {0, "a number, or a temperature in K, degC or degF", true};
  }
  const std::vector<Factor> wanted = unit.empty() ? std::vector<Factor>{Factor{}} : parsed_unit(unit);
  for (const Factor& target : wanted)
    for (const Factor& given : parsed_unit(typed))
      if (given.powers == target.powers) return {value * given.value / target.value, "", true};
  if (unit.empty()) return {0, "a number without a unit, or a percentage", true};
  return {0, fmt::format("a number, or one with a unit that can be converted to {}", unit), true};
}

}  // namespace ripstop

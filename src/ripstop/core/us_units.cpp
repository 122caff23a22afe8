#include "ripstop/core/us_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "ripstop/core/units.h"
#include "ripstop/core/words.h"

namespace ripstop {
namespace {

struct UsUnit {
  const char* si;
  const char* name;
  double factor;  // SI per unit
};
constexpr double small_length = 1;  // below it lengths are in inches [m]
constexpr std::array<UsUnit, 14> us_units{{
    {"m", "ft", foot},
    {"mm", "in", 1e3 * inch},
    {"m/s", "ft/s", foot},
    {"m2", "ft2", foot* foot},
    {"m3", "in3", inch* inch* inch},
    {"litres", "in3", 1e3 * inch* inch* inch},
    {"kg", "lb", pound},
    {"N", "lbf", pound_force},
    {"N/m", "lbf/in", pound_force / inch},
    {"g/m", "lb/1000 ft", 1e3 * pound / (1000 * foot)},
    {"J", "ft lbf", foot* pound_force},
    {"Pa", "psi", pound_force / (inch * inch)},
    {"kg/m2", "oz/yd2", ounce_per_square_yard},
    {"kg/m3", "lb/ft3", pound / (foot * foot * foot)},
}};

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '/';
}

/// A number as it is printed.
struct Printed {
  double value = 0;
  int digits = 0;
};

/// Length of the number that `text` begins with; 0: none.
std::size_t number_length(std::string_view text, Printed& number) {
  std::size_t i = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t first = i;
  bool leading = true;
  number.digits = 0;
  for (; i < text.size() && (std::isdigit(static_cast<unsigned char>(text[i])) || text[i] == '.'); ++i) {
    if (text[i] == '.') continue;
    leading = leading && text[i] == '0';
    number.digits += !leading;
  }
  if (i == first || text[i - 1] == '.') return 0;
  if (i + 1 < text.size() && text[i] == 'e' && (text[i + 1] == '-' || text[i + 1] == '+'))
    for (i += 2; i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));) ++i;
  number.value = std::strtod(std::string(text.substr(0, i)).c_str(), nullptr);
  return i;
}

/// The unit that `text` begins with; null: none.
const UsUnit* unit_at(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size() && is_word(text[length])) ++length;
  const auto found = std::find_if(us_units.begin(), us_units.end(),
                                  [&](const UsUnit& u) { return u.si == text.substr(0, length); });
  return found == us_units.end() ? nullptr : &*found;
}

double converted(const Printed& number, const UsUnit& unit, bool in_inches) {
  return number.value / (in_inches ? inch : unit.factor);
}

std::string shown(const Printed& number, const UsUnit& unit, bool in_inches) {
  return rounded(converted(number, unit, in_inches), std::max(3, number.digits));
}

/// An uncertainty has the decimals of its value, or one digit if that would be 0.
std::string shown_error(const Printed& error, const std::string& value, const UsUnit& unit, bool in_inches) {
  const double size = converted(error, unit, in_inches);
  const std::size_t point = value.find('.');
  const auto decimals = point == std::string::npos ? 0 : value.size() - point - 1;
  const std::string text = fmt::format("{:.{}f}", size, decimals);
  return text.find_first_of("123456789") == std::string::npos ? rounded(size, 1) : text;
}

}  // namespace

std::string with_us_units(const std::string& text) {
  const std::string_view all = text;
  std::string result;
  std::size_t i = 0;
  while (i < all.size()) {
    Printed first, second;
    const bool begins = i == 0 || !(is_word(all[i - 1]) || all[i - 1] == '.' || all[i - 1] == '-');
    std::size_t length = begins ? number_length(all.substr(i), first) : 0;
    if (length == 0) {
      result += all[i++];
      continue;
    }
    std::string_view between;
    for (const std::string_view word : {" to ", " +- "}) {
      const std::size_t after = i + length;
      if (all.substr(after, word.size()) != word) continue;
      const std::size_t more = number_length(all.substr(after + word.size()), second);
      if (more == 0) continue;
      between = word, length += word.size() + more;
      break;
    }
    result += all.substr(i, length);
    i += length;
    const UsUnit* unit = i < all.size() && all[i] == ' ' ? unit_at(all.substr(i + 1)) : nullptr;
    if (!unit) continue;
    const std::string_view si = unit->si;
    const double largest = std::max(std::abs(first.value), std::abs(second.value));
    const bool inches = si == "m" && largest > 0 && largest < small_length;
    if (between == " to ") first.digits = second.digits = std::max(first.digits, second.digits);
    const std::string value = shown(first, *unit, inches);
    const std::string other = between.empty()     ? ""
                              : between == " to " ? shown(second, *unit, inches)
                                                  : shown_error(second, value, *unit, inches);
    result += fmt::format(" {} ({}{}{} {})", si, value, between, other, inches ? "in" : unit->name);
    i += 1 + si.size();
  }
  return result;
}

}  // namespace ripstop

#include "ripstop/core/units.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace ripstop {
namespace {

struct KnownUnit {
  double factor;
  std::vector<std::string_view> names;  // the first is the one that is printed
};
using Units = std::vector<KnownUnit>;

const Units& units_of(Dimension dimension) {
  static const std::array<Units, static_cast<std::size_t>(last_dimension) + 1> table{
      Units{{1, {"N", "newton", "newtons"}},
            {1e3, {"kN"}},
            {1e-3, {"mN"}},
            {1e-2, {"cN"}},
            {10, {"daN"}},
            {1e6, {"MN"}},
            {pound_force, {"lbf", "lb", "lbs"}},
            {standard_gravity, {"kgf", "kp"}},
            {1e-3 * standard_gravity, {"gf"}}},
      Units{{1, {"m", "metre", "metres", "meter", "meters"}},
            {1e-3, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"}},
            {1e-2, {"cm"}},
            {1e-6, {"um"}},
            {1e3, {"km"}},
            {inch, {"in", "inch", "inches"}},
            {foot, {"ft", "feet"}},
            {3 * foot, {"yd", "yard", "yards"}}},
      Units{{1, {"s", "sec", "secs", "second", "seconds", "Sekunden"}},
            {1e-3, {"ms"}},
            {60, {"min", "mins", "minutes"}},
            {3600, {"h", "hr", "hours"}}},
      Units{{1, {"deg", "degrees", "°"}}, {57.29577951308232, {"rad"}}},
      Units{{0.01, {"%", "percent"}}, {1, {"-", "1"}}, {1, {"mm/mm", "m/m", "in/in"}}},
      Units{{1, {"m/s", "m s-1", "m.s-1", "mps"}},
            {1e-3, {"mm/s"}},
            {1e-3 / 60, {"mm/min"}},
            {foot, {"ft/s", "fps"}},
            {1 / 3.6, {"km/h", "kph", "kmh"}},
            {0.44704, {"mph"}},
            {1852.0 / 3600, {"kn", "kt", "kts", "knots"}}},
      Units{{1, {"m/s2", "m/s/s", "m s-2", "m.s-2"}}, {standard_gravity, {"g"}}, {foot, {"ft/s2"}}},
      Units{{1, {"Pa"}},
            {100, {"hPa"}},
            {1e3, {"kPa"}},
            {100, {"mbar"}},
            {1e5, {"bar"}},
            {1e6, {"MPa", "N/mm2"}},
            {1e9, {"GPa"}},
            {1e-3, {"mPa"}},
            {pound_force / (inch * inch), {"psi"}}},
      Units{{1, {"kg/m3", "kg m-3", "kg.m-3"}}, {1e3, {"g/cm3"}}},
      Units{{1, {"kg", "kilogram", "kilograms"}},
            {1e-3, {"g", "gram", "grams"}},
            {1e-6, {"mg"}},
            {1e3, {"t", "tonne", "tonnes", "Mg"}},
            {pound, {"lb", "lbs", "lbm", "pound", "pounds"}},
            {pound / 16, {"oz", "ounce", "ounces"}}},
      Units{{1, {"Hz"}}, {1e3, {"kHz"}}}};
  return table[static_cast<std::size_t>(dimension)];
}

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

/// The unit with that name, in the spelling of plain_unit().
std::optional<Unit> find_plain_unit(Dimension dimension, std::string_view wanted) {
  const KnownUnit* found = nullptr;
  bool several = false;
  for (const KnownUnit& known : units_of(dimension))
    for (const std::string_view name : known.names) {
      if (wanted == name) return Unit{std::string(known.names.front()), known.factor};
      // "MM", "n", "LBF": machines shout. Where this leaves a choice (MN, mN) only the exact spelling is known.
      if (!same_letters(wanted, name)) continue;
      several = several || (found && found != &known);
      found = &known;
    }
  if (!found || several) return {};
  return Unit{std::string(found->names.front()), found->factor};
}

bool is_plain_foreign_unit(std::string_view plain) {
  if (find_plain_unit(Dimension::angle, plain)) return true;
  constexpr std::array<std::string_view, 13> names{"V", "mV", "kV", "A",    "mA",    "Ohm", "Ω",
                                                   "Ω", "°C", "°F", "degC", "deg C", "degF"};
  return std::find(names.begin(), names.end(), plain) != names.end();
}

}  // namespace

std::string plain_unit(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 15> spellings{{{"²", "2"},
                                                                                     {"³", "3"},
                                                                                     {"¹", "1"},
                                                                                     {"⁻", "-"},
                                                                                     {"−", "-"},
                                                                                     {"µ", "u"},
                                                                                     {"μ", "u"},
                                                                                     {"·", " "},
                                                                                     {"⋅", " "},
                                                                                     {"^", ""},
                                                                                     {"_per_", "/"},
                                                                                     {" per ", "/"},
                                                                                     {" /", "/"},
                                                                                     {"/ ", "/"},
                                                                                     {"**", ""}}};
  const bool plain =
      text.find(" per ") == std::string::npos && std::all_of(text.begin(), text.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x80 && c != '^' && c != '_' && c != '/' && c != '*';
      });
  for (const auto& [from, to] : spellings)
    for (std::size_t at = 0; !plain && (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

std::optional<Unit> find_unit(Dimension dimension, const std::string& text) {
  return find_plain_unit(dimension, plain_unit(text));
}

std::optional<double> unit_factor(Dimension dimension, const std::string& text) {
  const std::optional<Unit> unit = find_unit(dimension, text);
  if (!unit) return {};
  return unit->factor;
}

bool is_foreign_unit(const std::string& text) {
  return is_plain_foreign_unit(plain_unit(text));
}

bool is_unit(const std::string& text) {
  const std::string plain = plain_unit(text);
  if (is_plain_foreign_unit(plain)) return true;
  for (int i = 0; i <= static_cast<int>(Dimension::density); ++i)
    if (find_plain_unit(static_cast<Dimension>(i), plain)) return true;
  return false;
}

std::string si_unit(Dimension dimension) {
  constexpr std::array<const char*, static_cast<std::size_t>(last_dimension) + 1> units = {
      "N", "m", "s", "deg", "", "m/s", "m/s2", "Pa", "kg/m3", "kg", "Hz"};
  return units.at(static_cast<std::size_t>(dimension));
}

std::string known_units(Dimension dimension) {
  std::string list;
  for (const KnownUnit& unit : units_of(dimension))
    list += (list.empty() ? "" : ", ") + std::string(unit.names.front());
  return list;
}

}  // namespace ripstop

#include "ripstop/material/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

namespace ripstop {
namespace {

struct Unit {
  const char* name;
  double factor;
};

const std::vector<Unit>& units_of(Quantity quantity) {
  static const std::map<Quantity, std::vector<Unit>> table{
      {Quantity::force,
       {{"N", 1},
        {"kN", 1e3},
        {"mN", 1e-3},
        {"cN", 1e-2},
        {"daN", 10},
        {"lbf", pound_force},
        {"lb", pound_force},
        {"lbs", pound_force},
        {"kgf", 9.80665},
        {"gf", 9.80665e-3}}},
      {Quantity::length,
       {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}, {"in", inch}, {"inch", inch}, {"ft", 0.3048}}},
      {Quantity::time, {{"s", 1}, {"sec", 1}, {"ms", 1e-3}, {"min", 60}}},
      {Quantity::angle, {{"deg", 1}, {"degrees", 1}, {"\xc2\xb0", 1}, {"rad", 57.29577951308232}}},
      {Quantity::fraction, {{"1", 1}, {"-", 1}, {"%", 0.01}, {"percent", 0.01}, {"mm/mm", 1}, {"m/m", 1}}}};
  return table.at(quantity);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

std::optional<double> unit_factor(Quantity quantity, const std::string& unit) {
  for (const Unit& known : units_of(quantity))
    if (unit == known.name) return known.factor;
  // "MM", "n", "LBF": benches shout. Newtons and millinewtons are told apart above, before case is dropped.
  for (const Unit& known : units_of(quantity))
    if (lower(unit) == lower(known.name)) return known.factor;
  return {};
}

std::string known_units(Quantity quantity) {
  std::string list;
  for (const Unit& unit : units_of(quantity)) list += (list.empty() ? "" : ", ") + std::string(unit.name);
  return list;
}

}  // namespace ripstop

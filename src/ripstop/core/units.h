// Units that testing machines, loggers and data sheets use, by name.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ripstop {

enum class Dimension {
  force,
  length,
  time,
  angle,
  fraction,
  speed,
  acceleration,
  pressure,
  density,
  mass,
  frequency
};
inline constexpr Dimension last_dimension = Dimension::frequency;

struct Unit {
  std::string name;   // the first of its spellings: "lbf" of "lbs"
  double factor = 1;  // to SI; deg for angles
};

/// "kN" -> {"kN", 1000} for a force. Spellings such as "m/s²", "m/s^2" and "LBF" are known too. Empty when the text is
/// not a unit of this dimension, or when its upper and lower case leave a choice ("Mn").
std::optional<Unit> find_unit(Dimension dimension, const std::string& text);
std::optional<double> unit_factor(Dimension dimension, const std::string& text);
/// The unit of values in SI: "N"; empty for a fraction.
std::string si_unit(Dimension dimension);
/// Volts, amperes, ohms, degrees: a column in these is not a quantity that Ripstop reads.
bool is_foreign_unit(const std::string& text);
/// Any of the above.
bool is_unit(const std::string& text);
/// The units known for it, for messages.
std::string known_units(Dimension dimension);
/// "m / s²", "m_per_s^2" -> "m/s2", as the list of units spells it.
std::string plain_unit(std::string text);

inline constexpr double pound_force = 4.4482216152605;            // [N]
inline constexpr double pound = 0.45359237;                       // [kg]
inline constexpr double inch = 0.0254;                            // [m]
inline constexpr double foot = 0.3048;                            // [m]
inline constexpr double standard_gravity = 9.80665;               // [m/s2]
inline constexpr double ounce_per_square_yard = 0.0339057474748;  // [kg/m2]
inline constexpr double cfm_per_square_foot = 5.08e-3;            // [m/s]
inline constexpr double half_inch_of_water = 124.5;               // [Pa]

}  // namespace ripstop

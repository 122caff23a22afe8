// Units that tensile benches, permeability testers and data sheets use, by name.
#pragma once

#include <optional>
#include <string>

namespace ripstop {

enum class Quantity { force, length, time, angle, fraction };

/// Factor to SI (deg for angles): "kN" -> 1000 for a force. Empty when the unit is not one of this quantity.
std::optional<double> unit_factor(Quantity quantity, const std::string& unit);
/// The units known for it, for messages.
std::string known_units(Quantity quantity);

inline constexpr double pound_force = 4.4482216152605;            // [N]
inline constexpr double inch = 0.0254;                            // [m]
inline constexpr double ounce_per_square_yard = 0.0339057474748;  // [kg/m2]
inline constexpr double cfm_per_square_foot = 5.08e-3;            // [m/s]
inline constexpr double half_inch_of_water = 124.5;               // [Pa]

}  // namespace ripstop

// Handbook data of the filling of a family.
#pragma once

#include <string>

namespace ripstop::inline run {

struct KnownFilling {
  double constant = 0;         // n: filling distance over nominal diameter, t_f = n D_0 / v
  double exponent = 0;         // of the drag area over time, for Pflanz's figure and the trajectory
  double ludtke_exponent = 0;  // the same in Ludtke's fits of tunnel records
  const char* source = "";
};

/// c of t_f = c D_0 / v^0.85 in feet and seconds below 150 ft/s, for a family with this n above it.
double slow_filling_coefficient(double constant);
/// n at a speed at line stretch [m/s]. Knacke's constants are those from 150 to 500 ft/s. Below, solid flat circular
/// canopies (n = 8) have t_f = 4.0 D_0 / v^0.85 in feet and seconds, that is n = 4.0 v^0.15; the constants of other
/// families are in proportion (assumed).
double filling_constant_at(double constant, double speed);

/// Relative standard deviation of a filling time by these constants (assumed).
inline constexpr double filling_time_scatter = 1.0 / 3;

/// By the family's word in [parachute] type. A word that is not in the tables
/// gets the values of a solid canopy, with that source.
KnownFilling known_filling(const std::string& type);

}  // namespace ripstop::inline run

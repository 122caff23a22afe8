// Handbook data of the filling of a family.
#pragma once

#include <string>

namespace ripstop {

struct KnownFilling {
  double constant = 0;         // n: filling distance over nominal diameter, t_f = n D_0 / v
  double exponent = 0;         // of the drag area over time, for Pflanz's figure and the trajectory
  double ludtke_exponent = 0;  // the same in Ludtke's fits of tunnel records
  const char* source = "";
};

/// By the word of the family in [parachute] type; a family without data gets the values of a solid canopy,
/// and its source states this.
KnownFilling known_filling(const std::string& type);

}  // namespace ripstop

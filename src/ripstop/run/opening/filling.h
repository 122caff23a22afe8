// What handbooks say of how a family fills.
#pragma once

#include <string>

namespace ripstop {

struct KnownFilling {
  double constant = 0;         // n: filling distance over nominal diameter, t_f = n D_0 / v
  double exponent = 0;         // of the drag area over time, for Pflanz's figure and the trajectory
  double ludtke_exponent = 0;  // the same in Ludtke's fits of tunnel records
  const char* source = "";
};

/// By the family's word in [parachute] type; a word that is not in the tables
/// gets a solid canopy's values and says so.
KnownFilling known_filling(const std::string& type);

}  // namespace ripstop

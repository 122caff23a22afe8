// The opening load by one method.
#pragma once

#include <string>

#include "ripstop/core/members.h"

namespace ripstop {

/// Names of the two methods that are not finite-mass estimates of the handbook.
inline constexpr const char *infinite_mass_method = "infinite mass", *computed_method = "computed opening";

struct MethodLoad {
  std::string method;
  double load = 0;  // [N]
  double time = 0;  // from the stage's begin [s]; 0: the method does not say
  bool applies = false;
  std::string note;  // why it does not apply, or what it rests on
};
template <Of<MethodLoad> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("method", m.method);
  visit("load_n", m.load);
  visit("time_s", m.time);
  visit("applies", m.applies);
  visit("note", m.note);
}

}  // namespace ripstop

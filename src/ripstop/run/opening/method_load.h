// The opening load by one method.
#pragma once

#include <string>

#include "ripstop/core/members.h"

namespace ripstop::inline run {

/// Names of the two methods that are not finite-mass estimates of the handbook.
inline constexpr const char *infinite_mass_method = "infinite mass", *computed_method = "computed opening";

struct MethodLoad {
  std::string method;
  double load = 0;  // [N]
  double time = 0;  // from the start of the stage [s]; 0: not given by the method
  bool applies = false;
  std::string note;  // why it does not apply, or its assumptions
};
template <Of<MethodLoad> T, class Visit>
void each_member(T& m, Visit&& visit) {
  visit("method", m.method);
  visit("load_n", m.load);
  visit("time_s", m.time);
  visit("applies", m.applies);
  visit("note", m.note);
}

}  // namespace ripstop::inline run

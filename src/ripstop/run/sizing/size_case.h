// A design in another size, and the case file of a sized parachute.
#pragma once

#include <string>

#include "ripstop/run/sizing/size.h"

namespace ripstop::inline run {

enum class Rounded { no, yes };
/// Every length of the parachute times `factor`, rounded to measurable lengths; lengths of the mesh do not
/// change.
void scale_lengths(Design& design, double factor, Rounded round = Rounded::yes);

/// The factors between which every length stays within the range of its key, and the keys and values that bound them.
struct ScaleLimits {
  double low = 1e-6, high = 1e6;
  std::string low_key, high_key;
  double low_value = 0, high_value = 0;  // [m]
};
ScaleLimits scale_limits(Design design);

/// A case file with comments that reads back to `result.given`.
std::string size_case_text(const SizeRequest& request, const SizeResult& result);

}  // namespace ripstop::inline run

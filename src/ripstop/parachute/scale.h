// A design in another size.
#pragma once

#include <string>

#include "ripstop/parachute/design.h"

namespace ripstop::inline parachute {

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

/// The design with every length times `ratio`, and with as many nodes: its mesh has the same topology.
Design in_size(const Design& design, double ratio);

}  // namespace ripstop::inline parachute

// The flat circular canopy: triangular gores that make a flat polygon.
#pragma once

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "flat-circular"
struct FlatCircular {
  static const CanopyFamily family;

  double nominal_diameter_m = 0;
  double vent_diameter_m = 0;
  bool vent_lines = true;
};

void describe(Fields& fields, FlatCircular& canopy);
void check_shape(const FlatCircular& canopy, const Design& design, Findings& findings);
Experience experience(const FlatCircular& canopy);
/// S0 = pi/4 nominal_diameter^2, the area of the polygon with its vent.
GorePattern gore_pattern(const FlatCircular& canopy, int gores);

}  // namespace ripstop::inline parachute

// The conical canopy: triangular gores, narrower than those of a flat one, that make a pyramid.
#pragma once

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "conical"
struct Conical {
  static const CanopyFamily family;

  double nominal_diameter_m = 0;
  double vent_diameter_m = 0;
  double cone_angle_deg = 30;  // between the cone and the plane of its skirt
  bool vent_lines = true;
};

void describe(Fields& fields, Conical& canopy);
void check_shape(const Conical& canopy, const Design& design, Findings& findings);
Experience experience(const Conical& canopy);
/// S0 = pi/4 nominal_diameter^2, the area of the cone with its vent: a slant length of
/// D0 / (2 sqrt(cos angle)).
GorePattern gore_pattern(const Conical& canopy, int gores);

}  // namespace ripstop::inline parachute

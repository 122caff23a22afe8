// The annular canopy: a ring of gores over a large vent, whose inner edge apex lines pull down.
#pragma once

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "annular"
struct Annular {
  static const CanopyFamily family;

  double outer_diameter_m = 0;
  double vent_diameter_m = 0;
  double crown_ratio = 1;
  double apex_line_ratio = 0.95;
};

void describe(Fields& fields, Annular& canopy);
void check_shape(const Annular& canopy, const Design& design, Findings& findings);
Experience experience(const Annular& canopy);
/// The meridian is the upper half of an ellipse from the skirt to the edge of the vent: semi-axes a, half the width of
/// the ring, and crown_ratio a. S0 is the cloth of the ring without its vent, 2 pi (mean radius) (length of the arc).
GorePattern gore_pattern(const Annular& canopy, int gores);

}  // namespace ripstop::inline parachute

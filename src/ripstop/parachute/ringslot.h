// The ringslot canopy: concentric rings of cloth with slots between, held by radials and vertical tapes.
#pragma once

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "ringslot"
struct Ringslot {
  static const CanopyFamily family;

  double nominal_diameter_m = 0;
  double vent_diameter_m = 0;
  double cone_angle_deg = 0;  // 0: flat
  int rings = 0;
  double slot_height_m = 0;
  int vertical_tapes = 2;  // in every gore, between its seams
  bool vent_lines = true;
};

void describe(Fields& fields, Ringslot& canopy);
void check_shape(const Ringslot& canopy, const Design& design, Findings& findings);
Experience experience(const Ringslot& canopy);
/// S0 = pi/4 nominal_diameter^2, slots and vent included.
GorePattern gore_pattern(const Ringslot& canopy, int gores);

}  // namespace ripstop::inline parachute

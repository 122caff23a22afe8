// The extended-skirt canopy: a flat disk with a skirt sewn on, straight or drawn in.
#pragma once

#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "extended-skirt"
struct ExtendedSkirt {
  static const CanopyFamily family;

  double disk_diameter_m = 0;
  double vent_diameter_m = 0;
  double skirt_height_m = 0;        // of the extension, along the cloth
  double skirt_diameter_share = 1;  // of its lower edge over the disk's: 1 straight, below 1 drawn in
  bool vent_lines = true;
};

void describe(Fields& fields, ExtendedSkirt& canopy);
void check_shape(const ExtendedSkirt& canopy, const Design& design, Findings& findings);
Experience experience(const ExtendedSkirt& canopy);
/// S0 is the disk with its vent, and the extension.
GorePattern gore_pattern(const ExtendedSkirt& canopy, int gores);

}  // namespace ripstop::inline parachute

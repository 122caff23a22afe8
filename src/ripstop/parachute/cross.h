// The cross canopy: two strips of cloth that cross, one layer where they do; lines from the four ends.
#pragma once

#include "ripstop/parachute/family.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "cross"
struct Cross {
  static const CanopyFamily family;

  double arm_length_m = 0;  // of a strip, from end to end
  double arm_width_m = 0;
};

void describe(Fields& fields, Cross& canopy);
void check_shape(const Cross& canopy, const Design& design, Findings& findings);
Experience experience(const Cross& canopy);
/// S0 = 2 L W - W^2. Lines end at the hem: they have no run on the canopy.
CanopyFacts facts(const Cross& canopy, int gores);
/// One whole strip and two arms.
CutPattern cut_pattern(const Cross& canopy, const Design& design);

/// Start shape: flat in the plane z = 0, arms along x and y. Every end of an arm has a quarter of the lines,
/// from corner to corner at equal distances; those at the corners are taut at the start. Square lattice of
/// five patches (four arms, each from its end inward, and the middle), sharing nodes where they meet. Tape
/// lies round the outline (hems) and round the middle square (seams). Throws Error(usage) for too few nodes.
CanopyMesh build_canopy(const Cross& canopy, const Design& design, const PartMaterials& materials);

}  // namespace ripstop::inline parachute

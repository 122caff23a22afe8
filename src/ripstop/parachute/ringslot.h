// The ringslot canopy: concentric rings of cloth with slots between, held by radials and vertical tapes.
#pragma once

#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/parachute/gore.h"

namespace ripstop {

class Fields;
class Findings;
struct CutPattern;
struct Design;
struct PartMaterials;

/// [parachute] with type = "ringslot"
struct Ringslot {
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
/// S0 = pi/4 nominal_diameter^2, slots and vent included.
GorePattern gore_pattern(const Ringslot& canopy, int gores);
CanopyFacts facts(const Ringslot& canopy, int gores);
CutPattern cut_pattern(const Ringslot& canopy, const Design& design);
/// See gored.h.
CanopyMesh build_canopy(const Ringslot& canopy, const Design& design, const PartMaterials& materials);

}  // namespace ripstop

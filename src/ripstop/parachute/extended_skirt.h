// The extended-skirt canopy: a flat disk with a skirt sewn on, straight or drawn in.
#pragma once

#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/parachute/gore.h"

namespace ripstop {

class Fields;
class Findings;
struct CutPattern;
struct Design;
struct PartMaterials;

/// [parachute] with type = "extended-skirt"
struct ExtendedSkirt {
  double disk_diameter_m = 0;
  double vent_diameter_m = 0;
  double skirt_height_m = 0;        // of the extension, along the cloth
  double skirt_diameter_share = 1;  // of its lower edge over the disk's: 1 straight, below 1 drawn in
  bool vent_lines = true;
};

void describe(Fields& fields, ExtendedSkirt& canopy);
void check_shape(const ExtendedSkirt& canopy, const Design& design, Findings& findings);
/// S0 is the disk with its vent, and the extension.
GorePattern gore_pattern(const ExtendedSkirt& canopy, int gores);
CanopyFacts facts(const ExtendedSkirt& canopy, int gores);
CutPattern cut_pattern(const ExtendedSkirt& canopy, const Design& design);
/// See gored.h.
CanopyMesh build_canopy(const ExtendedSkirt& canopy, const Design& design, const PartMaterials& materials);

}  // namespace ripstop

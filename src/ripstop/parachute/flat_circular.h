// The flat circular canopy: triangular gores that make a flat polygon.
#pragma once

#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/parachute/gore.h"

namespace ripstop {

class Fields;
class Findings;
struct CutPattern;
struct Design;
struct PartMaterials;

/// [parachute] with type = "flat-circular"
struct FlatCircular {
  double nominal_diameter_m = 0;
  double vent_diameter_m = 0;
  bool vent_lines = true;
};

void describe(Fields& fields, FlatCircular& canopy);
void check_shape(const FlatCircular& canopy, const Design& design, Findings& findings);
/// S0 = pi/4 nominal_diameter^2, the area of the polygon with its vent.
GorePattern gore_pattern(const FlatCircular& canopy, int gores);
CanopyFacts facts(const FlatCircular& canopy, int gores);
CutPattern cut_pattern(const FlatCircular& canopy, const Design& design);
/// See gored.h.
CanopyMesh build_canopy(const FlatCircular& canopy, const Design& design, const PartMaterials& materials);

}  // namespace ripstop

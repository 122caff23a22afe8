// The polygon sheet ("parasheet"): one flat sheet of cloth, square, hexagonal or octagonal, with lines at its corners.
#pragma once

#include "ripstop/parachute/cut.h"
#include "ripstop/parachute/family.h"
#include "ripstop/parachute/gore.h"

namespace ripstop::inline parachute {

/// [parachute] with type = "polygon"; `gores` is the number of its sides.
struct Polygon {
  static const CanopyFamily family;

  double across_flats_m = 0;
  double vent_diameter_m = 0;
};

void describe(Fields& fields, Polygon& canopy);
void check_shape(const Polygon& canopy, const Design& design, Findings& findings);
Experience experience(const Polygon& canopy);
/// Triangles from the sides to the middle, which the mesh and its symmetry need; they are not sewn. S0 is the whole
/// polygon with its vent.
GorePattern gore_pattern(const Polygon& canopy, int gores);
/// The lines end at the corners.
CanopyFacts facts(const Polygon& canopy, int gores);
/// One piece with an opening.
CutPattern cut_pattern(const Polygon& canopy, const Design& design);
/// As build_gored() without seams. The yarns follow the triangles, where those of the sheet have one direction.
CanopyMesh build_canopy(const Polygon& canopy, const Design& design, const PartMaterials& materials);

}  // namespace ripstop::inline parachute

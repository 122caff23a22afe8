#include "ripstop/parachute/flat_circular.h"

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/parachute/cut.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop {

void describe(Fields& fields, FlatCircular& canopy) {
  describe_nominal_diameter(fields, canopy.nominal_diameter_m);
  describe_vent(fields, canopy.vent_diameter_m, canopy.vent_lines);
}

void check_shape(const FlatCircular& canopy, const Design& design, Findings& findings) {
  check_vent(canopy.vent_diameter_m, canopy.nominal_diameter_m, canopy.vent_lines, design, findings);
}

GorePattern gore_pattern(const FlatCircular& canopy, int gores) {
  const double radius = canopy.nominal_diameter_m / 2;
  GorePattern pattern{gores, std::numbers::pi * radius * radius, {}, canopy.vent_lines};
  pattern.strips = {strip_on(
      "gore", [&](double s) { return radius - s; }, 0, radius - canopy.vent_diameter_m / 2, gores)};
  return pattern;
}

CanopyFacts facts(const FlatCircular& canopy, int gores) {
  return facts(gore_pattern(canopy, gores));
}

CutPattern cut_pattern(const FlatCircular& canopy, const Design& design) {
  return cut_pattern(gore_pattern(canopy, design.gores), design);
}

CanopyMesh build_canopy(const FlatCircular& canopy, const Design& design, const PartMaterials& materials) {
  return build_gored(gore_pattern(canopy, design.gores), design, materials);
}

}  // namespace ripstop

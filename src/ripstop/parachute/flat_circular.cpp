#include "ripstop/parachute/flat_circular.h"

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {

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

Experience experience(const FlatCircular&) {
  return {.projected_ratio = {0.67, 0.70},
          .drag_coefficient = {0.75, 0.80},
          .opening_coefficient = 1.7,
          .opening_source = knacke_transcribed,
          .line_load_factor = 1.02,
          .cloth_nodes = 1500};
}

constinit const CanopyFamily FlatCircular::family = family_of<FlatCircular>("flat-circular", "flat-circular");

}  // namespace ripstop::inline parachute

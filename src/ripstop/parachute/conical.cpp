#include "ripstop/parachute/conical.h"

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {

void describe(Fields& fields, Conical& canopy) {
  describe_nominal_diameter(fields, canopy.nominal_diameter_m);
  describe_vent(fields, canopy.vent_diameter_m, canopy.vent_lines);
  fields.number("cone_angle_deg", canopy.cone_angle_deg, from(0).up_to(60),
                "Angle between the constructed cone and the plane of its skirt; 25 to 30 is usual.");
}

void check_shape(const Conical& canopy, const Design& design, Findings& findings) {
  const double skirt =
      canopy.nominal_diameter_m * std::sqrt(std::cos(canopy.cone_angle_deg * std::numbers::pi / 180));
  check_vent(canopy.vent_diameter_m, skirt, canopy.vent_lines, design, findings);
}

GorePattern gore_pattern(const Conical& canopy, int gores) {
  const double radius = canopy.nominal_diameter_m / 2;
  const double cosine = std::cos(canopy.cone_angle_deg * std::numbers::pi / 180);
  const double slant = radius / std::sqrt(cosine);
  GorePattern pattern{gores, std::numbers::pi * radius * radius, {}, canopy.vent_lines};
  pattern.strips = {strip_on(
      "gore", [&](double s) { return (slant - s) * cosine; }, 0, slant - canopy.vent_diameter_m / 2 / cosine,
      gores)};
  return pattern;
}

Experience experience(const Conical&) {
  return {.projected_ratio = {0.70, 0.70},
          .drag_coefficient = {0.75, 0.90},
          .opening_coefficient = 1.8,
          .opening_source = knacke_transcribed,
          .cloth_nodes = 1500};
}

constinit const CanopyFamily Conical::family = family_of<Conical>("conical", "conical");

}  // namespace ripstop::inline parachute

#include "ripstop/parachute/spherical.h"

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {

double sphere_radius(double nominal_diameter, double half_angle) {
  return nominal_diameter / 2 / std::sqrt(2 * (1 - std::cos(half_angle)));
}

void describe(Fields& fields, Spherical& canopy) {
  describe_nominal_diameter(fields, canopy.nominal_diameter_m);
  describe_vent(fields, canopy.vent_diameter_m, canopy.vent_lines);
  fields.number("half_angle_deg", canopy.half_angle_deg, from(20).up_to(90),
                "Half the angle of the cap at the centre of the sphere: 90 is a hemisphere, 60 a quarter of "
                "the sphere.");
}

void check_shape(const Spherical& canopy, const Design& design, Findings& findings) {
  const double half_angle = canopy.half_angle_deg * std::numbers::pi / 180;
  const double skirt = 2 * sphere_radius(canopy.nominal_diameter_m, half_angle) * std::sin(half_angle);
  check_vent(canopy.vent_diameter_m, skirt, canopy.vent_lines, design, findings);
}

GorePattern gore_pattern(const Spherical& canopy, int gores) {
  const double half_angle = canopy.half_angle_deg * std::numbers::pi / 180;
  const double radius = sphere_radius(canopy.nominal_diameter_m, half_angle);
  const double nominal = canopy.nominal_diameter_m;
  GorePattern pattern{gores, std::numbers::pi / 4 * nominal * nominal, {}, canopy.vent_lines};
  pattern.strips = {strip_on(
      "gore", [&](double s) { return radius * std::sin(half_angle - s / radius); }, 0,
      radius * (half_angle - std::asin(canopy.vent_diameter_m / 2 / radius)), gores)};
  return pattern;
}

Experience experience(const Spherical& canopy) {
  Experience known{.projected_ratio = {},
                   .drag_coefficient = {},
                   .opening_coefficient = 1.6,
                   .opening_source = knacke_transcribed,
                   .cloth_nodes = 1500,
                   .closed_mouth = 0.1};
  if (canopy.half_angle_deg == 90) {  // the tables have no flatter caps
    known.projected_ratio = {0.66, 0.66};
    known.drag_coefficient = {0.62, 0.77};
  }
  return known;
}

constinit const CanopyFamily Spherical::family = family_of<Spherical>("spherical", "hemispherical");

}  // namespace ripstop::inline parachute

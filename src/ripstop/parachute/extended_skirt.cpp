#include "ripstop/parachute/extended_skirt.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {

void describe(Fields& fields, ExtendedSkirt& canopy) {
  fields
      .number("disk_diameter_m", canopy.disk_diameter_m, from(0.01).up_to(100), "Diameter of the flat disk.")
      .required();
  describe_vent(fields, canopy.vent_diameter_m, canopy.vent_lines);
  fields
      .number("skirt_height_m", canopy.skirt_height_m, above(0).up_to(100),
              "Height of the extension, along the cloth; a tenth of the diameter for the 10 % type.")
      .required();
  fields.number("skirt_diameter_share", canopy.skirt_diameter_share, from(0.3).up_to(1),
                "Diameter of the lower edge of the extension over that of the disk: 1 for a straight "
                "extension, less for a full extended skirt.");
}

void check_shape(const ExtendedSkirt& canopy, const Design& design, Findings& findings) {
  check_vent(canopy.vent_diameter_m, canopy.disk_diameter_m, canopy.vent_lines, design, findings);
  if (!findings.sound(shape_keys(design))) return;
  const double taper = canopy.disk_diameter_m / 2 * (1 - canopy.skirt_diameter_share);
  if (taper > canopy.skirt_height_m)
    findings.add(
        "parachute.skirt_height_m", canopy.skirt_height_m, fmt::format("at least {:.6g}", taper),
        fmt::format("the radius of the extension decreases by {:.6g} m, more than its height", taper));
}

GorePattern gore_pattern(const ExtendedSkirt& canopy, int gores) {
  const double radius = canopy.disk_diameter_m / 2, height = canopy.skirt_height_m;
  const double lower = radius * canopy.skirt_diameter_share;
  const double area = std::numbers::pi * (radius * radius + height * (radius + lower));
  GorePattern pattern{gores, area, {}, canopy.vent_lines};
  pattern.strips = {
      strip_on(
          "skirt", [&](double s) { return lower + (radius - lower) * s / height; }, 0, height, gores),
      strip_on(
          "disk", [&](double s) { return radius - s; }, 0, radius - canopy.vent_diameter_m / 2, gores)};
  pattern.strips[0].whole = true;
  pattern.strips[1].joined = true;
  return pattern;
}

Experience experience(const ExtendedSkirt&) {
  return {.projected_ratio = {0.66, 0.70},
          .drag_coefficient = {0.78, 0.87},
          .opening_coefficient = 1.4,
          .opening_source = knacke_transcribed,
          .cloth_nodes = 1500,
          .closed_mouth = 0.1};
}

constinit const CanopyFamily ExtendedSkirt::family =
    family_of<ExtendedSkirt>("extended-skirt", "extended-skirt");

}  // namespace ripstop::inline parachute

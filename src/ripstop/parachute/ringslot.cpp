#include "ripstop/parachute/ringslot.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {

namespace {

struct Layout {
  double cosine = 1, slant = 0, run = 0, ring_height = 0;
};

Layout layout_of(const Ringslot& canopy) {
  Layout layout;
  layout.cosine = std::cos(canopy.cone_angle_deg * std::numbers::pi / 180);
  layout.slant = canopy.nominal_diameter_m / 2 / std::sqrt(layout.cosine);
  layout.run = layout.slant - canopy.vent_diameter_m / 2 / layout.cosine;
  layout.ring_height = (layout.run - (canopy.rings - 1) * canopy.slot_height_m) / canopy.rings;
  return layout;
}

}  // namespace

void describe(Fields& fields, Ringslot& canopy) {
  describe_nominal_diameter(fields, canopy.nominal_diameter_m);
  describe_vent(fields, canopy.vent_diameter_m, canopy.vent_lines);
  fields.number("cone_angle_deg", canopy.cone_angle_deg, from(0).up_to(60),
                "Angle between the constructed canopy and the plane of its skirt; 0: flat.");
  fields.integer("rings", canopy.rings, from(2).up_to(100), "Number of rings of cloth, equally high.")
      .required();
  fields.number("slot_height_m", canopy.slot_height_m, above(0).up_to(10), "Open height between two rings.")
      .required();
  fields.integer(
      "vertical_tapes", canopy.vertical_tapes, from(0).up_to(20),
      "Number of vertical tapes of every gore between its seams, which keep the rings apart (assumed).");
}

void check_shape(const Ringslot& canopy, const Design& design, Findings& findings) {
  const Layout layout = layout_of(canopy);
  check_vent(canopy.vent_diameter_m, 2 * layout.slant * layout.cosine, canopy.vent_lines, design, findings);
  if (canopy.vertical_tapes > 0 && design.tape.material == no_tape &&
      findings.sound({"parachute.vertical_tapes"}))
    findings.add("parachute.vertical_tapes", canopy.vertical_tapes, "0",
                 "vertical tapes require a parachute.tape.material other than \"none\"");
  if (!findings.sound(shape_keys(design))) return;
  if (canopy.slot_height_m >= layout.ring_height)
    findings.add(
        "parachute.slot_height_m", canopy.slot_height_m,
        fmt::format("below {:.6g}", layout.run / (2 * canopy.rings - 1)),
        fmt::format("the slots are wider than the rings, which are {:.6g} m high", layout.ring_height));
}

GorePattern gore_pattern(const Ringslot& canopy, int gores) {
  const Layout layout = layout_of(canopy);
  const double radius = canopy.nominal_diameter_m / 2;
  GorePattern pattern{
      gores, std::numbers::pi * radius * radius, {}, canopy.vent_lines, canopy.vertical_tapes};
  for (int i = 0; i < canopy.rings; ++i) {
    const double from = i * (layout.ring_height + canopy.slot_height_m);
    pattern.strips.push_back(strip_on(
        fmt::format("ring {}", i + 1), [&](double s) { return (layout.slant - s) * layout.cosine; }, from,
        from + layout.ring_height, gores));
    pattern.strips.back().whole = true;
    if (i > 0) pattern.strips.back().slot = polygon_scale(gores) * canopy.slot_height_m;
  }
  return pattern;
}

Experience experience(const Ringslot&) {
  return {.projected_ratio = {0.67, 0.70},
          .drag_coefficient = {0.56, 0.65},
          .opening_coefficient = 1.05,
          .opening_source = knacke_transcribed,
          .line_load_factor = 1.03,
          .cloth_nodes = 6000};
}

constinit const CanopyFamily Ringslot::family = family_of<Ringslot>("ringslot", "ringslot");

}  // namespace ripstop::inline parachute

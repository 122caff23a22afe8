#include "ripstop/parachute/ringsail.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/angle.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"
#include "ripstop/parachute/spherical.h"

namespace ripstop::inline parachute {

namespace {

double arc_of_gore(const Ringsail& canopy) {
  const double half_angle = canopy.half_angle_deg * degree;
  const double radius = sphere_radius(canopy.nominal_diameter_m, half_angle);
  return half_angle - std::asin(canopy.vent_diameter_m / 2 / radius);
}

/// Arc of a row of height 1: the arc without the slots, over the sum of the heights.
double arc_of_row(const Ringsail& canopy, const std::vector<SailRow>& rows) {
  double arc = arc_of_gore(canopy), heights = 0;
  for (const SailRow& row : rows) arc -= row.slot_deg * degree, heights += row.height;
  return arc / heights;
}

}  // namespace

std::vector<SailRow> sail_rows(const Ringsail& canopy) {
  if (!canopy.rows.empty()) return canopy.rows;
  const int n = canopy.sails;
  std::vector<SailRow> rows(n);
  // From row 1, next to the skirt's, to row n - 3.
  for (int i = 1; i <= n - 3; ++i) rows[i].leading_fullness = n > 4 ? 0.11 - 0.06 * (i - 1) / (n - 4) : 0.11;
  for (const int i : {n - 3, n - 2})
    if (i >= 0) rows[i].slot_deg = 3;
  rows[n - 1].height = 0.5;
  return rows;
}

void describe(Fields& fields, SailRow& row) {
  fields.number("height", row.height, above(0).up_to(100),
                "Relative height of the row: the rows share the height of the gore without slots and vent in "
                "this proportion.");
  fields.number("slot_deg", row.slot_deg, from(0).up_to(30),
                "Open height above the row, as an arc of the sphere. A row without a slot is attached to the "
                "next one at the radials only.");
  fields.number("leading_fullness", row.leading_fullness, from(0).up_to(0.5),
                "Fullness of the lower edge: its length over the chord between the radials, minus 1.");
  fields.number("trailing_fullness", row.trailing_fullness, from(0).up_to(0.5),
                "Fullness of the upper edge.");
}

void describe(Fields& fields, Ringsail& canopy) {
  describe_nominal_diameter(fields, canopy.nominal_diameter_m);
  describe_vent(fields, canopy.vent_diameter_m, canopy.vent_lines);
  fields.number("half_angle_deg", canopy.half_angle_deg, from(20).up_to(90),
                "Half the angle of the cap at the centre of the sphere; 60 is the classic quarter sphere.");
  fields.integer("sails", canopy.sails, from(3).up_to(40), "Number of sails of a gore.");
  fields.rows("rows", canopy.rows,
              "Rows of sails from the skirt upwards. Default: the classic K1 layout. The two top rows have "
              "3-degree slots below them, and the top row has half height. The leading-edge fullness is 0 at "
              "the skirt, then decreases from 0.11 to 0.05, and is 0 in the two top rows.");
}

void check_shape(const Ringsail& canopy, const Design& design, Findings& findings) {
  const double half_angle = canopy.half_angle_deg * degree;
  const double skirt = 2 * sphere_radius(canopy.nominal_diameter_m, half_angle) * std::sin(half_angle);
  check_vent(canopy.vent_diameter_m, skirt, canopy.vent_lines, design, findings);
  if (!findings.sound(shape_keys(design))) return;
  if (!canopy.rows.empty() && static_cast<int>(canopy.rows.size()) != canopy.sails) {
    findings.add(
        "parachute.sails", canopy.sails, fmt::format("{}", canopy.rows.size()),
        fmt::format("there are {} tables [[parachute.rows]]; one is required for every sail of a gore",
                    canopy.rows.size()));
    return;
  }
  const std::vector<SailRow> rows = sail_rows(canopy);
  const double one = arc_of_row(canopy, rows) / degree;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double height = one * rows[i].height;
    if (rows[i].slot_deg > 0 && rows[i].slot_deg >= height)
      findings.add(canopy.rows.empty() ? "parachute.sails" : fmt::format("parachute.rows[{}].slot_deg", i),
                   rows[i].slot_deg, "",
                   fmt::format("the slot above row {} is wider than the row, for which slots and vent leave "
                               "{:.3g} degrees of arc",
                               i + 1, std::max(0.0, height)));
    if (i + 1 == rows.size() && rows[i].slot_deg > 0)
      findings.add(fmt::format("parachute.rows[{}].slot_deg", i), rows[i].slot_deg, "0",
                   "the vent is above the last row; give its size as parachute.vent_diameter_m");
  }
}

GorePattern gore_pattern(const Ringsail& canopy, int gores) {
  const double half_angle = canopy.half_angle_deg * degree, nominal = canopy.nominal_diameter_m;
  const double radius = sphere_radius(nominal, half_angle);
  const std::vector<SailRow> rows = sail_rows(canopy);
  const double one = arc_of_row(canopy, rows);
  GorePattern pattern{gores, std::numbers::pi / 4 * nominal * nominal, {}, canopy.vent_lines};
  double from = 0, slot = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double to = from + radius * one * rows[i].height;
    GoreStrip strip = strip_on(
        fmt::format("sail {}", i + 1), [&](double s) { return radius * std::sin(half_angle - s / radius); },
        from, to, gores, rows[i].leading_fullness, rows[i].trailing_fullness);
    strip.whole = true;
    strip.slot = polygon_scale(gores) * slot;
    pattern.strips.push_back(std::move(strip));
    slot = radius * rows[i].slot_deg * degree;
    from = to + slot;
  }
  return pattern;
}

Experience experience(const Ringsail&) {
  return {.projected_ratio = {0.69, 0.69},
          .drag_coefficient = {0.75, 0.85},
          .opening_coefficient = 1.1,
          .opening_source = knacke_transcribed,
          .cloth_nodes = 1500};
}

constinit const CanopyFamily Ringsail::family = family_of<Ringsail>("ringsail", "adept");

}  // namespace ripstop::inline parachute

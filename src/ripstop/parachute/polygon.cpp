#include "ripstop/parachute/polygon.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/canopy_mesh.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/gored.h"

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;

}  // namespace

void describe(Fields& fields, Polygon& canopy) {
  fields
      .number("across_flats_m", canopy.across_flats_m, from(0.01).up_to(100),
              "Distance between opposite sides of the flat sheet, twice the radius of its inscribed circle.")
      .required();
  fields
      .number("vent_diameter_m", canopy.vent_diameter_m, above(0).up_to(100),
              "Diameter of the spill hole in the middle.")
      .required();
}

void check_shape(const Polygon& canopy, const Design& design, Findings& findings) {
  check_vent(canopy.vent_diameter_m, canopy.across_flats_m, false, design, findings);
  if (findings.sound({"parachute.gores", "parachute.lines.count"}) && design.lines.count != design.gores)
    findings.add("parachute.lines.count", design.lines.count, fmt::format("{}", design.gores),
                 "a polygon sheet has one line at every corner, as many as sides (parachute.gores)");
}

GorePattern gore_pattern(const Polygon& canopy, int gores) {
  const double apothem = canopy.across_flats_m / 2, side = 2 * std::tan(pi / gores);
  const double vent = polygon_scale(gores) * canopy.vent_diameter_m / 2;
  GorePattern pattern;
  pattern.gores = gores;
  pattern.nominal_area = gores * std::tan(pi / gores) * apothem * apothem;
  GoreStrip strip;
  strip.name = "sheet";
  strip.stations = {{0, side * apothem, side * apothem}, {apothem - vent, side * vent, side * vent}};
  pattern.strips = {strip};
  return pattern;
}

CanopyFacts facts(const Polygon& canopy, int gores) {
  CanopyFacts facts = ripstop::facts(gore_pattern(canopy, gores));
  facts.line_run = 0;
  return facts;
}

CutPattern cut_pattern(const Polygon& canopy, const Design& design) {
  constexpr int corners = 72;  // of the hole as drawn, with the area of the circle
  const int n = design.gores;
  const double apothem = canopy.across_flats_m / 2, radius = apothem / std::cos(pi / n);
  Piece sheet{.name = "sheet", .count = 1, .outline = {}, .edges = {}};
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * pi * (k - 0.5) / n - pi / 2;  // the first side lies below
    sheet.outline.push_back({radius * std::cos(angle), apothem + radius * std::sin(angle)});
    sheet.edges.push_back(Edge::hem);
    sheet.edge_names.push_back("side");
    sheet.marks.push_back({sheet.outline.back(), "line"});
  }
  const double hole = canopy.vent_diameter_m / 2 * std::sqrt(2 * pi / corners / std::sin(2 * pi / corners));
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * pi * k / corners;
    sheet.opening.push_back({hole * std::cos(angle), apothem + hole * std::sin(angle)});
  }
  CutPattern cut;
  cut.pieces = {sheet};
  const GorePattern pattern = gore_pattern(canopy, n);
  if (design.tape.hems)
    cut.tapes = {{"sides", 1, n * pattern.strips[0].stations.front().width},
                 {"vent", 1, n * pattern.strips[0].stations.back().width}};
  return cut;
}

CanopyMesh build_canopy(const Polygon& canopy, const Design& design, const PartMaterials& materials) {
  Design sheet = design;
  sheet.tape.seams = false;
  return build_gored(gore_pattern(canopy, design.gores), sheet, materials);
}

Experience experience(const Polygon&) {
  return untabulated(1500, 0.1);
}

constinit const CanopyFamily Polygon::family = family_of<Polygon>("polygon", "hexagon");

}  // namespace ripstop::inline parachute

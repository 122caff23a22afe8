#include "ripstop/parachute/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"

namespace ripstop {
namespace {

using std::numbers::pi;

double area(const DiskGapBand& canopy) {
  const double disk =
      pi / 4 *
      (canopy.disk_diameter_m * canopy.disk_diameter_m - canopy.vent_diameter_m * canopy.vent_diameter_m);
  return disk + pi * canopy.disk_diameter_m * canopy.band_height_m;
}

double disk_width(const DiskGapBand& canopy) {
  return (canopy.disk_diameter_m - canopy.vent_diameter_m) / 2;
}

double disk_width(const Design& design) {
  return std::visit([](const auto& canopy) { return disk_width(canopy); }, design.canopy);
}

void check_shape(const DiskGapBand& canopy, Findings& findings) {
  if (!findings.sound({"parachute.disk_diameter_m", "parachute.vent_diameter_m"})) return;
  if (canopy.vent_diameter_m >= canopy.disk_diameter_m)
    findings.add("parachute.vent_diameter_m", canopy.vent_diameter_m,
                 fmt::format("below {}", canopy.disk_diameter_m),
                 fmt::format("the vent must be smaller than the disk, parachute.disk_diameter_m = {}",
                             canopy.disk_diameter_m));
}

/// All keys that decide the size of the canopy.
const std::vector<std::string> shape_keys = {"parachute.type", "parachute.disk_diameter_m",
                                             "parachute.vent_diameter_m", "parachute.gap_height_m",
                                             "parachute.band_height_m"};

void check_lines(const Design& design, Findings& findings) {
  const double radius = start_diameter(design) / 2;
  const LineSet& lines = design.lines;
  if (findings.sound({"parachute.disk_diameter_m", "parachute.lines.length_m"}) && lines.length_m <= radius)
    findings.add("parachute.lines.length_m", lines.length_m, fmt::format("above {}", radius),
                 fmt::format("the lines are too short to meet on the axis; they must be longer than the "
                             "radius of the skirt, {} m",
                             radius));
  if (findings.sound(
          {"parachute.disk_diameter_m", "parachute.vent_diameter_m", "parachute.lines.onto_disk_m"}) &&
      lines.onto_disk_m) {
    const double width = disk_width(design);
    if (*lines.onto_disk_m > width * (1 + 1e-12))
      findings.add(
          "parachute.lines.onto_disk_m", *lines.onto_disk_m, fmt::format("at most {}", width),
          fmt::format("the lines would run past the vent's edge, which lies {} m inside the disk's edge",
                      width));
  }
  if (findings.sound({"parachute.lines.length_m", "parachute.mesh.line_segment_m"}) &&
      design.mesh.line_segment_m > lines.length_m / 2)
    findings.add("parachute.mesh.line_segment_m", design.mesh.line_segment_m,
                 fmt::format("at most {}", lines.length_m / 2),
                 fmt::format("a line of {} m needs at least two springs", lines.length_m));
}

/// Lines and seams both lie on columns of the mesh, so its columns are a multiple of both counts.
void check_columns(const Design& design, Findings& findings) {
  if (!findings.sound(shape_keys) ||
      !findings.sound({"parachute.lines.count", "parachute.gores", "parachute.mesh.cloth_nodes"}))
    return;
  const double spacing = std::sqrt(computed_area(design) / design.mesh.cloth_nodes);
  const double columns = pi * start_diameter(design) / spacing;
  const int needed = std::lcm(design.lines.count, design.gores);
  if (needed <= columns) return;
  const double fitting = std::pow(needed / columns, 2) * design.mesh.cloth_nodes;
  findings.add(
      "parachute.lines.count", design.lines.count, "",
      fmt::format("{} lines on {} gores need a mesh with a multiple of {} columns round the canopy, and "
                  "parachute.mesh.cloth_nodes = {} gives about {:.0f}; take counts with a smaller common "
                  "multiple, or at least {:.0f} nodes",
                  design.lines.count, design.gores, needed, design.mesh.cloth_nodes, columns,
                  std::ceil(fitting)));
}

}  // namespace

void describe(Fields& fields, DiskGapBand& canopy) {
  fields
      .number("disk_diameter_m", canopy.disk_diameter_m, from(0.01).up_to(100),
              "Diameter of the flat disk, which is the band's too.")
      .required();
  fields
      .number("vent_diameter_m", canopy.vent_diameter_m, above(0).up_to(100),
              "Diameter of the hole in the middle of the disk.")
      .required();
  fields.number("gap_height_m", canopy.gap_height_m, from(0).up_to(100), "Open height between disk and band.")
      .required();
  fields.number("band_height_m", canopy.band_height_m, above(0).up_to(100), "Height of the cylindrical band.")
      .required();
}

void describe(Fields& fields, LineSet& lines) {
  fields.integer("count", lines.count, from(3).up_to(500), "Number of suspension lines, equally spaced.")
      .required();
  fields
      .number("length_m", lines.length_m, above(0).up_to(1000),
              "Length of a line from the confluence to the skirt.")
      .required();
  fields.name("material", lines.material, "Material of the lines, of kind \"line\".");
  fields
      .number("onto_disk_m", lines.onto_disk_m, from(0).up_to(100),
              "How far the lines run onto the disk from its edge. They lie along the band and across the gap "
              "before (assumed: the source does not say).")
      .absent("to the vent's edge (assumed)");
}

void describe(Fields& fields, TapeLayout& tape) {
  fields.name("material", tape.material, "Material of the reinforcement, of kind \"tape\".");
  fields.toggle("seams", tape.seams, "Tape along the seams between gores (assumed).");
  fields.toggle("hems", tape.hems,
                "Tape along the vent, the disk's edge and both edges of the band (assumed).");
}

void describe(Fields& fields, Riser& riser) {
  fields.number("length_m", riser.length_m, from(0).up_to(1000),
                "Length from the fixed point to the confluence; 0: the confluence is the fixed point.");
  fields.name("material", riser.material, "Material of the riser, of kind \"line\".");
}

void describe(Fields& fields, MeshSettings& mesh) {
  fields.integer("cloth_nodes", mesh.cloth_nodes, from(500).up_to(2'000'000),
                 "Nodes of the cloth that the mesh aims at. [NFM] used 25,600 for Stratos IV.");
  fields.number("line_segment_m", mesh.line_segment_m, from(0.001).up_to(10),
                "Rest length that the springs of a line aim at.");
}

void describe(Fields& fields, Design& design) {
  fields.kind("type", design.canopy, {"disk-gap-band"}, "Family of the canopy.");
  fields
      .number("nominal_area_m2", design.nominal_area_m2, above(0).up_to(10000),
              "Reference area S0 of the coefficients.")
      .absent("the cloth's area as cut (disk - vent + band)");
  fields.integer("gores", design.gores, from(3).up_to(500), "Number of gores, equally wide.").required();
  fields.name("canopy_material", design.canopy_material, "Material of the cloth, of kind \"fabric\".");
  fields.table("lines", design.lines, "Suspension lines.");
  fields.table("tape", design.tape, "Reinforcement tape.");
  fields.table("riser", design.riser, "Riser between the fixed point and the confluence.");
  fields.table("mesh", design.mesh, "Resolution of the mass-spring mesh.");
}

void check_design(const Design& design, Findings& findings) {
  std::visit([&](const auto& canopy) { check_shape(canopy, findings); }, design.canopy);
  check_lines(design, findings);
  check_columns(design, findings);
}

double computed_area(const Design& design) {
  return std::visit([](const auto& canopy) { return area(canopy); }, design.canopy);
}

double nominal_area(const Design& design) {
  return design.nominal_area_m2.value_or(computed_area(design));
}

double line_length_on_disk(const Design& design) {
  return design.lines.onto_disk_m.value_or(disk_width(design));
}

double start_diameter(const Design& design) {
  return std::visit([](const DiskGapBand& canopy) { return canopy.disk_diameter_m; }, design.canopy);
}

double start_depth(const Design& design) {
  return std::visit([](const DiskGapBand& canopy) { return canopy.gap_height_m + canopy.band_height_m; },
                    design.canopy);
}

}  // namespace ripstop

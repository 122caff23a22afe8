#include "ripstop/parachute/design.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"

namespace ripstop::inline parachute {
namespace {

void check_lines(const Design& design, Findings& findings) {
  const LineSet& lines = design.lines;
  const bool sound = findings.sound(shape_keys(design));
  const double radius = sound ? facts(design).skirt_radius : 0;
  if (sound && findings.sound({"parachute.lines.length_m"}) && lines.length_m <= radius)
    findings.add("parachute.lines.length_m", lines.length_m, fmt::format("above {:.4g}", radius),
                 fmt::format("the lines are too short to meet on the axis; they must be longer than the "
                             "radius of the skirt, {:.4g} m",
                             radius));
  if (sound && findings.sound({"parachute.lines.onto_disk_m"}) && lines.onto_disk_m) {
    const double run = facts(design).line_run;
    if (*lines.onto_disk_m > run * (1 + 1e-12))
      findings.add(
          "parachute.lines.onto_disk_m", *lines.onto_disk_m, fmt::format("at most {}", run),
          fmt::format("the lines would extend beyond the edge of the vent, which is {} m further in", run));
  }
  if (findings.sound({"parachute.lines.length_m", "parachute.mesh.line_segment_m"}) &&
      design.mesh.line_segment_m > lines.length_m / 2)
    findings.add("parachute.mesh.line_segment_m", design.mesh.line_segment_m,
                 fmt::format("at most {}", lines.length_m / 2),
                 fmt::format("a line of {} m needs at least two springs", lines.length_m));
  check_line_nodes(design, "parachute.mesh.line_segment_m", design.mesh.line_segment_m, findings);
}

/// Lines and seams both lie on columns of the mesh, so its columns are a multiple of both counts.
void check_columns(const Design& design, Findings& findings) {
  if (!findings.sound(shape_keys(design)) ||
      !findings.sound({"parachute.gores", "parachute.lines.count", "parachute.mesh.cloth_nodes"}))
    return;
  const double spacing = std::sqrt(computed_area(design) / design.mesh.cloth_nodes);
  const double columns = facts(design).circumference / spacing;
  const int needed = std::lcm(design.lines.count, design.gores);
  if (needed <= columns) return;
  const double fitting = std::pow(needed / columns, 2) * design.mesh.cloth_nodes;
  findings.add("parachute.lines.count", design.lines.count, "",
               fmt::format("{} lines on {} gores need a mesh with a multiple of {} columns around the "
                           "canopy, but parachute.mesh.cloth_nodes = {} gives about {:.0f}; use counts with "
                           "a smaller common multiple, or at least {:.0f} nodes",
                           design.lines.count, design.gores, needed, design.mesh.cloth_nodes, columns,
                           std::ceil(fitting)));
}

/// The word that chooses among families, whose own keys follow it.
Kind type_of(Canopy& canopy, const Families& types) {
  Kind kind;
  for (const CanopyFamily* family : types) kind.words.push_back(family->type);
  kind.get = [&canopy, types]() -> std::size_t {
    const auto found = std::find(types.begin(), types.end(), &canopy.family());
    if (found == types.end())
      throw Error(ExitCode::usage, fmt::format("parachute.type = \"{}\": is not in the list of families",
                                               canopy.family().type));
    return found - types.begin();
  };
  kind.select = [&canopy, types](std::size_t wanted) {
    if (&canopy.family() != types.at(wanted)) canopy = types[wanted]->make();
    Fields own;
    canopy.family().describe(own, canopy);
    return own;
  };
  return kind;
}

}  // namespace

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
              "Length of the lines that is sewn to the canopy, from the skirt; for a disk-gap-band, the part "
              "on the disk, without band and gap (assumed: the source does not give it).")
      .absent("to the edge of the vent (assumed)");
}

void describe(Fields& fields, TapeLayout& tape) {
  fields
      .name("material", tape.material,
            "Material of the reinforcement, of kind \"tape\"; \"none\": seams and hems without tape.")
      .absent(
          "`\"none\"` if a hem of the cloth carries the opening load of one line, else the lightest tape "
          "that carries it");
  fields.toggle("seams", tape.seams, "Tape along the seams between gores (assumed).");
  fields.toggle("hems", tape.hems, "Tape along the vent and all other edges of the cloth (assumed).");
  fields.toggle(
      "inner_hems", tape.inner_hems,
      "With `hems`: tape also along open edges of sails and rings between skirt and vent; false: those edges "
      "are hemmed without tape, as in small ringsails. Not for a disk-gap-band or a cross.");
}

void describe(Fields& fields, Riser& riser) {
  fields.number("length_m", riser.length_m, from(0).up_to(1000),
                "Length from the fixed point to the confluence; 0: the confluence is the fixed point.");
  fields.name("material", riser.material, "Material of the riser, of kind \"line\".");
}

void describe(Fields& fields, MeshSettings& mesh) {
  fields.integer("cloth_nodes", mesh.cloth_nodes, from(500).up_to(2'000'000),
                 "Target number of cloth nodes. [NFM] used 25,600 for Stratos IV.");
  fields.number("line_segment_m", mesh.line_segment_m, from(0.001).up_to(10),
                "Target rest length of the springs of a line.");
  fields.toggle(
      "sewn_straight", mesh.sewn_straight,
      "Sewn-line constraint: gore seams follow the straight segments between the nodes of a line; false: "
      "cloth nodes between them can move freely next to the line, which has the length of the seam.");
  fields.integer("folds", mesh.folds, from(0).up_to(1000),
                 "Number of folds for which the mesh is prepared: the number of columns of every ring is a "
                 "multiple of twice this number; 0: no such condition.");
}

void describe(Fields& fields, Design& design, const Families& types) {
  fields.kind("type", type_of(design.canopy, types), "Family of the canopy.");
  fields
      .number("nominal_area_m2", design.nominal_area_m2, above(0).up_to(10000),
              "Reference area S0 of the coefficients.")
      .absent(
          "definition of the canopy family: area of the cloth (disk-gap-band, annular, cross), else of the "
          "design surface with vent and slots");
  fields
      .integer("gores", design.gores, from(3).up_to(500),
               "Number of gores of equal width; for a cross 4, the number of its arms.")
      .required();
  fields.name("canopy_material", design.canopy_material, "Material of the cloth, of kind \"fabric\".");
  fields.choice("cut", design.cut,
                {{"block", FabricCut::block}, {"block-across", FabricCut::across}, {"bias", FabricCut::bias}},
                "Orientation of the cloth: \"block\": warp along the gore; \"block-across\": warp across it; "
                "\"bias\": yarns at 45 degrees to its centre line.");
  fields.table("lines", design.lines, "Suspension lines.").required();
  fields.table("tape", design.tape, "Reinforcement tape.");
  fields.table("riser", design.riser, "Riser between the fixed point and the confluence.");
  fields.table("mesh", design.mesh, "Resolution of the mass-spring mesh.");
}

void describe_nominal_diameter(Fields& fields, double& diameter) {
  fields
      .number(
          "nominal_diameter_m", diameter, from(0.01).up_to(100),
          "Nominal diameter: S0 = pi/4 of its square is the whole design surface, vent and slots included.")
      .required();
}

void describe_vent(Fields& fields, double& diameter, bool& lines) {
  fields
      .number("vent_diameter_m", diameter, above(0).up_to(100),
              "Diameter of the circle with the area of the vent.")
      .required();
  fields.toggle(
      "vent_lines", lines,
      "The lines continue across the vent to the opposite radial, if they reach the vent (assumed).");
}

void check_vent(double vent, double diameter, bool lines, const Design& design, Findings& findings) {
  const std::string key = "parachute.vent_diameter_m";
  if (findings.sound(shape_keys(design)) && vent >= diameter)
    findings.add(key, vent, fmt::format("below {:.6g}", diameter),
                 fmt::format("the vent must be smaller than the canopy, {:.6g} m across", diameter));
  check_vent_cells(vent, key, design, findings);
  check_vent_lines(lines, design, findings);
}

void check_vent_cells(double vent, const std::string& key, const Design& design, Findings& findings,
                      double of_diameter) {
  if (!findings.sound(shape_keys(design)) ||
      !findings.sound({"parachute.gores", "parachute.mesh.cloth_nodes"}))
    return;
  const double cell = std::sqrt(computed_area(design) / design.mesh.cloth_nodes);
  if (vent < cell)
    findings.add(
        key, of_diameter * vent, fmt::format("at least {:.3g}", of_diameter * cell),
        fmt::format("the diameter of the vent is smaller than a cell of the mesh, {:.3g} m with "
                    "parachute.mesh.cloth_nodes = {}; make it larger, or use at least {:.0f} nodes",
                    cell, design.mesh.cloth_nodes, std::ceil(computed_area(design) / (vent * vent))));
}

void check_vent_lines(bool lines, const Design& design, Findings& findings) {
  if (findings.sound({"parachute.lines.count"}) && lines && design.lines.count % 2 != 0)
    findings.add("parachute.lines.count", design.lines.count, "an even number",
                 "a line continues across the vent to the opposite one; set parachute.vent_lines = false for "
                 "an odd number of lines");
}

void check_inner_hems(const Design& design, Findings& findings) {
  if (!design.tape.inner_hems)
    findings.add("parachute.tape.inner_hems", "false", "true",
                 "only canopies made of gores can have inner edges without tape");
}

void check_line_nodes(const Design& design, const std::string& key, double line_segment, Findings& findings) {
  constexpr double most_nodes = 2e6;  // as many as the cloth may have
  if (!findings.sound({key, "parachute.lines.length_m", "parachute.lines.count", "parachute.riser.length_m"}))
    return;
  const double length = design.lines.count * design.lines.length_m + design.riser.length_m;
  if (length <= most_nodes * line_segment) return;
  findings.add(
      key, line_segment, fmt::format("at least {:.3g}", length / most_nodes),
      fmt::format(
          "{:.4g} m of lines and riser would have {:.3g} nodes, more than {:.0e}; make it at least {:.3g} m",
          length, length / line_segment, most_nodes, std::ceil(1e3 * length / most_nodes) / 1e3));
}

void check_design(const Design& design, Findings& findings) {
  if (!findings.sound({"parachute.type"})) return;  // the other keys depend on the type
  design.canopy.family().check_shape(design.canopy, design, findings);
  check_lines(design, findings);
  check_columns(design, findings);
}

CanopyFacts facts(const Design& design) {
  // A design with fewer gores is refused, but its other mistakes are reported as well.
  const int gores = std::max(3, design.gores);
  return design.canopy.family().facts(design.canopy, gores);
}

Experience experience(const Design& design) {
  return design.canopy.family().experience(design.canopy);
}

double computed_area(const Design& design) {
  return facts(design).cloth_area;
}

double nominal_area(const Design& design) {
  return design.nominal_area_m2.value_or(facts(design).nominal_area);
}

double nominal_diameter(const Design& design) {
  return std::sqrt(4 / std::numbers::pi * nominal_area(design));
}

double line_length_on_disk(const Design& design) {
  return design.lines.onto_disk_m.value_or(facts(design).line_run);
}

double skirt_circumference(const Design& design) {
  return 2 * std::numbers::pi * facts(design).skirt_radius;
}

double start_diameter(const Design& design) {
  return facts(design).start_diameter;
}

double start_depth(const Design& design) {
  return facts(design).start_depth;
}

std::vector<std::string> shape_keys(const Design& design) {
  std::vector<std::string> keys = {"parachute.*"};  // without the tables in it
  Canopy canopy = design.canopy;
  Fields own;
  canopy.family().describe(own, canopy);
  for (const Field& field : own.list()) keys.push_back("parachute." + field.key);
  return keys;
}

}  // namespace ripstop::inline parachute

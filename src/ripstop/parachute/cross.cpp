#include "ripstop/parachute/cross.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"
#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/cut.h"
#include "ripstop/parachute/design.h"
#include "ripstop/parachute/sewing.h"

namespace ripstop::inline parachute {
namespace {

constexpr int arms = 4;

struct Lattice {
  int across = 0;  // cells over an arm's width, a multiple of the spaces between its lines
  int along = 0;   // cells from an arm's end to the middle square
};

Lattice choose_lattice(const Cross& canopy, const Design& design) {
  const double spacing = std::sqrt(facts(canopy, arms).cloth_area / design.mesh.cloth_nodes);
  const int spaces = design.lines.count / arms - 1;
  const double wanted = canopy.arm_width_m / spacing / spaces;
  // To be folded, an arm needs a column along its middle.
  const int per_space = design.mesh.folds > 0 && spaces % 2 != 0
                            ? 2 * static_cast<int>(std::lround(0.5 * wanted))
                            : static_cast<int>(std::lround(wanted));
  if (per_space < 1)
    throw QuantityError(
        ExitCode::usage,
        fmt::format("number of cloth nodes = {}: too few for {} lines at the end of an arm; use more nodes",
                    design.mesh.cloth_nodes, spaces + 1),
        {"number of cloth nodes"});
  Lattice lattice{per_space * spaces, 0};
  const double middle = std::pow(lattice.across + 1, 2);
  const double rows = (design.mesh.cloth_nodes - middle) / arms / (lattice.across + 1);
  lattice.along = std::max(2, static_cast<int>(std::lround(rows)) - 1);
  if (design.cut == FabricCut::bias)  // whose cells have to be nearly square
    lattice.along = std::max(
        2,
        static_cast<int>(std::lround(0.5 * (canopy.arm_length_m / canopy.arm_width_m - 1) * lattice.across)));
  return lattice;
}

class Builder {
 public:
  Builder(const Cross& canopy, const Design& design, const PartMaterials& materials)
      : canopy_(canopy), design_(design), materials_(materials), lattice_(choose_lattice(canopy, design)) {}

  CanopyMesh build() {
    for (int arm = 0; arm < arms; ++arm) add_arm(arm);
    add_middle();
    add_outline();
    if (materials_.tape) add_tapes(*materials_.tape);
    std::vector<Path> ends;
    const int per_arm = design_.lines.count / arms;
    for (int arm = 0; arm < arms; ++arm)
      for (int k = 0; k < per_arm; ++k)
        ends.push_back({{node(arm, 0, lattice_.across / (per_arm - 1) * k)}, {}});
    builder_.add_lines(design_, materials_, ends);
    return builder_.finish();
  }

 private:
  void add_arm(int arm);
  void add_middle();
  void add_outline();
  void add_tapes(const Tape& tape);

  int node(int patch, int row, int column) const { return builder_.mesh.patches[patch].node(row, column); }

  const Cross& canopy_;
  const Design& design_;
  const PartMaterials& materials_;
  Lattice lattice_;
  CanopyBuilder builder_;
};

// Arm 0 points along x; rows from its end inward, columns along y. The others are turned by quarters.
void Builder::add_arm(int arm) {
  const double half = canopy_.arm_length_m / 2, width = canopy_.arm_width_m;
  const auto start = [&](int row, int column) {
    const double x = half - (half - width / 2) * row / lattice_.along;
    const double y = width * (double(column) / lattice_.across - 0.5);
    const Vec3 turned[arms] = {{x, y, 0}, {-y, x, 0}, {-x, -y, 0}, {y, -x, 0}};
    return turned[arm];
  };
  PatchShape shape{lattice_.along + 1, lattice_.across + 1, false, start};
  shape.grain = design_.cut;
  builder_.add_patch(fmt::format("arm {}", arm + 1), shape, materials_.canopy);
}

void Builder::add_middle() {
  const double width = canopy_.arm_width_m;
  const int n = lattice_.across;
  const auto start = [&](int row, int column) {
    return Vec3{width * (0.5 - double(row) / n), width * (double(column) / n - 0.5), 0};
  };
  PatchShape shape{n + 1, n + 1, false, start};
  shape.grain = design_.cut;
  const int middle = builder_.add_patch("middle", shape, materials_.canopy);
  for (int c = 0; c <= n; ++c) {
    const int edge[arms] = {node(middle, 0, c), node(middle, c, n), node(middle, n, n - c),
                            node(middle, n - c, 0)};
    for (int arm = 0; arm < arms; ++arm) builder_.tie(node(arm, lattice_.along, c), {{edge[arm], 1.0}});
  }
}

// Along an arm's end, its left side inward, and the next arm's right side outward.
void Builder::add_outline() {
  std::vector<int>& skirt = builder_.rigging.skirt_nodes;
  const int n = lattice_.across;
  for (int arm = 0; arm < arms; ++arm) {
    for (int c = 0; c <= n; ++c) skirt.push_back(node(arm, 0, c));
    for (int row = 1; row <= lattice_.along; ++row) skirt.push_back(node(arm, row, n));
    for (int row = lattice_.along - 1; row > 0; --row) skirt.push_back(node((arm + 1) % arms, row, 0));
  }
}

void Builder::add_tapes(const Tape& tape) {
  const int law = builder_.add_tape_law(tape);
  if (design_.tape.hems) {
    const int part = builder_.part("hem tape");
    for (int arm = 0; arm < arms; ++arm) {
      builder_.add_tape(builder_.row(arm, 0), tape, law, part);
      for (const int side : {0, lattice_.across})
        builder_.add_tape(builder_.column(arm, side, 0, lattice_.along), tape, law, part);
    }
  }
  if (design_.tape.seams) {
    const int part = builder_.part("seam tape");
    for (int arm = 0; arm < arms; ++arm)
      builder_.add_tape(builder_.row(arm, lattice_.along), tape, law, part);
  }
}

}  // namespace

void describe(Fields& fields, Cross& canopy) {
  fields
      .number("arm_length_m", canopy.arm_length_m, from(0.01).up_to(100), "Length of each of the two strips.")
      .required();
  fields
      .number("arm_width_m", canopy.arm_width_m, above(0).up_to(100),
              "Width of the strips; 0.26 to 0.35 of the length is usual.")
      .required();
}

void check_shape(const Cross& canopy, const Design& design, Findings& findings) {
  check_inner_hems(design, findings);
  if (findings.sound({"parachute.arm_length_m", "parachute.arm_width_m"}) &&
      canopy.arm_width_m >= canopy.arm_length_m)
    findings.add("parachute.arm_width_m", canopy.arm_width_m, fmt::format("below {}", canopy.arm_length_m),
                 "the strips must be longer than wide");
  if (findings.sound({"parachute.gores"}) && design.gores != arms)
    findings.add("parachute.gores", design.gores, "4", "a cross has four arms, which count as gores");
  if (findings.sound({"parachute.lines.count"}) &&
      (design.lines.count % arms != 0 || design.lines.count < 2 * arms))
    findings.add("parachute.lines.count", design.lines.count, "8, 12, 16, ...",
                 "every arm of a cross has the same number of lines, at least two");
}

CanopyFacts facts(const Cross& canopy, int) {
  const double length = canopy.arm_length_m, width = canopy.arm_width_m;
  CanopyFacts facts;
  facts.cloth_area = 2 * length * width - width * width;
  facts.nominal_area = facts.cloth_area;
  facts.covered_area = facts.cloth_area;
  facts.skirt_radius = std::hypot(length, width) / 2;
  facts.start_diameter = 2 * facts.skirt_radius;
  facts.circumference = 4 * width;
  return facts;
}

CutPattern cut_pattern(const Cross& canopy, const Design& design) {
  const double length = canopy.arm_length_m, width = canopy.arm_width_m, arm = (length - width) / 2;
  const auto rectangle = [&](const char* name, int count, double height) {
    return Piece{name,
                 count,
                 {{-width / 2, 0}, {width / 2, 0}, {width / 2, height}, {-width / 2, height}},
                 {Edge::hem, Edge::hem, Edge::hem, Edge::hem},
                 0,
                 {"arm end", "arm side", "arm end", "arm side"}};
  };
  CutPattern cut;
  cut.pieces = {rectangle("whole strip", 1, length), rectangle("arm", 2, arm)};
  cut.pieces[1].edges[2] = Edge::seam, cut.pieces[1].edge_names[2] = "middle square";
  const int spaces = design.lines.count / arms - 1;  // between the lines at the end of an arm
  for (int k = 0; k <= spaces; ++k) {
    const double x = width * (double(k) / spaces - 0.5);
    cut.pieces[0].marks.insert(cut.pieces[0].marks.end(), {{{x, 0}, "line"}, {{x, length}, "line"}});
    cut.pieces[1].marks.push_back({{x, 0}, "line"});
  }
  if (design.tape.hems) cut.tapes = {{"arm end", arms, width}, {"arm side", 2 * arms, arm}};
  if (design.tape.seams) cut.tapes.push_back({"middle square", arms, width});
  return cut;
}

CanopyMesh build_canopy(const Cross& canopy, const Design& design, const PartMaterials& materials) {
  return Builder(canopy, design, materials).build();
}

Experience experience(const Cross&) {
  return {.projected_ratio = {0.66, 0.72},
          .drag_coefficient = {0.60, 0.85},
          .opening_coefficient = 1.15,  // 1.1 to 1.2
          .opening_source = knacke_transcribed,
          .line_load_factor = 1.43,  // at the corners of the arms
          .cloth_nodes = 1500};
}

constinit const CanopyFamily Cross::family = family_of<Cross>("cross", "cross");

}  // namespace ripstop::inline parachute

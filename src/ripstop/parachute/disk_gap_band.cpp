#include "ripstop/parachute/disk_gap_band.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "ripstop/core/toml/fields.h"
#include "ripstop/core/toml/problem.h"
#include "ripstop/parachute/cut.h"
#include "ripstop/parachute/piece_edges.h"
#include "ripstop/parachute/ring_layout.h"
#include "ripstop/parachute/sewing.h"

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;

// Nodes along one radial: from the skirt up the band, and from the edge of the disk to the vent.
struct Radial {
  Path band, disk;
};

class Builder {
 public:
  Builder(const DiskGapBand& canopy, const Design& design, const PartMaterials& materials)
      : d_(canopy), design_(design), materials_(materials) {}

  CanopyMesh build() {
    const double radius = 0.5 * d_.disk_diameter_m;
    const Strip band{d_.band_height_m, [&](double) { return 2 * pi * radius; }, true};
    const Strip disk{radius - 0.5 * d_.vent_diameter_m, [&](double s) { return 2 * pi * (radius - s); }};
    const RingLayout layout = lay_out_rings({band, disk}, facts(d_, design_.gores).cloth_area, design_);
    add_band(layout.strips[0].front());
    add_disk(layout.strips[1]);
    if (materials_.tape) add_tapes(*materials_.tape);
    add_sewn_lines();
    builder_.rigging.band_patches = {band_};
    builder_.rigging.disk_patches = rings_;
    return builder_.finish();
  }

 private:
  void add_band(const Ring& ring);
  void add_disk(const std::vector<Ring>& rings);
  void add_tapes(const Tape& tape);
  void add_sewn_lines();
  Radial radial_at(int part, int parts) const;

  const Patch& patch(int index) const { return builder_.mesh.patches[index]; }

  const DiskGapBand& d_;
  const Design& design_;
  const PartMaterials& materials_;
  CanopyBuilder builder_;
  int band_ = -1;
  std::vector<int> rings_;
};

void Builder::add_band(const Ring& ring) {
  const double radius = 0.5 * d_.disk_diameter_m;
  PatchShape shape{ring.cells + 1, ring.columns, true, [&](int row, int column) {
                     const double angle = 2 * pi * column / ring.columns;
                     return Vec3{radius * std::cos(angle), radius * std::sin(angle), ring.rise(row)};
                   }};
  shape.rolled_rows = true;
  shape.grain = design_.cut;
  band_ = builder_.add_patch("band", shape, materials_.canopy);
  builder_.set_skirt(band_);
}

void Builder::add_disk(const std::vector<Ring>& rings) {
  const double z = d_.band_height_m + d_.gap_height_m;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const Ring& ring = rings[k];
    const bool refined = k + 1 < rings.size();  // its last row is tied to the coarser ring
    const auto polar = [&](double radius, int column) {
      const double angle = 2 * pi * column / ring.columns;
      return Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
    };
    const auto start = [&](int row, int column) {
      const double radius = 0.5 * d_.disk_diameter_m - ring.from - ring.rise(row);
      if (refined && row == ring.cells && column % 2 == 1) {
        // In the middle of the coarser ring's chord, so that the tie is exact in the start shape.
        return 0.5 * (polar(radius, column - 1) + polar(radius, column + 1));
      }
      return polar(radius, column);
    };
    PatchShape shape{ring.cells + 1, ring.columns, true, start};
    shape.grain = design_.cut;
    rings_.push_back(builder_.add_patch("disk", shape, materials_.canopy));
    if (k > 0) builder_.tie_rows(rings_[k - 1], rings_[k]);
  }
}

void Builder::add_tapes(const Tape& tape) {
  const int law = builder_.add_tape_law(tape);
  if (design_.tape.hems) {
    const int part = builder_.part("hem tape");
    const int vent = rings_.back();
    for (const Path& hem : {builder_.row(band_, 0), builder_.row(band_, patch(band_).rows - 1),
                            builder_.row(rings_.front(), 0), builder_.row(vent, patch(vent).rows - 1)})
      builder_.add_tape(hem, tape, law, part);
  }
  if (design_.tape.seams) {
    const int part = builder_.part("seam tape");
    for (int gore = 0; gore < design_.gores; ++gore) {
      const Radial seam = radial_at(gore, design_.gores);
      builder_.add_tape(seam.band, tape, law, part);
      builder_.add_tape(seam.disk, tape, law, part);
    }
  }
}

Radial Builder::radial_at(int part, int parts) const {
  return {builder_.radial({band_}, part, parts), builder_.radial(rings_, part, parts)};
}

void Builder::add_sewn_lines() {
  const double on_disk = line_length_on_disk(design_);
  std::vector<Path> sewn;
  for (int k = 0; k < design_.lines.count; ++k) {
    const Radial radial = radial_at(k, design_.lines.count);
    const double segment = design_.mesh.line_segment_m;
    sewn.push_back(builder_.sew(radial.band, d_.band_height_m, segment, true));
    sewn.back().append(builder_.sew(radial.disk, on_disk, segment, true), d_.gap_height_m);
  }
  builder_.add_lines(design_, materials_, sewn);
}

}  // namespace

void describe(Fields& fields, DiskGapBand& canopy) {
  fields
      .number("disk_diameter_m", canopy.disk_diameter_m, from(0.01).up_to(100),
              "Diameter of the flat disk and of the band.")
      .required();
  fields
      .number("vent_diameter_m", canopy.vent_diameter_m, from(0.001).up_to(100),
              "Diameter of the vent in the centre of the disk.")
      .required();
  fields
      .number("gap_height_m", canopy.gap_height_m, from(0.001).up_to(100),
              "Open height between disk and band.")
      .required();
  fields
      .number("band_height_m", canopy.band_height_m, from(0.001).up_to(100),
              "Height of the cylindrical band.")
      .required();
}

void check_shape(const DiskGapBand& canopy, const Design& design, Findings& findings) {
  check_inner_hems(design, findings);
  if (!findings.sound({"parachute.type", "parachute.disk_diameter_m", "parachute.vent_diameter_m"})) return;
  if (canopy.vent_diameter_m >= canopy.disk_diameter_m)
    findings.add("parachute.vent_diameter_m", canopy.vent_diameter_m,
                 fmt::format("below {}", canopy.disk_diameter_m),
                 fmt::format("the vent must be smaller than the disk, parachute.disk_diameter_m = {}",
                             canopy.disk_diameter_m));
}

CanopyFacts facts(const DiskGapBand& canopy, int) {
  const double diameter = canopy.disk_diameter_m, vent = canopy.vent_diameter_m;
  CanopyFacts facts;
  facts.cloth_area = pi / 4 * (diameter * diameter - vent * vent) + pi * diameter * canopy.band_height_m;
  facts.nominal_area = facts.cloth_area;
  facts.covered_area = facts.cloth_area;
  facts.vent_area = pi / 4 * vent * vent;
  facts.slot_area = pi * diameter * canopy.gap_height_m;
  facts.line_run = (diameter - vent) / 2;
  facts.skirt_radius = diameter / 2;
  facts.start_diameter = diameter;
  facts.start_depth = canopy.gap_height_m + canopy.band_height_m;
  facts.circumference = pi * diameter;
  return facts;
}

CutPattern cut_pattern(const DiskGapBand& canopy, const Design& design) {
  constexpr int arc_pieces = 32;
  const double outer = canopy.disk_diameter_m / 2, inner = canopy.vent_diameter_m / 2;
  const double half_angle = pi / design.gores;
  Piece sector{"disk gore", design.gores, {}, {}};
  const auto add_arc = [&](double radius, double from, double to) {
    for (int i = 0; i <= arc_pieces; ++i) {
      const double angle = from + (to - from) * i / arc_pieces;
      // The apex of the disk lies at y = outer radius, so that y grows toward the vent.
      sector.outline.push_back({radius * std::sin(angle), outer - radius * std::cos(angle)});
      sector.edges.push_back(i < arc_pieces ? Edge::hem : Edge::seam);
    }
  };
  add_arc(outer, -half_angle, half_angle);
  add_arc(inner, half_angle, -half_angle);
  sector.edge_names.assign(sector.edges.size(), "disk seam");
  for (int i = 0; i < arc_pieces; ++i)
    sector.edge_names[i] = "disk edge", sector.edge_names[arc_pieces + 1 + i] = "vent";
  sector.marks = line_marks(sector, design.lines.count, design.gores);
  const double width = 2 * outer * half_angle, height = canopy.band_height_m;
  Piece panel{"band panel",
              design.gores,
              {{-width / 2, 0}, {width / 2, 0}, {width / 2, height}, {-width / 2, height}},
              {Edge::hem, Edge::seam, Edge::hem, Edge::seam}};
  panel.edge_names = {"skirt", "band seam", "band, upper edge", "band seam"};
  panel.marks = line_marks(panel, design.lines.count, design.gores);
  CutPattern cut;
  cut.pieces = {sector, panel};
  if (design.tape.hems) {
    cut.tapes = {{"skirt", 1, 2 * pi * outer},
                 {"band, upper edge", 1, 2 * pi * outer},
                 {"disk, edge", 1, 2 * pi * outer},
                 {"vent", 1, 2 * pi * inner}};
  }
  if (design.tape.seams) {
    cut.tapes.push_back({"band seam", design.gores, height});
    cut.tapes.push_back({"disk seam", design.gores, outer - inner});
  }
  cut.line_on_canopy = height + canopy.gap_height_m + line_length_on_disk(design);
  return cut;
}

CanopyMesh build_canopy(const DiskGapBand& canopy, const Design& design, const PartMaterials& materials) {
  return Builder(canopy, design, materials).build();
}

Experience experience(const DiskGapBand&) {
  return {.projected_ratio = {0.65, 0.65},
          .drag_coefficient = {0.52, 0.58},
          .opening_coefficient = 1.3,
          .opening_source = knacke_transcribed,
          .cloth_nodes = 1500};
}

constinit const CanopyFamily DiskGapBand::family = family_of<DiskGapBand>("disk-gap-band", "stratos-iv");

}  // namespace ripstop::inline parachute

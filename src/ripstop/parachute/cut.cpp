#include "ripstop/parachute/cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ripstop/parachute/gored.h"
#include "ripstop/parachute/piece_edges.h"

namespace ripstop::inline parachute {
namespace {

using std::numbers::pi;

/// Lower edge, right side up, upper edge back, left side down; collinear stations left out.
Piece piece_of(const GoreStrip& strip, int count, bool joined_above) {
  const std::vector<Station>& all = strip.stations;
  std::vector<Station> kept{all.front()};
  for (std::size_t k = 1; k + 1 < all.size(); ++k) {
    const double slope = (all[k + 1].width - kept.back().width) / (all[k + 1].height - kept.back().height);
    const double straight = kept.back().width + slope * (all[k].height - kept.back().height);
    if (std::abs(straight - all[k].width) > 1e-7) kept.push_back(all[k]);
  }
  kept.push_back(all.back());
  Piece piece{strip.name, count, {}, {}};
  piece.outline.push_back({-0.5 * kept.front().width, 0});
  piece.edges.push_back(strip.joined ? Edge::seam : Edge::hem);
  for (const Station& s : kept) {
    piece.outline.push_back({0.5 * s.width, s.height});
    piece.edges.push_back(Edge::seam);
  }
  piece.edges.back() = joined_above ? Edge::seam : Edge::hem;
  for (std::size_t k = kept.size(); k-- > 1;) {
    piece.outline.push_back({-0.5 * kept[k].width, kept[k].height});
    piece.edges.push_back(Edge::seam);
  }
  piece.edge_names.assign(piece.edges.size(), "gore seam");
  return piece;
}

/// Names the lower and the upper edge of strip `i`, and marks the suspension lines on the lowest.
void name_edges(const GorePattern& pattern, std::size_t i, int lines, Piece& piece) {
  const bool first = i == 0, last = i + 1 == pattern.strips.size();
  const std::size_t top = piece.edges.size() / 2;
  piece.edge_names[0] = first ? "skirt" : pattern.strips[i].joined ? "joint" : "lower edge";
  piece.edge_names[top] = last ? "vent" : pattern.strips[i + 1].joined ? "joint" : "upper edge";
  if (first) piece.marks = line_marks(piece, lines, pattern.gores);
}

}  // namespace

double polygon_area(const std::vector<Point2>& polygon) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return area;
}

double piece_area(const Piece& piece) {
  return polygon_area(piece.outline) - polygon_area(piece.opening);
}

std::vector<Point2> opening_with_allowance(const Piece& piece, const Allowances& allowances) {
  Point2 middle;
  const double n = double(piece.opening.size());
  for (const Point2 p : piece.opening) middle.x += p.x / n, middle.y += p.y / n;
  std::vector<Point2> cut;
  for (const Point2 p : piece.opening) {
    const double x = p.x - middle.x, y = p.y - middle.y, share = 1 - allowances.hem / std::hypot(x, y);
    if (share <= 0) return {};
    cut.push_back({middle.x + share * x, middle.y + share * y});
  }
  return cut;
}

std::vector<Point2> with_allowance(const Piece& piece, const Allowances& allowances) {
  const std::size_t n = piece.outline.size();
  struct Side {
    Point2 direction, normal;
    double offset;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 a = piece.outline[i], b = piece.outline[(i + 1) % n];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Point2 along{(b.x - a.x) / length, (b.y - a.y) / length};
    sides.push_back(
        {along, {along.y, -along.x}, piece.edges[i] == Edge::seam ? allowances.seam : allowances.hem});
  }
  std::vector<Point2> outline;
  for (std::size_t i = 0; i < n; ++i) {
    const Side& before = sides[(i + n - 1) % n];
    const Side& after = sides[i];
    const Point2 corner = piece.outline[i];
    const double turn = before.direction.x * after.direction.y - before.direction.y * after.direction.x;
    if (std::abs(turn) < 1e-3) {
      outline.push_back({corner.x + after.offset * after.normal.x, corner.y + after.offset * after.normal.y});
      continue;
    }
    // The point at both distances: corner + s n_before + t n_after.
    const double c = before.normal.x * after.normal.x + before.normal.y * after.normal.y;
    const double s = (before.offset - c * after.offset) / (1 - c * c);
    const double t = (after.offset - c * before.offset) / (1 - c * c);
    outline.push_back({corner.x + s * before.normal.x + t * after.normal.x,
                       corner.y + s * before.normal.y + t * after.normal.y});
  }
  return outline;
}

CutPattern cut_pattern(const GorePattern& pattern, const Design& design) {
  CutPattern cut;
  const int n = pattern.gores;
  for (std::size_t i = 0; i < pattern.strips.size(); ++i) {
    const GoreStrip& strip = pattern.strips[i];
    const bool joined_above = i + 1 < pattern.strips.size() && pattern.strips[i + 1].joined;
    cut.pieces.push_back(piece_of(strip, n, joined_above));
    name_edges(pattern, i, design.lines.count, cut.pieces.back());
    const std::string name = pattern.strips.size() > 1 ? strip.name + ", " : "";
    const double lower = n * strip.stations.front().width, upper = n * strip.stations.back().width;
    if (has_hem_tape(design, pattern, i, false))
      cut.tapes.push_back({name + (i == 0 ? "skirt" : strip.joined ? "joint" : "lower edge"), 1, lower});
    if (has_hem_tape(design, pattern, i, true)) {
      cut.tapes.push_back({name + (i + 1 == pattern.strips.size() ? "vent" : "upper edge"), 1, upper});
    }
  }
  if (design.tape.seams) cut.tapes.push_back({"gore seam", n, length_along(pattern, 0.5)});
  for (int k = 1; k <= pattern.vertical_tapes; ++k) {
    const double across = double(k) / (pattern.vertical_tapes + 1) - 0.5;
    cut.tapes.push_back({fmt::format("vertical tape {}", k), n, length_along(pattern, across)});
  }
  const double run = facts(pattern).line_run;
  cut.line_on_canopy = std::min(run, line_length_on_disk(design));
  if (pattern.vent_lines && cut.line_on_canopy >= run * (1 - 1e-9)) {
    const double vent = pattern.strips.back().stations.back().chord / std::sin(pi / n);
    cut.lines.push_back({"vent line", design.lines.count / 2, vent});
  }
  if (pattern.apex_line_ratio > 0)
    cut.lines.push_back({"apex line", design.lines.count, pattern.apex_line_ratio * design.lines.length_m});
  return cut;
}

CutPattern cut_pattern(const Design& design) {
  CutPattern cut = design.canopy.family().cut_pattern(design.canopy, design);
  for (Piece& piece : cut.pieces)
    piece.grain = design.cut == FabricCut::bias ? 45 : design.cut == FabricCut::across ? 90 : 0;
  return cut;
}

std::vector<CutLength> hems_of(const CutPattern& pattern) {
  std::vector<CutLength> hems;
  const auto add = [&](const std::string& name, double length) {
    const auto known =
        std::find_if(hems.begin(), hems.end(), [&](const CutLength& hem) { return hem.name == name; });
    if (known == hems.end())
      hems.push_back({name, 1, length});
    else
      known->length += length;
  };
  for (const Piece& piece : pattern.pieces) {
    for (const EdgeRun& run : edge_runs(piece))
      if (run.kind == Edge::hem) add(run.name, piece.count * run.length());
    double around = 0;
    for (std::size_t i = 0; i < piece.opening.size(); ++i) {
      const Point2 from = piece.opening[i], to = piece.opening[(i + 1) % piece.opening.size()];
      around += std::hypot(to.x - from.x, to.y - from.y);
    }
    if (around > 0) add("opening", piece.count * around);
  }
  return hems;
}

Bill bill_of(const CutPattern& pattern, const Design& design, const PartMaterials& materials,
             const Allowances& allowances, double packing_density) {
  Bill bill;
  for (const Piece& piece : pattern.pieces) {
    const double finished = piece.count * piece_area(piece);
    const double cut = piece.count * (polygon_area(with_allowance(piece, allowances)) -
                                      polygon_area(opening_with_allowance(piece, allowances)));
    bill.rows.push_back({piece.name, materials.canopy.name, piece.count, finished, cut, true,
                         cut * materials.canopy.areal_density_kg_m2, BillPart::cloth});
  }
  const auto add_length = [&](const CutLength& part, const std::string& material, double extra,
                              double density, BillPart kind) {
    const double cut = part.count * (part.length + extra);
    bill.rows.push_back(
        {part.name, material, part.count, part.count * part.length, cut, false, cut * density, kind});
  };
  if (materials.tape)
    for (const CutLength& tape : pattern.tapes)
      add_length(tape, materials.tape->name, allowances.tape_overlap, materials.tape->linear_density_kg_m,
                 BillPart::tape);
  std::vector<CutLength> lines = pattern.lines;
  lines.insert(lines.begin(),
               {"suspension line", design.lines.count, design.lines.length_m + pattern.line_on_canopy});
  for (const CutLength& line : lines)
    add_length(line, materials.line.name, 2 * allowances.line_loop, materials.line.linear_density_kg_m,
               BillPart::line);
  if (design.riser.length_m > 0)
    add_length({"riser", 1, design.riser.length_m}, materials.riser.name, 2 * allowances.line_loop,
               materials.riser.linear_density_kg_m, BillPart::riser);
  for (BillRow& row : bill.rows) bill.mass += row.mass;
  bill.packed_volume = bill.mass / packing_density;
  return bill;
}

}  // namespace ripstop::inline parachute

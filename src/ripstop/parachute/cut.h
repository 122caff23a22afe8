// Pieces of a parachute to be cut: outlines of the cloth, lengths of tape and line, masses and packed volume.
#pragma once

#include <string>
#include <vector>

#include "ripstop/parachute/build.h"

namespace ripstop::inline parachute {

struct GorePattern;

struct Point2 {
  double x = 0, y = 0;
};
/// Signed area of a closed polygon, positive when it runs counterclockwise [m2].
double polygon_area(const std::vector<Point2>& polygon);

enum class Edge { seam, hem };

/// Where something is sewn to a piece.
struct PieceMark {
  Point2 at;
  std::string text;
};

/// A flat piece of cloth, finished size; edge i goes from corner i to the next. Counterclockwise, y toward
/// the vent. [m]
struct Piece {
  std::string name;
  int count = 0;
  std::vector<Point2> outline;
  std::vector<Edge> edges;
  double grain = 0;                          // of the warp, from y toward x [deg]
  std::vector<std::string> edge_names = {};  // of the edges; empty, or empty of one: "seam" or "hem"
  std::vector<PieceMark> marks = {};         // suspension lines
  std::vector<Point2> opening = {};  // edge of a hole with a hem, counterclockwise; empty: there is none
};
/// Of the cloth of one piece, without its opening [m2].
double piece_area(const Piece& piece);

struct CutLength {
  std::string name;
  int count = 0;
  double length = 0;  // finished, each [m]
};

/// Of a canopy; bill_of() adds lines and riser.
struct CutPattern {
  std::vector<Piece> pieces;
  std::vector<CutLength> tapes;
  double line_on_canopy = 0;     // length of every line beyond the skirt [m]
  std::vector<CutLength> lines;  // vent lines, apex lines
};

/// Extra cloth, tape and line beyond the finished size [m].
struct Allowances {
  double seam = 0.015;         // beyond a seam, on either piece
  double hem = 0.02;           // beyond a free edge
  double line_loop = 0.1;      // at either end of a line (assumed)
  double tape_overlap = 0.05;  // of every tape, once (assumed)
};

/// The outline to cut: every edge moved outward by its allowance, corners mitred.
std::vector<Point2> with_allowance(const Piece& piece, const Allowances& allowances);
/// The edge to cut of its opening, smaller than the finished one by the hem; empty where none is left.
std::vector<Point2> opening_with_allowance(const Piece& piece, const Allowances& allowances);

/// Strips of a gored canopy, hems, seams, vertical tapes and vent lines.
CutPattern cut_pattern(const GorePattern& pattern, const Design& design);
/// Of any family.
CutPattern cut_pattern(const Design& design);
/// Free edges of the cloth by name, with the length of all of them: hems that are turned, and taped where there is tape.
std::vector<CutLength> hems_of(const CutPattern& pattern);

enum class BillPart { cloth, tape, line, riser };
struct BillRow {
  std::string part, material;
  int count = 0;
  double finished = 0, cut = 0;  // of all: [m2] of cloth, [m] of tape and line
  bool is_cloth = false;
  double mass = 0;  // as cut [kg]
  BillPart kind = BillPart::cloth;

  double cut_each() const { return cut / count; }  // of one piece
};
struct Bill {
  std::vector<BillRow> rows;
  double mass = 0;           // [kg], thread not counted
  double packed_volume = 0;  // [m3]
};
inline constexpr double packed_by_hand =
    400;  // [kg/m3], order of Knacke's figures, and dense for a packing by hand
inline constexpr double loosely_packed = 250;  // [kg/m3] (assumed)
/// `packing_density` [kg/m3]: packed_by_hand, or 600 under a press (likewise).
Bill bill_of(const CutPattern& pattern, const Design& design, const PartMaterials& materials,
             const Allowances& allowances, double packing_density);

}  // namespace ripstop::inline parachute

// Edges of a piece as a sewer sees them: with names, and with notches that meet those of the neighbour.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ripstop/parachute/cut.h"

namespace ripstop::inline parachute {

/// Edges of the outline that follow each other with one name and without a corner, counterclockwise, finished size.
struct EdgeRun {
  std::string name;
  Edge kind = Edge::seam;
  std::vector<Point2> points;
  double length() const;  // [m]
  std::array<Point2, 2> at(
      double distance) const;  // the point so far along the run, and the outward normal there
};
std::vector<EdgeRun> edge_runs(const Piece& piece);

/// Slits from the outline to cut into the allowance. They divide every seam into equal parts of about 0.3 m, at least two,
/// so that those of two pieces that are sewn together meet. Without an allowance there are none.
std::vector<std::array<Point2, 2>> notches(const Piece& piece, const Allowances& allowances);

/// Marks of `lines` suspension lines, equally spaced round `pieces` pieces, on the first edge of a piece. Where the counts
/// have no common spacing the places differ from piece to piece, and one mark in the middle states the numbers.
std::vector<PieceMark> line_marks(const Piece& piece, int lines, int pieces);

}  // namespace ripstop::inline parachute

// Drawn parts of a piece of cloth, for every file format. Internal to output/.
#pragma once

#include <string>
#include <vector>

#include "ripstop/output/pattern_files.h"
#include "ripstop/parachute/cut.h"

namespace ripstop::inline output {

/// Layers as cutters expect them, in the order in which they are drawn.
enum class PieceLayer { cut, seam, fold, notch, lines, grain, text };
inline constexpr const char* piece_layers[] = {"CUT", "SEAM", "FOLD", "NOTCH", "LINES", "GRAIN", "TEXT"};

struct PieceStroke {
  PieceLayer layer = PieceLayer::cut;
  std::vector<Point2> points;  // [m]
  bool closed = false;
};
struct PieceText {
  Point2 at;  // left end of the base line [m]
  std::string text;
};
struct PieceBox {
  double left = 1e300, right = -1e300, bottom = 1e300, top = -1e300;  // [m]
};
struct PieceDrawing {
  std::vector<PieceStroke> strokes;  // the outline to cut and the finished one first
  std::vector<PieceText> texts;
  double text_height = 0;  // [m]
  PieceBox box;            // of the outline to cut
};

PieceDrawing drawing_of(const Piece& piece, const Allowances& allowances, const PatternHead& head);

}  // namespace ripstop::inline output

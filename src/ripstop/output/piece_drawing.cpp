#include "ripstop/output/piece_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "ripstop/core/build_info.h"
#include "ripstop/parachute/piece_edges.h"

namespace ripstop::inline output {
namespace {

PieceBox box_of(const std::vector<Point2>& outline) {
  PieceBox box;
  for (const Point2& p : outline) {
    box.left = std::min(box.left, p.x), box.right = std::max(box.right, p.x);
    box.bottom = std::min(box.bottom, p.y), box.top = std::max(box.top, p.y);
  }
  return box;
}

/// An arrow along the warp, eight tenths as long as it fits into the box about its middle: tail, tip, and the
/// barbs on either side of the tip.
std::array<Point2, 4> grain_arrow(const Piece& piece, const PieceBox& box) {
  constexpr double barb = 0.008, spread = 25;  // [m], [deg]
  const auto along = [&](double turn) {
    const double angle = (piece.grain + turn) * std::numbers::pi / 180;
    return Point2{std::sin(angle), std::cos(angle)};
  };
  const Point2 middle{0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top)}, d = along(0);
  const double across = 0.5 * (box.right - box.left), up = 0.5 * (box.top - box.bottom);
  const double half =
      0.8 * std::min(across / std::max(std::abs(d.x), 1e-9), up / std::max(std::abs(d.y), 1e-9));
  const Point2 tip{middle.x + half * d.x, middle.y + half * d.y};
  const auto back = [&](double turn) {
    const Point2 e = along(turn);
    return Point2{tip.x - barb * e.x, tip.y - barb * e.y};
  };
  return {Point2{middle.x - half * d.x, middle.y - half * d.y}, tip, back(spread), back(-spread)};
}

/// Lines of the title block, the lowest first.
std::vector<std::string> title_block(const Piece& piece, const Allowances& allowances,
                                     const PatternHead& head) {
  std::string made = head.case_file;
  for (const std::string& part : {head.date, fmt::format("Ripstop {}", version())})
    made += (made.empty() || part.empty() ? "" : ", ") + part;
  std::vector<std::string> lines = {made, fmt::format("allowances: seam {:g} mm, hem {:g} mm",
                                                      1000 * allowances.seam, 1000 * allowances.hem)};
  if (!head.title.empty()) lines.push_back(head.title);
  lines.push_back(fmt::format("{}, cut {}, warp along arrow", piece.name, piece.count));
  return lines;
}

void add_line_marks(const Piece& piece, double size, PieceDrawing& drawing) {
  for (const PieceMark& mark : piece.marks) {
    const Point2 p = mark.at;
    drawing.strokes.push_back({PieceLayer::lines, {{p.x - size, p.y}, {p.x + size, p.y}}});
    drawing.strokes.push_back({PieceLayer::lines, {{p.x, p.y - size}, {p.x, p.y + size}}});
    drawing.texts.push_back({{p.x + 0.5 * size, p.y + 0.5 * size}, mark.text});
  }
}

/// The name of every run of edges inside its middle, and the fold of every hem.
void add_edges(const Piece& piece, PieceDrawing& drawing) {
  for (const EdgeRun& run : edge_runs(piece)) {
    if (run.kind == Edge::hem) drawing.strokes.push_back({PieceLayer::fold, run.points});
    const auto [p, out] = run.at(0.5 * run.length());
    const std::string text = run.kind == Edge::hem ? run.name + ", fold" : run.name;
    const double width = 0.6 * drawing.text_height * double(text.size()), inside = 1.5 * drawing.text_height;
    const double aside = out.x > 0.5 ? width : out.x < -0.5 ? 0 : 0.5 * width;
    drawing.texts.push_back({{p.x - inside * out.x - aside, p.y - inside * out.y}, text});
  }
}

}  // namespace

PieceDrawing drawing_of(const Piece& piece, const Allowances& allowances, const PatternHead& head) {
  constexpr double largest = 0.010, least = 0.003, share = 0.02;  // text height [m], of the smaller side
  PieceDrawing drawing;
  const std::vector<Point2> cut = with_allowance(piece, allowances);
  const PieceBox box = drawing.box = box_of(cut);
  drawing.text_height =
      std::clamp(share * std::min(box.right - box.left, box.top - box.bottom), least, largest);
  const auto [tail, tip, left, right] = grain_arrow(piece, box);
  drawing.strokes = {{PieceLayer::cut, cut, true},
                     {PieceLayer::seam, piece.outline, true},
                     {PieceLayer::grain, {tail, tip}},
                     {PieceLayer::grain, {left, tip, right}}};
  if (!piece.opening.empty()) {
    drawing.strokes.push_back({PieceLayer::seam, piece.opening, true});
    const std::vector<Point2> hole = opening_with_allowance(piece, allowances);
    if (!hole.empty()) drawing.strokes.push_back({PieceLayer::cut, hole, true});
  }
  for (const auto& [from, to] : notches(piece, allowances))
    drawing.strokes.push_back({PieceLayer::notch, {from, to}});
  add_edges(piece, drawing);
  add_line_marks(piece, drawing.text_height, drawing);
  double up = 0;
  for (const std::string& line : title_block(piece, allowances, head)) {
    drawing.texts.push_back({{tail.x + 0.5 * drawing.text_height, tail.y + up}, line});
    up += 1.6 * drawing.text_height;
  }
  return drawing;
}

}  // namespace ripstop::inline output

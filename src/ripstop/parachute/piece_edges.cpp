#include "ripstop/parachute/piece_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ripstop::inline parachute {
namespace {

std::string name_of(const Piece& piece, std::size_t edge) {
  if (edge < piece.edge_names.size() && !piece.edge_names[edge].empty()) return piece.edge_names[edge];
  return piece.edges[edge] == Edge::seam ? "seam" : "hem";
}

double distance(Point2 a, Point2 b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

Point2 between(Point2 a, Point2 b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

}  // namespace

double EdgeRun::length() const {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
  return sum;
}

std::array<Point2, 2> EdgeRun::at(double along) const {
  std::size_t i = 1;
  for (; i + 1 < points.size() && along > distance(points[i - 1], points[i]); ++i)
    along -= distance(points[i - 1], points[i]);
  const Point2 a = points[i - 1], b = points[i];
  const double step = distance(a, b);
  return {between(a, b, step > 0 ? along / step : 0),
          Point2{(b.y - a.y) / step, -(b.x - a.x) / step}};  // the outline runs counterclockwise
}

std::vector<EdgeRun> edge_runs(const Piece& piece) {
  constexpr double corner = 0.35;  // sine of the turn from which on two edges are two runs
  const std::size_t n = piece.outline.size();
  const auto turn = [&](std::size_t i) {  // at corner i, between edges i - 1 and i
    const Point2 a = piece.outline[(i + n - 1) % n], b = piece.outline[i], c = piece.outline[(i + 1) % n];
    const double cross = (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    const double dot = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y);
    return std::atan2(cross, dot);
  };
  const auto begins = [&](std::size_t i) {
    const std::size_t before = (i + n - 1) % n;
    return name_of(piece, i) != name_of(piece, before) || piece.edges[i] != piece.edges[before] ||
           std::abs(turn(i)) > corner;
  };
  std::size_t first = 0;
  while (first < n && !begins(first)) ++first;
  if (first == n) first = 0;
  std::vector<EdgeRun> runs;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    if (k == 0 || begins(i)) runs.push_back({name_of(piece, i), piece.edges[i], {piece.outline[i]}});
    runs.back().points.push_back(piece.outline[(i + 1) % n]);
  }
  return runs;
}

std::vector<std::array<Point2, 2>> notches(const Piece& piece, const Allowances& allowances) {
  constexpr double spacing = 0.3, deepest = 0.006, least = 0.001;  // [m]
  const double allowance = allowances.seam, depth = std::min(deepest, 0.5 * allowance);
  std::vector<std::array<Point2, 2>> all;
  if (allowance < least) return all;
  for (const EdgeRun& run : edge_runs(piece)) {
    if (run.kind != Edge::seam) continue;
    const double length = run.length();
    const int parts = static_cast<int>(std::clamp(std::round(length / spacing), 2.0, 1000.0));
    for (int k = 1; k < parts; ++k) {
      const auto [p, out] = run.at(length * k / parts);
      const auto place = [&, p = p, out = out](double beyond) {
        return Point2{p.x + beyond * out.x, p.y + beyond * out.y};
      };
      all.push_back({place(allowance), place(allowance - depth)});
    }
  }
  return all;
}

std::vector<PieceMark> line_marks(const Piece& piece, int lines, int pieces) {
  const EdgeRun edge = edge_runs(piece).front();
  const double length = edge.length();
  std::vector<PieceMark> marks;
  if (lines % pieces == 0) {
    const int spaces = lines / pieces;
    for (int k = 0; k <= spaces; ++k) marks.push_back({edge.at(length * k / spaces)[0], "line"});
  } else if (pieces % lines == 0) {
    for (const double end : {0.0, length})
      marks.push_back({edge.at(end)[0], fmt::format("line at every {}th seam", pieces / lines)});
  } else {
    marks.push_back(
        {edge.at(0.5 * length)[0], fmt::format("{} lines equally spaced round {} pieces", lines, pieces)});
  }
  return marks;
}

}  // namespace ripstop::inline parachute

#include "ripstop/parachute/ring_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ripstop/core/error.h"
#include "ripstop/core/quantity_error.h"

namespace ripstop::inline parachute {
namespace {

// Columns are halved where they are closer than this many times the mean spacing, or wider
// just below: 0.72 and 1.44.
constexpr double closest = 0.72;

int cells_for(double length, double spacing) {
  return std::max(2, static_cast<int>(std::lround(length / spacing)));
}

/// Where the strip, which narrows upward, is `wanted` round; its length if it nowhere is.
double distance_of(const Strip& strip, double wanted) {
  if (strip.circumference(strip.length) > wanted) return strip.length;
  double low = 0, high = strip.length;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (strip.circumference(middle) > wanted ? low : high) = middle;
  }
  return high;
}

std::vector<Ring> lay_out_strip(const Strip& strip, int& columns, double spacing, double row_spacing,
                                int multiple) {
  const auto too_close = [&](double distance) {
    return columns % (2 * multiple) == 0 &&
           strip.circumference(distance) < closest * spacing * columns * (1 - 1e-9);
  };
  std::vector<Ring> rings;
  if (too_close(strip.whole ? 0.5 * strip.length : 0)) columns /= 2;
  double from = 0;
  while (true) {
    double to = distance_of(strip, closest * spacing * columns);
    const bool last = strip.whole || columns % (2 * multiple) != 0 || to > strip.length - spacing;
    if (last) to = strip.length;
    if (to - from > 1.5 * row_spacing || last) {
      rings.push_back({columns, from, to, cells_for(to - from, row_spacing)});
      from = to;
    }
    if (last) return rings;
    columns /= 2;
  }
}

RingLayout lay_out(const std::vector<Strip>& strips, int columns, double spacing, double row_spacing,
                   int multiple) {
  RingLayout layout;
  for (const Strip& strip : strips)
    layout.strips.push_back(lay_out_strip(strip, columns, spacing, row_spacing, multiple));
  return layout;
}

/// Rows as far apart as the columns are there: cell by cell, ds = circumference(s) / columns.
void space_squarely(const Strip& strip, Ring& ring) {
  constexpr int pieces = 400;
  const double step = (ring.to - ring.from) / pieces;
  std::vector<double> cells{0};  // up to the end of every piece
  for (int i = 0; i < pieces; ++i)
    cells.push_back(cells.back() + step * ring.columns / strip.circumference(ring.from + (i + 0.5) * step));
  ring.cells = std::max(2, static_cast<int>(std::lround(cells.back())));
  ring.graded.assign(1, 0.0);
  int piece = 0;
  for (int row = 1; row < ring.cells; ++row) {
    const double wanted = cells.back() * row / ring.cells;
    while (cells[piece + 1] < wanted) ++piece;
    ring.graded.push_back(step * (piece + (wanted - cells[piece]) / (cells[piece + 1] - cells[piece])));
  }
  ring.graded.push_back(ring.to - ring.from);
}

RingLayout lay_out_squarely(const std::vector<Strip>& strips, int columns, double spacing, int multiple) {
  RingLayout layout = lay_out(strips, columns, spacing, spacing, multiple);
  for (std::size_t i = 0; i < strips.size(); ++i)
    for (Ring& ring : layout.strips[i]) space_squarely(strips[i], ring);
  return layout;
}

/// The ring with the largest row spacing of those that have no more than `columns` columns; null: none.
Ring* coarsest_that_fits(RingLayout& layout, int columns) {
  Ring* coarsest = nullptr;
  const auto spacing = [](const Ring& ring) { return (ring.to - ring.from) / ring.cells; };
  for (std::vector<Ring>& rings : layout.strips)
    for (Ring& ring : rings)
      if (ring.columns <= columns && (!coarsest || spacing(ring) > spacing(*coarsest) * (1 + 1e-9)))
        coarsest = &ring;
  return coarsest;
}

}  // namespace

int RingLayout::nodes() const {
  int count = 0;
  for (const std::vector<Ring>& rings : strips)
    for (const Ring& ring : rings) count += ring.columns * (ring.cells + 1);
  return count;
}

RingLayout lay_out_rings(const std::vector<Strip>& strips, double cloth_area, const Design& design) {
  const int nodes = design.mesh.cloth_nodes;
  const double spacing = std::sqrt(cloth_area / nodes);
  const int multiple =
      std::lcm(std::lcm(design.gores, design.lines.count), std::max(1, 2 * design.mesh.folds));
  double edge_columns = 0;
  for (const Strip& strip : strips) edge_columns = std::max(edge_columns, strip.circumference(0) / spacing);
  const bool square = design.cut == FabricCut::bias;
  const double vent_columns = strips.back().circumference(strips.back().length) / spacing;
  int best = 0;
  double best_score = 1e300;
  for (int base = multiple; base <= 2 * edge_columns; base += multiple) {
    for (int columns = base; columns <= 2 * edge_columns; columns *= 2) {
      // Squareness of the cells at the edge and at the vent, as logarithms of the spacing's
      // departure from the mean.
      const double at_edge =
          square ? std::log(double(lay_out_squarely(strips, columns, spacing, multiple).nodes()) / nodes)
                 : std::log(columns / edge_columns);
      const double at_vent = std::log(std::max(1.0, base / vent_columns));
      const double score = at_edge * at_edge + 0.5 * at_vent * at_vent;
      if (score >= best_score) continue;
      best_score = score;
      best = columns;
    }
  }
  if (best == 0) {
    throw QuantityError(
        ExitCode::usage,
        fmt::format("number of cloth nodes = {}: too few for {} gores and {} lines, whose seams and radials "
                    "need columns in multiples of {}; use more nodes",
                    nodes, design.gores, design.lines.count, multiple),
        {"number of cloth nodes"});
  }
  if (square) return lay_out_squarely(strips, best, spacing, multiple);
  // The row spacing remains free to meet the node count.
  double low = 0.2 * spacing, high = 5 * spacing;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (lay_out(strips, best, spacing, middle, multiple).nodes() > nodes ? low : high) = middle;
  }
  RingLayout layout = lay_out(strips, best, spacing, high, multiple);
  // Equally high strips get rows of the same spacing, all at once: missing rows are added one by one to the rings
  // with the largest spacing.
  while (Ring* ring = coarsest_that_fits(layout, nodes - layout.nodes())) ++ring->cells;
  return layout;
}

}  // namespace ripstop::inline parachute

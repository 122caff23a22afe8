// The cells of the flow's box: uniform, or fine in a core and growing toward the sides.
#pragma once

#include <array>
#include <vector>

#include "ripstop/core/vec3.h"

namespace ripstop::inline flow {

/// Cells along one axis: uniform in a core, and on either side of it each wider than its inner neighbour by a
/// constant ratio. Without cells before and after the core the whole axis is uniform.
struct Grading {
  double core_low = 0, core_high = 0;  // [m]
  int before = 0, after = 0;           // cells on either side of the core
  double ratio_before = 1, ratio_after = 1;

  bool operator==(const Grading&) const = default;
};

/// Box of nx x ny x nz cells; cell (i, j, k) has index i + nx * (j + ny * k).
struct FlowGrid {
  Vec3 origin;  // lowest corner [m]
  Vec3 size;    // [m]
  int nx = 0, ny = 0, nz = 0;
  std::array<Grading, 3> grading{};  // along x, y, z

  bool operator==(const FlowGrid&) const = default;
  int cells() const { return nx * ny * nz; }
  int index(int i, int j, int k) const { return i + nx * (j + ny * k); }
  int count(int axis) const { return axis == 0 ? nx : axis == 1 ? ny : nz; }
  bool uniform() const;

  /// Low side of cell i along axis 0, 1 or 2; i = count(axis): the far end of the box [m].
  double edge(int axis, int i) const;
  double centre(int axis, int i) const { return 0.5 * (edge(axis, i) + edge(axis, i + 1)); }
  double width(int axis, int i) const { return edge(axis, i + 1) - edge(axis, i); }
  /// The cell around x, the first or the last one for points beyond the box.
  int cell_at(int axis, double x) const;
  std::vector<double> edges(int axis) const;  // count + 1 [m]
  Vec3 centre(int i, int j, int k) const { return {centre(0, i), centre(1, j), centre(2, k)}; }

  /// Widths of the cell around a point [m].
  Vec3 spacing(Vec3 point) const;
  /// Widths of the smallest cells: those of the core, or all of them [m].
  Vec3 spacing() const;
  double cell_volume(int cell) const;  // [m3]
};

/// The two cells whose centres lie around x along an axis, and the weight of the upper one; constant beyond
/// the outermost centres.
struct Bracket {
  int low = 0, high = 0;
  double weight = 0;
};
Bracket bracket(const FlowGrid& grid, int axis, double x);

/// Least number of cells that fill `length` next to cells of width `first` without growing faster.
int cells_outside(double first, double length, double growth);

/// `box` with as many cells, uniform from core_low to core_high and there as fine as cells that grow outward
/// by no more than `growth` (> 1) a cell allow; uniform along an axis where the core has no extent. Throws
/// Error(usage) for a core that is not inside the box and for too few cells, and states the required number.
FlowGrid graded(const FlowGrid& box, Vec3 core_low, Vec3 core_high, double growth);

/// The same box and core with half as many cells along each axis.
FlowGrid coarser(const FlowGrid& grid);

}  // namespace ripstop::inline flow

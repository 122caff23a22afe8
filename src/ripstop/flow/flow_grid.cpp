#include "ripstop/flow/flow_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop::inline flow {
namespace {

double along(Vec3 v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

bool graded_axis(const Grading& g) {
  return g.before > 0 || g.after > 0;
}

/// r + r^2 + ... + r^n
double progression(double ratio, int n) {
  return std::abs(ratio - 1) < 1e-9 ? n : ratio * (std::pow(ratio, n) - 1) / (ratio - 1);
}

/// Ratio with which n cells, the first one `first` times the ratio wide, fill `length`.
double ratio_for(double first, int n, double length) {
  double low = 1e-3, high = 1e3;
  for (int halving = 0; halving < 200 && high - low > 1e-15 * high; ++halving) {
    const double middle = 0.5 * (low + high);
    (first * progression(middle, n) < length ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Grading with_cells(double low, double high, double core_low, double core_high, int before, int core,
                   int after) {
  Grading g{core_low, core_high, before, after, 1, 1};
  const double width = (core_high - core_low) / core;
  if (before > 0) g.ratio_before = ratio_for(width, before, core_low - low);
  if (after > 0) g.ratio_after = ratio_for(width, after, high - core_high);
  return g;
}

}  // namespace

int cells_outside(double first, double length, double growth) {
  int n = 0;
  while (first * progression(growth, n) < length * (1 - 1e-9)) ++n;
  return n;
}

bool FlowGrid::uniform() const {
  return std::none_of(grading.begin(), grading.end(), graded_axis);
}

double FlowGrid::edge(int axis, int i) const {
  const Grading& g = grading[axis];
  const int n = count(axis);
  const double low = along(origin, axis), extent = along(size, axis);
  if (!graded_axis(g)) return low + i * (extent / n);
  if (i <= 0) return low;
  if (i >= n) return low + extent;
  const int core = n - g.before - g.after, inside = i - g.before;
  const double width = (g.core_high - g.core_low) / core;
  if (inside < 0) return g.core_low - width * progression(g.ratio_before, -inside);
  if (inside > core) return g.core_high + width * progression(g.ratio_after, inside - core);
  return g.core_low + (g.core_high - g.core_low) * inside / core;
}

std::vector<double> FlowGrid::edges(int axis) const {
  std::vector<double> result(count(axis) + 1);
  for (int i = 0; i <= count(axis); ++i) result[i] = edge(axis, i);
  return result;
}

int FlowGrid::cell_at(int axis, double x) const {
  int low = 0, high = count(axis);
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (edge(axis, middle) <= x ? low : high) = middle;
  }
  return low;
}

Vec3 FlowGrid::spacing(Vec3 point) const {
  if (uniform()) return spacing();
  return {width(0, cell_at(0, point.x)), width(1, cell_at(1, point.y)), width(2, cell_at(2, point.z))};
}

Vec3 FlowGrid::spacing() const {
  const auto least = [this](int axis) {
    const Grading& g = grading[axis];
    return graded_axis(g) ? (g.core_high - g.core_low) / (count(axis) - g.before - g.after)
                          : along(size, axis) / count(axis);
  };
  return {least(0), least(1), least(2)};
}

double FlowGrid::cell_volume(int cell) const {
  if (uniform()) {
    const Vec3 h = spacing();
    return h.x * h.y * h.z;
  }
  return width(0, cell % nx) * width(1, cell / nx % ny) * width(2, cell / nx / ny);
}

Bracket bracket(const FlowGrid& grid, int axis, double x) {
  const int cell = grid.cell_at(axis, x), last = grid.count(axis) - 1;
  const int low = std::clamp(x < grid.centre(axis, cell) ? cell - 1 : cell, 0, std::max(last - 1, 0)),
            high = std::min(low + 1, last);
  const double from = grid.centre(axis, low), to = grid.centre(axis, high);
  return {low, high, to > from ? std::clamp((x - from) / (to - from), 0.0, 1.0) : 0.0};
}

FlowGrid graded(const FlowGrid& box, Vec3 core_low, Vec3 core_high, double growth) {
  if (!(growth > 1)) {
    throw Error(ExitCode::usage, fmt::format("flow grid: growth = {} must be greater than 1", growth));
  }
  FlowGrid grid = box;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = along(box.origin, axis), high = low + along(box.size, axis);
    const double from = along(core_low, axis), to = along(core_high, axis);
    const char name = "xyz"[axis];
    if (from == to) continue;
    if (!(low <= from && from < to && to <= high)) {
      throw Error(ExitCode::usage, fmt::format("flow grid: the core extends from {0} = {1} m to {0} = {2} m, "
                                               "but must be in the domain from {3} m to {4} m",
                                               name, from, to, low, high));
    }
    const int n = box.count(axis);
    const auto needed = [&](int core) {
      const double width = (to - from) / core;
      return core + cells_outside(width, from - low, growth) + cells_outside(width, high - to, growth);
    };
    int core = n;
    while (core > 0 && needed(core) > n) --core;
    if (core < 4) {
      throw Error(
          ExitCode::usage,
          fmt::format("flow grid: {0} cells along {1} leave {2} cells in the core region at a growth of "
                      "{3}; at least 4 are required: use {4} or more cells along {1}, a larger growth, "
                      "or a larger core region",
                      n, name, core, growth, needed(4)));
    }
    const double width = (to - from) / core;
    int before = cells_outside(width, from - low, growth), after = cells_outside(width, high - to, growth);
    // Cells to spare go to the side that grows faster.
    while (before + core + after < n) {
      const double r0 = before > 0 ? ratio_for(width, before, from - low) : 0,
                   r1 = after > 0 ? ratio_for(width, after, high - to) : 0;
      if (before == 0 && after == 0) {
        ++core;
      } else {
        ++(r0 >= r1 ? before : after);
      }
    }
    grid.grading[axis] = with_cells(low, high, from, to, before, core, after);
  }
  return grid;
}

FlowGrid coarser(const FlowGrid& grid) {
  FlowGrid half = grid;
  int* const counts[] = {&half.nx, &half.ny, &half.nz};
  for (int axis = 0; axis < 3; ++axis) {
    const Grading& g = grid.grading[axis];
    const int n = grid.count(axis);
    if (!graded_axis(g)) {
      *counts[axis] = (n + 1) / 2;
      continue;
    }
    const int before = (g.before + 1) / 2, after = (g.after + 1) / 2, core = (n - g.before - g.after + 1) / 2;
    *counts[axis] = before + core + after;
    const double low = along(grid.origin, axis), high = low + along(grid.size, axis);
    half.grading[axis] = with_cells(low, high, g.core_low, g.core_high, before, core, after);
  }
  return half;
}

}  // namespace ripstop::inline flow

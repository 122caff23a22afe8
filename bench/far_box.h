// A wide box about a small body, for studies of the flow alone.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "ripstop/core/error.h"
#include "ripstop/flow/flow.h"
#include "ripstop/flow/flow_grid.h"

namespace ripstop {

/// `box` filled with a core of cells of d / `across` about a body of diameter d at x = y = 0 and z, which grow
/// by an eighth outside of it.
inline FlowGrid about_body(FlowGrid box, double d, int across, double z) {
  const double from = 0.4 * d, past = 1.4 * d, half = 0.7 * d, growth = 1.125;
  const auto filled = [&](int& cells, int axis) {
    for (cells = 8;; ++cells) {
      FlowGrid one = box;
      one.nx = axis == 0 ? cells : 8, one.ny = axis == 1 ? cells : 8, one.nz = axis == 2 ? cells : 8;
      const Vec3 low{axis == 0 ? -half : 0, axis == 1 ? -half : 0, axis == 2 ? z - from : 0},
          high{axis == 0 ? half : 0, axis == 1 ? half : 0, axis == 2 ? z + past : 0};
      try {
        const Vec3 h = graded(one, low, high, growth).spacing();
        if ((axis == 0 ? h.x : axis == 1 ? h.y : h.z) <= 1.0001 * d / across) return;
      } catch (const Error&) {  // too few for a core at all
      }
    }
  };
  filled(box.nx, 0), filled(box.ny, 1), filled(box.nz, 2);
  return graded(box, {-half, -half, z - from}, {half, half, z + past}, growth);
}

/// In a box of `box` diameters d across and 1.5 times that long.
inline FlowGrid far_box(double d, double box, int across, double z) {
  return about_body({{-box / 2 * d, -box / 2 * d, 0}, {box * d, box * d, 1.5 * box * d}, 0, 0, 0}, d, across,
                    z);
}

/// A square plate of 1 m in a far box, of whole faces of the grid, so that every engine has the same one. Resistance in
/// Pa s/m.
inline FlowProblem plate_of_faces(double box, int across, double resistance, double speed) {
  FlowProblem problem;
  const double at = 0.45 * 1.5 * box;
  FlowGrid& grid = problem.grid;
  grid = far_box(1, box, across, at);
  problem.air.velocity = {0, 0, speed};
  problem.sides = Sides::slip;
  const int i = grid.cell_at(0, -0.5), j = grid.cell_at(1, -0.5);
  const double x = grid.edge(0, i), y = grid.edge(1, j), z = grid.edge(2, grid.cell_at(2, at));
  const Vec3 u{grid.edge(0, i + across) - x, 0, 0}, v{0, grid.edge(1, j + across) - y, 0}, corner{x, y, z};
  problem.bodies = {sheet_body({{corner, corner + u, corner + u + v}, {corner, corner + u + v, corner + v}},
                               {resistance, 0})};
  return problem;
}

struct Order {
  double order = 0, limit = 0;
};

/// Order of the last three of values on grids that are finer by `ratio` each, and their limit, if they
/// converge.
inline std::optional<Order> observed_order(const std::vector<double>& values, double ratio) {
  if (values.size() < 3) return {};
  const double* last = values.data() + values.size() - 3;
  const double falling = (last[1] - last[0]) / (last[2] - last[1]);
  if (falling <= 1) return {};
  return Order{std::log(falling) / std::log(ratio), last[2] + (last[2] - last[1]) / (falling - 1)};
}

}  // namespace ripstop

// Distance of every cell's centre to the nearest of some points of a wall.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ripstop/core/thread_team.h"
#include "ripstop/core/vec3.h"
#include "ripstop/flow/cartesian/grid.h"

namespace ripstop::inline flow::cartesian {

/// The nearest point of a cell is nearly always that of one of its neighbours: points are passed on from cell to cell,
/// to and fro along each axis.
class WallDistance {
 public:
  WallDistance(const Axis& x, const Axis& y, const Axis& z, std::vector<Vec3> points);

  /// A point to a cell.
  void offer(int i, int j, int k, int point) {
    if (point >= 0) compare(cell(i, j, k), {centre_[0][i], centre_[1][j], centre_[2][k]}, point);
  }
  /// To all other cells, shared by a team; the result does not depend on it.
  void sweep(ThreadTeam* team);
  /// Squared; 1e300 without points [m2].
  double square(int i, int j, int k) const { return square_[cell(i, j, k)]; }

 private:
  std::size_t cell(int i, int j, int k) const {
    return i + static_cast<std::size_t>(n_[0]) * (j + static_cast<std::size_t>(n_[1]) * k);
  }
  void compare(std::size_t cell, Vec3 centre, int point) {
    const Vec3 apart = centre - points_[point];
    if (dot(apart, apart) < square_[cell]) square_[cell] = dot(apart, apart), nearest_[cell] = point;
  }
  /// Cell (i, j, k) gets the point of its neighbour along an axis: `from` is 1 or -1 cells away.
  void pass_on(int axis, int from, int i, int j, int k);
  void sweep_plane(int k);
  void sweep_row_of_columns(int j);

  std::array<int, 3> n_;
  std::array<std::vector<double>, 3> centre_;
  std::array<std::ptrdiff_t, 3> stride_;
  std::vector<Vec3> points_;
  std::vector<int> nearest_;
  std::vector<double> square_;
};

}  // namespace ripstop::inline flow::cartesian

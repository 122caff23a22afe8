// Sums over the grid that an iteration makes, row by row so that their order is fixed.
#pragma once

#include <cstddef>
#include <vector>

#include "ripstop/core/thread_team.h"

namespace ripstop::inline flow::cartesian {

struct Sums {
  enum Name {
    u_residual,
    v_residual,
    w_residual,
    p_residual,
    k_residual,
    omega_residual,
    u_scale,
    v_scale,
    w_scale,
    p_scale,
    k_scale,
    omega_scale,
    u_mean,
    v_mean,
    w_mean,
    p_mean,
    k_mean,
    omega_mean,
    drag_x,
    drag_y,
    drag_z,
    mass_defect,
    count
  };
  double value[count] = {};

  /// Of the fields' residual, relative to its scale.
  double ratio(Name residual) const {
    return value[residual] / (value[residual + (u_scale - u_residual)] + 1e-300);
  }
};

class SumTable {
 public:
  SumTable(int ny, int nz) : ny_(ny), rows_(static_cast<std::size_t>(ny) * nz), planes_(nz) {}

  double* row(int j, int k) { return rows_[static_cast<std::size_t>(k) * ny_ + j].value; }
  const Sums& total() const { return total_; }
  Sums& total() { return total_; }

  /// Rows to planes in parallel, planes to totals on rank 0; always in the same order. Every rank calls it.
  void add_up(ThreadTeam& team, int rank) {
    const auto nz = static_cast<int>(planes_.size());
    const IndexRange planes = part_of(nz, rank, team.size());
    for (int k = planes.begin; k < planes.end; ++k) {
      planes_[k] = {};
      for (int j = 0; j < ny_; ++j) add(planes_[k], rows_[static_cast<std::size_t>(k) * ny_ + j]);
    }
    team.barrier();
    if (rank != 0) return;
    total_ = {};
    for (const Sums& plane : planes_) add(total_, plane);
  }

 private:
  static void add(Sums& sum, const Sums& part) {
    for (int name = 0; name < Sums::count; ++name) sum.value[name] += part.value[name];
  }

  int ny_;
  std::vector<Sums> rows_, planes_;
  Sums total_;
};

}  // namespace ripstop::inline flow::cartesian

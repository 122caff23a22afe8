// Porous cells as rows that the momentum kernel can read: most rows share one row of zeros.
#pragma once

#include <vector>

#include "ripstop/flow/cartesian/grid.h"
#include "ripstop/flow/cartesian/views.h"
#include "ripstop/flow/flow.h"

namespace ripstop::inline flow::cartesian {

/// Resistance R = linear + rho |U| quadratic [kg/(m3 s)] in each cell.
class PorousRows {
 public:
  PorousRows() = default;
  /// Of the bodies that are porous cells; cells named by several of them add up. Throws Error(bad_data) for cells outside the grid or coefficients
  /// that are negative or not finite.
  PorousRows(const FlowGrid& grid, const std::vector<FlowBody>& bodies, double viscosity);
  /// The same resistance seen by a grid of half as many cells an axis: volume means.
  PorousRows(const PorousRows& fine, const FlowGrid& fine_grid, const FlowGrid& coarse);

  bool empty() const { return linear_.size() <= static_cast<std::size_t>(nx_); }
  bool empty(int j, int k) const { return offset_[row(j, k)] == 0; }
  ResistanceView at(int j, int k) const {
    const std::size_t begin = offset_[row(j, k)];
    return {&linear_[begin], &quadratic_[begin]};
  }

 private:
  std::size_t row(int j, int k) const { return static_cast<std::size_t>(k) * ny_ + j; }
  void add_row(int j, int k);

  int nx_ = 0, ny_ = 0, nz_ = 0;
  std::vector<std::size_t> offset_;         // 0: the row of zeros
  std::vector<double> linear_, quadratic_;  // rows of nx values
};

}  // namespace ripstop::inline flow::cartesian

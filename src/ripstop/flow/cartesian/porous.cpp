#include "ripstop/flow/cartesian/porous.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop::inline flow::cartesian {

void PorousRows::add_row(int j, int k) {
  std::size_t& offset = offset_[row(j, k)];
  if (offset != 0) return;
  offset = linear_.size();
  linear_.resize(offset + nx_, 0.0);
  quadratic_.resize(offset + nx_, 0.0);
}

PorousRows::PorousRows(const FlowGrid& grid, const std::vector<FlowBody>& bodies, double viscosity)
    : nx_(grid.nx),
      ny_(grid.ny),
      nz_(grid.nz),
      offset_(static_cast<std::size_t>(grid.ny) * grid.nz, 0),
      linear_(grid.nx, 0.0),
      quadratic_(grid.nx, 0.0) {
  for (const FlowBody& body : bodies) {
    if (body.is_sheet()) continue;
    const PorousCells& cloth = body.porous();
    if (!(std::isfinite(cloth.darcy) && cloth.darcy >= 0 && std::isfinite(cloth.forchheimer) &&
          cloth.forchheimer >= 0)) {
      throw Error(
          ExitCode::bad_data,
          fmt::format(
              "porous cells: Darcy d = {} 1/m2 and Forchheimer f = {} 1/m must be finite and not negative",
              cloth.darcy, cloth.forchheimer));
    }
    for (int cell : cloth.cells) {
      if (cell < 0 || cell >= grid.cells()) {
        throw Error(ExitCode::bad_data,
                    fmt::format("porous cells: cell {} is outside the grid of {} cells", cell, grid.cells()));
      }
      const int i = cell % nx_, j = cell / nx_ % ny_, k = cell / nx_ / ny_;
      add_row(j, k);
      linear_[offset_[row(j, k)] + i] += viscosity * cloth.darcy;
      quadratic_[offset_[row(j, k)] + i] += cloth.forchheimer / 2;
    }
  }
}

PorousRows::PorousRows(const PorousRows& fine, const FlowGrid& fine_grid, const FlowGrid& coarse)
    : nx_(coarse.nx),
      ny_(coarse.ny),
      nz_(coarse.nz),
      offset_(static_cast<std::size_t>(coarse.ny) * coarse.nz, 0),
      linear_(coarse.nx, 0.0),
      quadratic_(coarse.nx, 0.0) {
  // Coarse cells that a fine cell lies in, with the share of each coarse cell that it fills.
  struct Part {
    int cell;
    double share;
  };
  const auto parts = [&](int axis) {
    const std::vector<double> from = fine_grid.edges(axis), to = coarse.edges(axis);
    std::vector<std::vector<Part>> result(from.size() - 1);
    for (std::size_t f = 0, c = 0; f + 1 < from.size(); ++f) {
      while (c + 2 < to.size() && to[c + 1] <= from[f]) ++c;
      for (std::size_t at = c; at + 1 < to.size() && to[at] < from[f + 1]; ++at) {
        const double length = std::min(from[f + 1], to[at + 1]) - std::max(from[f], to[at]);
        if (length > 0) result[f].push_back({static_cast<int>(at), length / (to[at + 1] - to[at])});
      }
    }
    return result;
  };
  const auto xs = parts(0), ys = parts(1), zs = parts(2);
  for (int k = 0; k < fine.nz_; ++k) {
    for (int j = 0; j < fine.ny_; ++j) {
      if (fine.empty(j, k)) continue;
      for (int i = 0; i < fine.nx_; ++i) {
        const double a = fine.at(j, k).linear[i], b = fine.at(j, k).quadratic[i];
        if (a == 0 && b == 0) continue;
        for (const Part& kc : zs[k]) {
          for (const Part& jc : ys[j]) {
            add_row(jc.cell, kc.cell);
            const std::size_t at = offset_[row(jc.cell, kc.cell)];
            for (const Part& ic : xs[i]) {
              const double s = ic.share * jc.share * kc.share;
              linear_[at + ic.cell] += s * a;
              quadratic_[at + ic.cell] += s * b;
            }
          }
        }
      }
    }
  }
}

}  // namespace ripstop::inline flow::cartesian

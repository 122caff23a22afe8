#include "ripstop/flow/cartesian/porous.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ripstop/core/error.h"

namespace ripstop::cartesian {

void PorousRows::add_row(int j, int k) {
  std::size_t& offset = offset_[row(j, k)];
  if (offset != 0) return;
  offset = linear_.size();
  linear_.resize(offset + nx_, 0.0);
  quadratic_.resize(offset + nx_, 0.0);
}

PorousRows::PorousRows(const FlowGrid& grid, const std::vector<PorousCells>& cloths, double viscosity)
    : nx_(grid.nx),
      ny_(grid.ny),
      nz_(grid.nz),
      offset_(static_cast<std::size_t>(grid.ny) * grid.nz, 0),
      linear_(grid.nx, 0.0),
      quadratic_(grid.nx, 0.0) {
  for (const PorousCells& cloth : cloths) {
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

PorousRows::PorousRows(const PorousRows& fine, const FlowGrid& coarse)
    : nx_(coarse.nx),
      ny_(coarse.ny),
      nz_(coarse.nz),
      offset_(static_cast<std::size_t>(coarse.ny) * coarse.nz, 0),
      linear_(coarse.nx, 0.0),
      quadratic_(coarse.nx, 0.0) {
  // Share of fine cell f of `n` that lies in coarse cell c of `m`, as a fraction of the coarse cell.
  const auto share = [](int f, int n, int c, int m) {
    const double lo = std::max(static_cast<double>(f) / n, static_cast<double>(c) / m);
    const double hi = std::min((f + 1.0) / n, (c + 1.0) / m);
    return std::max(0.0, hi - lo) * m;
  };
  const auto first = [](int f, int n, int m) { return static_cast<int>(static_cast<long long>(f) * m / n); };
  for (int k = 0; k < fine.nz_; ++k) {
    for (int j = 0; j < fine.ny_; ++j) {
      if (fine.empty(j, k)) continue;
      for (int i = 0; i < fine.nx_; ++i) {
        const double a = fine.linear(j, k)[i], b = fine.quadratic(j, k)[i];
        if (a == 0 && b == 0) continue;
        const int kc = first(k, fine.nz_, nz_), jc = first(j, fine.ny_, ny_), ic = first(i, fine.nx_, nx_);
        for (int kk = kc; kk < std::min(kc + 2, nz_); ++kk) {
          for (int jj = jc; jj < std::min(jc + 2, ny_); ++jj) {
            for (int ii = ic; ii < std::min(ic + 2, nx_); ++ii) {
              const double s =
                  share(i, fine.nx_, ii, nx_) * share(j, fine.ny_, jj, ny_) * share(k, fine.nz_, kk, nz_);
              if (s <= 0) continue;
              add_row(jj, kk);
              linear_[offset_[row(jj, kk)] + ii] += s * a;
              quadratic_[offset_[row(jj, kk)] + ii] += s * b;
            }
          }
        }
      }
    }
  }
}

}  // namespace ripstop::cartesian
